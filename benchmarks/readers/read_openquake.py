"""Runs OpenQuake's classical damage calculation of one site with a file that shaketable wrote.

It runs in an environment of its own: `python read_openquake.py FILE NAME CURVES`, where FILE is
what `to_nrml` wrote, NAME one of its bodies, and CURVES a hazard curve. It writes a job of one
object, runs `oq engine --run` on it, and prints what that exported as JSON.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pandas as pd

JOB = """\
[general]
description = one object
calculation_mode = classical_damage
[exposure]
exposure_file = exposure.xml
[hazard]
hazard_curves_csv = curves.csv
[calculation]
investigation_time = 50
risk_investigation_time = 50
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


def main() -> None:
    path, name, curves = sys.argv[1:]
    with tempfile.TemporaryDirectory() as work:
        folder = Path(work)
        shutil.copy(path, folder / "fragility.xml")
        shutil.copy(curves, folder / "curves.csv")
        (folder / "job.ini").write_text(JOB)
        (folder / "exposure.xml").write_text(EXPOSURE)
        asset = f"id,lon,lat,taxonomy,number,contents\na,0,0,{name},1,100\n"
        (folder / "assets.csv").write_text(asset)
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
    print(json.dumps(shares))


if __name__ == "__main__":
    main()
