"""
A fragility function for OpenQuake and pelicun
==============================================

The probability that a bookcase overturns, over PGV, as a lognormal function with its interval
over earthquakes, and the files that loss tools read.
"""

import tempfile
from pathlib import Path

from shaketable import Body, fragility, suite

shelf = Body.rectangle(0.32, 1.80, name="bookcase")
found = fragility(shelf, suite("fema-p695-far-field"), measure="PGV", draws=200)
low, high = found.median_interval
print(f"median {found.median:.2f} m/s ({low:.2f} to {high:.2f}), β {found.beta:.2f}")

folder = Path(tempfile.mkdtemp())
found.to_nrml(folder / "fragility.xml")  # for OpenQuake
found.to_pelicun(folder / "library")  # a damage and loss library
print(*sorted(path.name for path in folder.rglob("*") if path.is_file()), sep="\n")

found.plot()
