"""Runs pelicun to a loss with the files that shaketable wrote; prints what it found as JSON.

It runs in an environment of its own: `python read_pelicun.py FOLDER ID VELOCITY`, where FOLDER
holds the files of `to_pelicun`, ID is one of its objects, and every object meets a peak velocity of
so many m/s. Falling costs 1,000 to the downhill side and 2,000 to the uphill one.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pandas as pd
from pelicun.assessment import Assessment

COUNT = 200  # objects
SAMPLES = 2000
COSTS = (1000.0, 2000.0)

folder, name, velocity = Path(sys.argv[1]), sys.argv[2], float(sys.argv[3])
table = pd.read_csv(folder / "fragility.csv", index_col=0)
kind = table.loc[name, "Demand-Type"]
# an object of location 1 takes a floor's demand from location 0, the ground's from its own
acronym, place = {"Peak Floor Velocity": ("PFV", "0"), "Peak Ground Velocity": ("PGV", "1")}[kind]
pelicun = Assessment({"PrintLog": False, "Seed": 1, "LogFile": None})
pelicun.stories = 1
marginals = pd.DataFrame(
    {"Units": ["mps"], "Family": ["deterministic"], "Theta_0": [velocity]},
    index=pd.MultiIndex.from_tuples([(acronym, place, "1")], names=["type", "loc", "dir"]),
)
pelicun.demand.load_model({"marginals": marginals})
pelicun.demand.generate_sample({"SampleSize": SAMPLES})
components = {
    "Units": ["ea"],
    "Location": ["1"],
    "Direction": ["1"],
    "Theta_0": [str(COUNT)],
    "Blocks": [str(COUNT)],
    "Family": [None],
}
pelicun.asset.load_cmp_model({"marginals": pd.DataFrame(components, index=[name])})
pelicun.asset.generate_cmp_sample(SAMPLES)
pelicun.damage.load_model_parameters([str(folder / "fragility.csv")], {name})
pelicun.damage.calculate()
damage = pelicun.damage.save_sample().mean()
shares = {
    state: float(damage.xs(state, level="ds").sum()) / COUNT
    for state in sorted(set(damage.index.get_level_values("ds")))
}
states = [state for state in shares if state != "0"]
repair = pd.read_csv(folder / "consequence_repair.csv", index_col=0)
rows = {}
for one, row in repair[repair.index == f"{name}-Cost"].iterrows():
    for state, cost in zip(states, COSTS, strict=False):
        row[f"DS{state}-Theta_0"] = cost
    row["Incomplete"] = 0
    rows[one] = row
filled = pd.DataFrame(rows).T
filled.index.name = "ID"
filled.to_csv(folder / "filled.csv")
pelicun.loss.decision_variables = ("Cost",)
pelicun.loss.add_loss_map(pd.DataFrame({"Repair": [name]}, index=[name]))
pelicun.loss.load_model_parameters([str(folder / "filled.csv")])
pelicun.loss.calculate()
total = pelicun.loss.aggregate_losses()
print(json.dumps({"shares": shares, "loss": float(total["repair_cost"].mean()) / COUNT}))
