"""A library from its file to its folder: simulated, resumed, fitted, written, read and found."""

from __future__ import annotations

import json
import math
import shutil
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import scipy.stats

from shaketable import InputError
from shaketable.campaign.description import read_campaign
from shaketable.campaign.libraries import Libraries, runs_of
from shaketable.campaign.objects import Objects
from shaketable.library.published import found_rows, read_library_table
from shaketable.library.shaken import MOST_SCALES, CaseRuns, motions_under, simulated
from shaketable.library.table import COLUMNS
from shaketable.progress import size
from tests.support.command import refused, shaketable

TOML = """
[library]
title = "Few things"
edition = "0.1"
measures = ["PGV", "SA(1.0)", "floor PGV"]
limit_states = ["uplift", "overturns", "reaches 0.8 m"]
seed = 1

[motions]
of = "fema-p695-near-field-pulse"

[[places]]
name = "ground"

[[places]]
name = "roof"
storeys = 2
first_period_s = 0.3
floor = 2

[[held]]
name = "free"
draws = 1

[[things]]
kinds = ["bookcase"]
sizes = ["slender"]
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A library of two cases, run and collected from the command line."""
    place = tmp_path_factory.mktemp("library")
    (place / "library.toml").write_text(TOML)
    run = shaketable("campaign", "run", "library.toml", "--store", "store", cwd=place)
    assert run.returncode == 0, run.stderr
    assert "2 of 2 done" in run.stdout
    run = shaketable("campaign", "collect", "store", "--out", "out", cwd=place)
    assert run.returncode == 0, run.stderr
    return place


@pytest.fixture(scope="module")
def work(folder: Path) -> Libraries:
    found = read_campaign(folder / "library.toml")
    assert isinstance(found, Libraries)
    return found


def test_other_states_are_told_of_the_same_simulations(folder: Path, tmp_path: Path) -> None:
    """What the simulations do not depend on is that of the last file, and nothing is done again."""
    shutil.copytree(folder / "store", tmp_path / "store")
    (tmp_path / "other.toml").write_text(TOML.replace('"uplift", ', '"slides 0.1 m", '))
    before = {path: path.stat().st_mtime_ns for path in tmp_path.glob("store/results/cases/*")}
    for words in (("run", "other.toml", "--store", "store"), ("collect", "store", "--out", "out")):
        run = shaketable("campaign", *words, cwd=tmp_path)
        assert run.returncode == 0, run.stderr
        if words[0] == "run":
            assert "its plan now has another library.states" in run.stderr
    assert before == {path: path.stat().st_mtime_ns for path in before}
    states = read_library_table(tmp_path / "out" / "functions.csv")["limit_state"].unique()
    assert set(states) == {"slides 0.1 m", "overturns", "reaches 0.8 m"}


def test_it_is_not_done_again(folder: Path) -> None:
    before = {path: path.stat().st_mtime_ns for path in folder.glob("store/results/cases/*")}
    run = shaketable("campaign", "run", "library.toml", "--store", "store", cwd=folder)
    assert run.returncode == 0, run.stderr
    assert before == {path: path.stat().st_mtime_ns for path in before}
    assert len(before) == 2


def test_another_seed_is_another_campaign(folder: Path) -> None:
    (folder / "other.toml").write_text(TOML.replace("seed = 1", "seed = 2"))
    assert "was begun with another campaign (seed: 1 → 2)" in refused(
        "campaign", "run", "other.toml", "--store", "store", cwd=folder
    )


def test_a_case_gives_the_same_again_on_any_number_of_threads(
    folder: Path, work: Libraries
) -> None:
    stored = runs_of(work, Objects(folder / "store"))[1]
    case = work.cases[1]
    again = simulated(case, motions_under(case, work.ground), seed=1, threads=1)
    for name, values in vars(stored).items():
        assert np.array_equal(values, getattr(again, name)), name
    assert np.unique(again.scale).size <= MOST_SCALES
    copy = CaseRuns.from_bytes(again.as_bytes())
    assert all(np.array_equal(vars(copy)[name], vars(again)[name]) for name in vars(again))


def test_the_scales_reach_from_rest_to_falls(folder: Path, work: Libraries) -> None:
    for runs in runs_of(work, Objects(folder / "store")):
        low, high = runs.scale.min(), runs.scale.max()
        assert (runs.rotation[runs.scale == low] > 0.0).mean() <= 0.2
        assert runs.fell[runs.scale == high].mean() >= 0.8


def test_the_cost_is_told_before_it_starts(folder: Path) -> None:
    run = shaketable("campaign", "run", "library.toml", "--dry-run", cwd=folder)
    assert run.returncode == 0, run.stderr
    count = 2 * 1 * 28 // 2 * MOST_SCALES
    assert f"simulations       {count:,} in 2 blocks" in run.stdout
    assert f"at most {size(40 * count)}" in run.stdout


def test_the_folder_holds_what_tools_and_archives_need(folder: Path) -> None:
    out = folder / "out"
    table = read_library_table(out / "functions.csv")
    assert list(table) == list(COLUMNS)
    # two cases, three states, two measures, and one more on the floor
    assert len(table) == 3 * 2 + 3 * 3
    dictionary = pd.read_csv(out / "data_dictionary.csv", keep_default_na=False)
    assert dictionary["column"].tolist() == list(COLUMNS)
    package = json.loads((out / "datapackage.json").read_text())
    there = {each["path"] for each in package["resources"]}
    assert there == {path.name for path in out.iterdir()} - {"datapackage.json", "run.json"}
    assert package["version"] == "0.1"
    assert package["environment"]["shaketable's code"]
    assert len(package["motions"]["hashes"]) == 14
    (tabular,) = [each for each in package["resources"] if "schema" in each]
    assert [each["name"] for each in tabular["schema"]["fields"]] == list(COLUMNS)


def test_rows_are_what_loss_tools_read(folder: Path) -> None:
    """θ in OpenQuake's and in pelicun's file is that of the table, in their units."""
    table = read_library_table(folder / "out" / "functions.csv")
    (row,) = table[
        (table["measure"] == "PGV") & (table["limit_state"] == "overturns")
        & (table["place"] == "ground")
    ].itertuples()  # fmt: skip
    space = {"o": "http://openquake.org/xmlns/nrml/0.5"}
    root = ET.parse(folder / "out" / "openquake_PGV_overturns.xml").getroot()
    functions = {each.get("id"): each for each in root.iterfind(".//o:fragilityFunction", space)}
    params = functions[row.id].find("o:params", space)
    assert params is not None
    assert params.get("ls") == "overturns"
    mean = 100.0 * row.median * np.exp(row.beta**2 / 2)
    assert float(params.get("mean") or 0.0) == pytest.approx(mean, rel=1e-4)
    assert not (
        folder / "out" / "openquake_floor_PGV_overturns.xml"
    ).exists()  # OpenQuake's is the ground's
    library = pd.read_csv(folder / "out" / "pelicun_PGV_fragility.csv", index_col=0)
    assert library.loc[row.id, "LS1-Theta_0"] == pytest.approx(row.median, rel=1e-4)
    assert library.loc[row.id, "Demand-Type"] == "Peak Ground Velocity"
    floor = pd.read_csv(folder / "out" / "pelicun_floor_PGV_fragility.csv", index_col=0)
    assert set(floor["Demand-Type"]) == {"Peak Floor Velocity"}


def test_rows_are_what_ned_and_pyincore_read(folder: Path) -> None:
    """NED has floors alone, the ground as one of them; pyincore evaluates what it is given."""
    table = read_library_table(folder / "out" / "functions.csv")
    (row,) = found_rows(
        table, words="ground", limit_state="overturns", measure="PGV"
    ).itertuples()  # fmt: skip
    models = json.loads((folder / "out" / "ned_fragility_model.json").read_text())
    curves = json.loads((folder / "out" / "ned_fragility_curve.json").read_text())
    of_floors = table["measure"].eq("floor PGV") | (
        table["measure"].eq("PGV") & table["place"].eq("ground")
    )
    assert len(models) == len(curves) == int((of_floors & table["median"].notna()).sum())
    (curve,) = [one for one in curves if one["fragility_model"].endswith(f"{row.id}.PGV")]
    assert curve["median"] == pytest.approx(row.median, abs=1e-4)
    assert curve["edp_metric"] == "Peak Floor Velocity"
    assert curve["num_observations"] == row.recordings
    sets = {one["id"]: one for one in json.loads(
        (folder / "out" / "pyincore_PGV.json").read_text())}  # fmt: skip
    (rule,) = sets[row.id]["fragilityCurves"][0]["rules"]
    at = {"math": math, "scipy": scipy, "PGV": 100.0 * row.median}
    assert eval(rule["expression"], at) == pytest.approx(0.5, abs=1e-4)
    of_sa = json.loads((folder / "out" / "pyincore_SA_1.0.json").read_text())
    assert of_sa[0]["demandTypes"] == ["1.0 SA"]
    assert not (folder / "out" / "pyincore_floor_PGV.json").exists()


def test_the_page_holds_every_row(folder: Path) -> None:
    page = (folder / "out" / "index.html").read_text()
    data = json.loads(page.split("const DATA = ")[1].split(";\n")[0])
    assert len(data["rows"]) == 15
    assert data["units"]["PGV"] == ["cm/s", 100.0]
    assert "http" not in page.replace("http://www.w3.org/2000/svg", "")


def test_rows_are_found_and_written_again(folder: Path) -> None:
    table = read_library_table(folder / "out" / "functions.csv")
    some = found_rows(table, words="BOOKCASE roof", limit_state="overturns", measure="floor PGV")
    assert len(some) == 1
    run = shaketable(
        "library", "out/functions.csv", "--find", "roof", "--measure", "floor PGV",
        "--limit-state", "overturns", cwd=folder,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert f"θ {100 * some['median'].iloc[0]:.3g} cm/s" in run.stdout
    run = shaketable("library", "out/functions.csv", "--find", "roof", "--out", "some", cwd=folder)
    assert run.returncode == 0, run.stderr
    again = read_library_table(folder / "some" / "functions.csv")
    pd.testing.assert_frame_equal(again, found_rows(table, words="roof").reset_index(drop=True))


@pytest.mark.parametrize(
    ("option", "value", "rows"),
    [
        ("--find", "ground", 6),
        ("--limit-state", "uplift", 5),
        ("--measure", "PGV", 6),
        ("--place", "roof", 9),
        ("--held", "free", 15),
    ],
)
def test_every_option_chooses_rows(folder: Path, option: str, value: str, rows: int) -> None:
    run = shaketable("library", "out/functions.csv", option, value, cwd=folder)
    assert run.returncode == 0, run.stderr
    assert sum("bookcase slender, " in line for line in run.stdout.splitlines()) == rows


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"words": "vase"}, "has no such rows; its things are bookcase slender"),
        ({"measure": "PGD"}, "measure: the library has no 'PGD'; it has PGV, SA"),
        ({"held": "glued"}, "held: the library has no 'glued'"),
    ],
)
def test_what_is_not_there_is_told(folder: Path, given: dict[str, str], says: str) -> None:
    table = read_library_table(folder / "out" / "functions.csv")
    with pytest.raises(InputError, match=says):
        found_rows(table, **given)  # type: ignore[arg-type]


def test_other_tables_are_refused(folder: Path) -> None:
    path = folder / "rates.csv"
    path.write_text("name,median\na,1\n")
    with pytest.raises(InputError, match="has no column id, thing, kind, group, size and 39 more"):
        read_library_table(path)
    told = (folder / "out" / "functions.csv").read_text().splitlines()
    at = told[0].split(",").index("depth")
    cells = told[1].split(",")
    cells[at] = "deep"
    path.write_text("\n".join([told[0], ",".join(cells), *told[2:]]) + "\n")
    with pytest.raises(InputError, match="line 2, depth: expected a number, found 'deep'"):
        read_library_table(path)
    with pytest.raises(InputError, match="cannot be read"):
        read_library_table(folder / "nowhere.csv")
