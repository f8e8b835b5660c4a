"""Runs pelicun to a loss with the library and the quantities that shaketable wrote, as JSON.

It runs in an environment of its own: `python run_pelicun.py FOLDER VELOCITY`, where FOLDER is what
`shaketable hazard ... --export pelicun` wrote, and the ground of all objects meets a peak velocity
of so many m/s.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pandas as pd
from pelicun.assessment import Assessment

SAMPLES = 2000

folder, velocity = Path(sys.argv[1]), float(sys.argv[2])
pelicun = Assessment({"PrintLog": False, "Seed": 1, "LogFile": None})
pelicun.stories = 1
marginals = pd.DataFrame(
    {"Units": ["mps"], "Family": ["deterministic"], "Theta_0": [velocity]},
    index=pd.MultiIndex.from_tuples([("PGV", "1", "1")], names=["type", "loc", "dir"]),
)
pelicun.demand.load_model({"marginals": marginals})
pelicun.demand.generate_sample({"SampleSize": SAMPLES})
quantities = pd.read_csv(folder / "CMP_QNT.csv", index_col=0, dtype=str)
quantities["Family"] = None
pelicun.asset.load_cmp_model({"marginals": quantities})
pelicun.asset.generate_cmp_sample(SAMPLES)
names = list(quantities.index)
pelicun.damage.load_model_parameters([str(folder / "fragility.csv")], set(names))
pelicun.damage.calculate()
pelicun.loss.decision_variables = ("Cost",)
pelicun.loss.add_loss_map(pd.DataFrame({"Repair": names}, index=names))
pelicun.loss.load_model_parameters([str(folder / "consequence_repair.csv")])
pelicun.loss.calculate()
total = pelicun.loss.aggregate_losses()
print(json.dumps({"loss": float(total["repair_cost"].mean())}))
