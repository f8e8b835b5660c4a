"""
Once in how many years
======================

The fragility function of a bookcase integrated over the hazard curve of a site: the rate of falls
per year, and which levels of shaking contribute to it.
"""

import tempfile
from pathlib import Path

from shaketable import Body, annual_rate, fragility, read_hazard, suite
from shaketable.plot import plot_levels

# an invented curve; take that of your site
curve = Path(tempfile.mkdtemp()) / "site.csv"
curve.write_text(
    "PGV (cm/s),annual rate\n2,0.2\n5,0.06\n10,0.02\n20,0.006\n50,0.0009\n100,0.0001\n"
)
site = read_hazard(curve)
found = fragility(
    Body.rectangle(0.32, 1.80), suite("fema-p695-far-field"), components="geometric mean", draws=200
)
rate = annual_rate(found, site)
print(f"{rate.rate:.1e} falls a year: once in {1 / rate.rate:.0f} years")
print(
    f"95 % interval {rate.interval[0]:.1e} to {rate.interval[1]:.1e} a year, of the function alone"
)
plot_levels([("bookcase", rate)], site)
