"""Small files of every kind that commands read, and calls of every command with them."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from openpyxl import Workbook

from tests.support.record_files import write_at2

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SIZE = "--base-m 0.3 --height-m 1.8"
BOX = "--depth-m 0.3 --width-m 0.6 --height-m 1.8"
BARE = "--units g --time-step-s 0.01"  # the records of `bare` say neither
FEW = f"--motions bare {BARE}"
UPRIGHT = "--motions three"
QUAKE = "--magnitude 7 --distance-km 10 --vs30 400 --number 4"
WHERE = "--shakemap grid.xml"
WIDE = "--scales 0.01,100"

#: The plainest call of each command.
PLAIN = {
    "assess": f"list.csv {FEW} --planar --out out",
    "simulate": f"{SIZE} --record bare/a.csv {BARE} --json",
    "tilt": f"{SIZE} {FEW} --tilt-deg 2 --json",
    "criteria": f"{SIZE} --pga-g 0.3 --pgv-cm-s 40",
    "initial-modes": f"{SIZE} --static-friction 0.4",
    "fragility": f"{SIZE} {FEW} --out out",
    "hazard": f"curve.csv list.csv {FEW} --out out",
    "ida": f"{SIZE} {FEW} --precision 0.1 --out out",
    "overturning-spectrum": f"{SIZE} --points 3 --out out",
    "scenario": f"list.csv {QUAKE} {FEW} --out out",
    "select-motions": f"fema-p695-near-field-pulse {QUAKE} {WIDE} --out out",
    "records": f"bare {BARE}",
    "calibrate": f"drops.csv {FEW} --members 64 --folds 3 --predict more.csv --out out",
    "template": "",
}
SOLID = "--depth-m 0.3 --width-m 0.4 --height-m 1.2 --record three/RSN1_A-E.AT2 --json {}"
SOLID = SOLID.format("--static-friction 0.5")
DRUM = "--base-m 0.3 --height-m 1.2 --shape cylinder --record three/RSN1_A-E.AT2 --json"
DRUM_TILT = "--base-m 0.3 --height-m 1.2 --shape cylinder --motions three --tilt-deg 2 --json"

LIST = (
    "name,depth_m,width_m,height_m,castors,critical,floor\n"
    "shelf,0.3,0.9,1.8,none,1,1\ncart,0.5,0.7,1.1,free,5,1\nbed,0.5,0.6,1.3,locked,2,1\n"
)
SITES = (
    "#,,generated_by='OpenQuake', investigation_time=50.0, imt='PGA'\n"
    "lon,lat,depth,poe-0.05,poe-0.1,poe-0.4\n"
    "8.5,47.4,0,6.3E-01,2.1E-01,1.1E-02\n7.0,46.0,0,3.3E-01,1.1E-01,0.6E-02\n"
)


CAMPAIGN = """
[bodies.grid]
base_m = [0.2, 0.3]
height_m = [1.0, 1.5]
[motions]
of = ["bare"]
units = "g"
time_step_s = 0.01
[shaking]
scales = [0.5, 1.0]
[plan]
block = 4
"""


def write_small_files(folder: Path) -> None:
    """Lists, curves, a building, and records with and without units."""
    (folder / "list.csv").write_text(LIST)
    (folder / "campaign.toml").write_text(CAMPAIGN)
    (folder / "other.csv").write_text(LIST.replace("0.3,0.9", "0.2,0.8"))
    (folder / "map.toml").write_text('[columns]\n"depth_m" = "width_m"\n"width_m" = "depth_m"\n')
    book = Workbook()
    for number, name in enumerate(("east", "west")):
        sheet = book.worksheets[0] if number == 0 else book.create_sheet()
        sheet.title = name
        for row in csv.reader(LIST.splitlines()):
            sheet.append(row)
    book.save(folder / "two.xlsx")
    (folder / "odd.csv").write_text(LIST + "needle,0.01,0.3,1.0,none,1,1\n")
    (folder / "names.csv").write_text(LIST + "bookcase,,,,none,1,1\n")
    (folder / "curve.csv").write_text("PGV [cm/s],annual rate\n5,0.12\n20,0.015\n80,0.0004\n")
    (folder / "bare.csv").write_text("level,annual rate\n5,0.12\n20,0.015\n80,0.0004\n")
    (folder / "chances.csv").write_text("PGV [cm/s],PoE\n5,0.9\n20,0.3\n80,0.01\n")
    (folder / "sites.csv").write_text(SITES)
    (folder / "spectrum.csv").write_text("period_s,acceleration_g\n0.1,0.4\n0.5,1.0\n2,0.3\n")
    house = 'name = "House"\nstoreys = 2\nfirst_period_s = 0.3\n'
    (folder / "house.toml").write_text(house)
    tests = [
        f"{name} {scale},{name}.csv,{scale},{'yes' if scale * (k + 3) > 6 else 'no'}\n"
        for k, name in enumerate("abcdef")
        for scale in (0.5, 1.0, 2.0)
    ]
    (folder / "drops.csv").write_text("test,motion,scale,fell\n" + "".join(tests))
    (folder / "fewer.csv").write_text("test,motion,scale,fell\n" + "".join(tests[:12]))
    (folder / "more.csv").write_text("test,motion,scale\nnew,b.csv,1.7\n")
    prior = "parameter,low,high,distribution\nslenderness,0.1,0.3,log-uniform\n"
    (folder / "prior.csv").write_text(prior)
    (folder / "campus.csv").write_text((EXAMPLES / "campus.csv").read_text())
    (folder / "grid.xml").write_text((EXAMPLES / "shakemap" / "grid.xml").read_text())
    rng, t = np.random.default_rng(3), 0.01 * np.arange(500)
    shape = t * np.exp(-0.8 * t)
    bare, stronger, three = folder / "bare", folder / "stronger", folder / "three"
    for each in (bare, stronger, three):
        each.mkdir()
    for k, name in enumerate("abcdef"):
        size = 0.7 + 0.25 * k
        values = size * shape * np.sin((2 + k) * t + k) + 0.1 * shape * rng.normal(size=t.size)
        for each, factor in ((bare, 1.0), (stronger, 1.5)):
            numbers = "\n".join(f"{factor * x:.6f}" for x in values)
            (each / f"{name}.csv").write_text(f"acceleration\n{numbers}")
    for k in range(1, 5):
        for name, code, size in (("E", "090", 0.9), ("N", "000", 0.6), ("UP", "UP", 0.8)):
            values = (0.3 + 0.5 * k) * size * shape * np.sin((1.5 + k + len(name)) * t + k)
            path = write_at2(three, f"RSN{k}_A-{name}.AT2", code, values)
            path.write_text(path.read_text().replace("Quake", f"Quake {k}"))
    rows = [f"{0.01 * k:.2f},{x:.5f},{y:.5f}" for k, (x, y) in enumerate(rng.normal(size=(300, 2)))]
    (folder / "pair.csv").write_text("time [s],N [g],E [g]\n" + "\n".join(rows))
