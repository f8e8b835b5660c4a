"""`make interop`: the exported files read by OpenQuake and by pelicun, each in its environment.

OpenQuake runs a classical damage calculation of one site (`oq engine --run`), pelicun a loss; both
are printed beside what the same functions give here. Then both run the whole jobs of a list of
objects with costs, as `shaketable hazard ... --export openquake,pelicun` writes them. The
environments are made in the folder that is named, once.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
import venv
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from shaketable import Body, Fragility, fragility, suite
from shaketable.hazard import annual_rate, read_hazard
from shaketable.hazard.jobs import JOBS, write_jobs
from shaketable.hazard.objects import object_rates
from shaketable.hazard.totals import loss_totals
from shaketable.inventory import read_inventory

EXAMPLES = Path(__file__).parents[1] / "examples"
READERS = Path(__file__).parent / "readers"
OPENQUAKE = (
    "h3<4", "fiona", "pyzmq", "numpy", "scipy", "pandas", "h5py", "toml", "psutil", "decorator",
    "shapely", "numba", "pyproj", "requests", "docutils", "alpha_shapes", "geopandas",
    "matplotlib", "django<5", "django_cors_headers", "setuptools<80", "wheel",
)  # fmt: skip
BODY = Body.rectangle(0.32, 1.8, name="bookcase")
VELOCITY = 0.4  # m/s, that pelicun's objects meet
STEPS = 28  # of the hazard curve
YEARS = 50.0
COSTS = (1000.0, 2000.0)  # of falls to either side, as read_pelicun has them


def python_of(folder: Path, name: str, *wanted: tuple[str, ...]) -> Path:
    """The interpreter of an environment, in which what is wanted is installed once."""
    place = folder / name
    python = place / "bin" / "python"
    if not (place / "ready").exists():
        venv.create(place, with_pip=True, clear=True)
        for packages in wanted:
            subprocess.run([python, "-m", "pip", "install", "--quiet", *packages], check=True)
        (place / "ready").touch()
    return python


def asked(python: Path, script: str, *arguments: object) -> Any:
    run = subprocess.run(
        [python, READERS / script, *map(str, arguments)],
        check=True, capture_output=True, text=True,
    )  # fmt: skip
    return json.loads(run.stdout.splitlines()[-1])


def gdal() -> str:
    """The bindings of the GDAL library of this machine, which must be of its version."""
    if shutil.which("gdal-config") is None:
        raise SystemExit("OpenQuake needs the GDAL library: apt install libgdal-dev")
    told = subprocess.run(["gdal-config", "--version"], check=True, capture_output=True, text=True)
    return f"gdal=={told.stdout.strip()}"


def by_openquake(found: Fragility, environments: Path, work: Path) -> None:
    python = python_of(
        environments, "openquake", ("--no-deps", "openquake.engine==3.26"), OPENQUAKE,
        ("--no-build-isolation", gdal()),
    )  # fmt: skip
    curves = work / "curves.csv"
    levels = np.geomspace(2.0, 400.0, STEPS + 1)  # cm/s
    poes = -np.expm1(-0.02 * (levels / 20.0) ** -2.5 * YEARS)
    head, row = (
        ",".join(f"{what}{x:.9g}" for x in xs) for what, xs in (("poe-", levels), ("", poes))
    )
    curves.write_text(
        f"#,,\"generated_by='shaketable', investigation_time={YEARS}, imt='PGV'\"\n"
        f"lon,lat,depth,{head}\n0.0,0.0,0.0,{row}\n"
    )
    here = annual_rate(found, read_hazard(curves)).probability(YEARS)
    for form in ("continuous", "discrete"):
        found.to_nrml(work / "fragility.xml", form=form)
        there = asked(python, "read_openquake.py", work / "fragility.xml", "bookcase", curves)
        share = there["contents-overturns"]
        print(f"OpenQuake, {form}: probability of overturning in {YEARS:g} years {share:.4f}, "
              f"here {here:.4f}, {100 * (share / here - 1):+.1f} %")  # fmt: skip


def by_pelicun(found: Fragility, environments: Path, work: Path) -> None:
    python = python_of(environments, "pelicun", ("scipy<1.16", "pelicun==3.10"))
    for demand in ("floor", "ground"):
        found.to_pelicun(work / demand, demand=demand)
        told = asked(python, "read_pelicun.py", work / demand, "bookcase", VELOCITY)
        chance = float(found.curve.probability(VELOCITY))
        down = found.curve.downhill
        loss = chance * (down * COSTS[0] + (1.0 - down) * COSTS[1])
        fallen = 1.0 - told["shares"]["0"]
        print(f"pelicun, {demand}: {fallen:.4f} of the objects fall at {VELOCITY:g} m/s, here "
              f"{chance:.4f}; loss {told['loss']:.1f} each, here {loss:.1f}")  # fmt: skip


def whole_jobs(environments: Path, work: Path) -> None:
    """The jobs of the example campus, each object with a cost, beside the totals here."""
    rows = pd.read_csv(EXAMPLES / "campus.csv", dtype=str)
    rows["replacement_cost"] = 100.0 * (1.0 + np.arange(len(rows)))
    rows.to_csv(work / "campus.csv", index=False)
    hazard = read_hazard(EXAMPLES / "hazard.csv")
    rates = object_rates(
        read_inventory(work / "campus.csv"), suite("fema-p695-far-field"), hazard, draws=0
    )
    write_jobs(rates, work, JOBS)
    told = asked(environments / "openquake" / "bin" / "python", "run_openquake.py", work)
    departs = []
    for one in rates.of_objects().values():
        fallen = told["fallen"][f"object_{one.number}"] / one.item.quantity
        departs.append(fallen / one.found.probability(1.0) - 1.0)
    average = loss_totals(rates).average
    there = sum(told["loss"].values())
    print(f"OpenQuake, {len(departs)} objects of a list: probability of falling in a year "
          f"{100 * min(departs):+.1f} to {100 * max(departs):+.1f} % of ours; average annual loss "
          f"{there:.1f}, here {average:.1f}, {100 * (there / average - 1.0):+.1f} %")  # fmt: skip
    loss = asked(
        environments / "pelicun" / "bin" / "python", "run_pelicun.py", work, VELOCITY
    )["loss"]  # fmt: skip
    here = sum(
        one.item.quantity * (one.item.cost or 0.0) * float(one.curve.probability(VELOCITY))
        for one in rates.of_objects().values()
    )
    print(f"pelicun, the same list at {VELOCITY:g} m/s: loss {loss:.0f}, here {here:.0f}, "
          f"{100 * (loss / here - 1.0):+.1f} %")  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--environments", type=Path, default=Path("out/interop"))
    given = parser.parse_args()
    if sys.platform == "win32":
        raise SystemExit("the readers' environments are made for Linux and macOS")
    environments = given.environments.absolute()
    environments.mkdir(parents=True, exist_ok=True)
    found = fragility(BODY, suite("fema-p695-far-field"), tilt=0.01, draws=0)
    with tempfile.TemporaryDirectory() as folder:
        by_openquake(found, environments, Path(folder))
        by_pelicun(found, environments, Path(folder))
        whole_jobs(environments, Path(folder))


if __name__ == "__main__":
    main()
