"""Runs the jobs that shaketable wrote for OpenQuake, and prints what they export as JSON.

It runs in an environment of its own: `python run_openquake.py FOLDER`, where FOLDER is what
`shaketable hazard ... --export openquake` wrote.
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

with tempfile.TemporaryDirectory() as work:
    folder = Path(work)
    for path in Path(sys.argv[1]).glob("openquake_*"):
        shutil.copy(path, folder)
    at_home = {"HOME": work, "OQ_DATADIR": work, "OQ_DATABASE": "127.0.0.1", "OQ_DISTRIBUTE": "no"}
    for job in ("damage", "risk"):
        run = subprocess.run(
            [Path(sys.executable).with_name("oq"), "engine", "--run", f"openquake_{job}.ini",
             "--exports=csv"],
            cwd=folder, env={**os.environ, **at_home}, capture_output=True, text=True, check=False,
        )  # fmt: skip
        if run.returncode:
            raise SystemExit(run.stdout + run.stderr)
    (damages,) = folder.glob("damages-rlz-*.csv")
    (losses,) = folder.glob("avg_losses-mean_*.csv")
    damage = pd.read_csv(damages, comment="#").set_index("asset_id")
    loss = pd.read_csv(losses, comment="#").set_index("asset_id")
print(json.dumps({
    "fallen": damage["contents-overturns"].to_dict(), "loss": loss["contents"].to_dict()
}))  # fmt: skip
