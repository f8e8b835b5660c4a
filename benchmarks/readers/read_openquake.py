"""Runs OpenQuake's classical damage calculation of one site with a file that shaketable wrote.

It runs in an environment of its own: `python read_openquake.py FILE NAME`, where FILE is what
`to_nrml` wrote and NAME one of its bodies. It writes a job of one object under a hazard curve of 28
steps, runs `oq engine --run` on it, and prints what that exported as JSON.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd

STEPS = 28
EXPONENT = 2.5
YEARS = 50.0
JOB = """\
[general]
description = one object
calculation_mode = classical_damage
[exposure]
exposure_file = exposure.xml
[hazard]
hazard_curves_csv = curves.csv
[calculation]
investigation_time = {years}
risk_investigation_time = {years}
[fragility]
contents_fragility_file = fragility.xml
"""
EXPOSURE = """\
<?xml version="1.0" encoding="UTF-8"?>
<nrml xmlns="http://openquake.org/xmlns/nrml/0.5">
<exposureModel id="objects" category="contents" taxonomySource="shaketable">
<description>one object</description>
<conversions><costTypes>
<costType name="contents" type="per_asset" unit="USD"/>
</costTypes></conversions>
<assets>assets.csv</assets>
</exposureModel>
</nrml>
"""


def write_job(folder: Path, name: str, levels: np.ndarray, poes: np.ndarray) -> None:
    """The files of the job beside the fragility functions."""
    (folder / "job.ini").write_text(JOB.format(years=YEARS))
    (folder / "exposure.xml").write_text(EXPOSURE)
    (folder / "assets.csv").write_text(f"id,lon,lat,taxonomy,number,contents\na,0,0,{name},1,100\n")
    head = ",".join(f"poe-{level:.7f}" for level in levels)
    row = ",".join(f"{poe:.9e}" for poe in poes)
    (folder / "curves.csv").write_text(
        f"#,,\"generated_by='shaketable', investigation_time={YEARS}, imt='PGV'\"\n"
        f"lon,lat,depth,{head}\n0.00000,0.00000,0.00000,{row}\n"
    )


def main() -> None:
    path, name = sys.argv[1:]
    levels = np.geomspace(2.0, 400.0, STEPS + 1)  # cm/s
    rates = 0.02 * (levels / 20.0) ** -EXPONENT  # a year
    with tempfile.TemporaryDirectory() as work:
        folder = Path(work)
        shutil.copy(path, folder / "fragility.xml")
        write_job(folder, name, levels, -np.expm1(-rates * YEARS))
        at_home = {"HOME": work, "OQ_DATADIR": work, "OQ_DATABASE": "127.0.0.1"}
        run = subprocess.run(
            [Path(sys.executable).with_name("oq"), "engine", "--run", "job.ini", "--exports=csv"],
            cwd=folder, env={**os.environ, **at_home, "OQ_DISTRIBUTE": "no"},
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        if run.returncode:
            raise SystemExit(run.stdout + run.stderr)
        (exported,) = folder.glob("damages-rlz-*.csv")
        row = pd.read_csv(exported, comment="#").iloc[0]
    shares = {key: float(value) for key, value in row.items() if str(key).startswith("contents")}
    told = {"shares": shares, "levels": levels.tolist(), "rates": rates.tolist(), "years": YEARS}
    print(json.dumps(told))


if __name__ == "__main__":
    main()
