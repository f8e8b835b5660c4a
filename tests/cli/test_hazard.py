"""`shaketable hazard`, and `shaketable assess --hazard`, as a user meets them."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from shaketable.inventory import read_inventory
from shaketable.records import suite
from tests.support.command import refused, shaketable

CURVE = "PGV [cm/s],annual rate\n2,0.11\n10,0.015\n30,0.0026\n80,0.00037\n200,0.000033\n"
ROOMS = (
    "name,depth_m,width_m,height_m,quantity,anchored,floor\n"
    "shelf,0.3,0.9,1.8,4,,0\ncabinet,0.5,0.8,1.2,1,,2\nbolted,0.3,0.9,1.8,1,yes,0\n"
)
HOUSE = 'name = "House"\nstoreys = 2\nfirst_period_s = 0.3\n'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "curve.csv").write_text(CURVE)
    (tmp_path / "rooms.csv").write_text(ROOMS)
    (tmp_path / "house.toml").write_text(HOUSE)
    return tmp_path


def test_an_inventory(folder: Path) -> None:
    run = shaketable("hazard", "curve.csv", "rooms.csv", "--out", "yearly", cwd=folder)
    assert run.returncode == 0, run.stderr
    table = pd.read_csv(folder / "yearly" / "rates.csv")
    assert table["name"].tolist() == ["shelf", "shelf", "cabinet", "cabinet"]
    assert table["number"].tolist() == [1, 1, 2, 2]
    front, side = table["annual_rate"][:2]
    assert front > 10.0 * side  # 0.3 m deep, 0.9 m wide
    assert table["probability_in_50_years"][0] == pytest.approx(-np.expm1(-50.0 * front), rel=1e-5)
    assert table["annual_rate_low"][0] < front < table["annual_rate_high"][0]
    levels = pd.read_csv(folder / "yearly" / "levels.csv")
    parts = levels[(levels["number"] == 1) & (levels["direction"] == "front to back")]
    assert parts["annual_rate"].sum() == pytest.approx(front, rel=1e-5)  # in six digits
    assert "Of 5 pieces that are not anchored" in run.stdout
    assert f"falls once in {round(1 / front, -1 if front > 1e-3 else -2):.0f} years" in run.stdout
    page = (folder / "yearly" / "index.html").read_text()
    assert "What was not considered" in page
    assert "once in" in page
    told = json.loads((folder / "yearly" / "run.json").read_text())
    assert told["hazard"]["path"] == "curve.csv"


def test_floors_take_the_hazard_of_the_ground(folder: Path) -> None:
    """On the roof of a house things fall more often than on its ground."""
    given = ("hazard", "curve.csv", "rooms.csv", "--out", "yearly")
    ground = shaketable(*given, "--motions", "far-field", cwd=folder)
    assert "floor is for --building" in ground.stderr
    before = pd.read_csv(folder / "yearly" / "rates.csv").set_index(["name", "direction"])
    run = shaketable(
        *given, "--building", "house.toml", "--motions", "far-field", "--overwrite", cwd=folder
    )
    assert run.returncode == 0, run.stderr
    after = pd.read_csv(folder / "yearly" / "rates.csv").set_index(["name", "direction"])
    roof, front = ("cabinet", "front to back"), ("shelf", "front to back")
    assert after.loc[roof, "annual_rate"] > 1.2 * before.loc[roof, "annual_rate"]
    assert after.loc[front, "annual_rate"] == pytest.approx(before.loc[front, "annual_rate"])


def test_assess_tells_it_on_every_card(folder: Path) -> None:
    run = shaketable(
        "assess", "rooms.csv", "--hazard", "curve.csv", "--motions", "near-field-pulse",
        "--out", "rooms", cwd=folder,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    page = (folder / "rooms" / "report.html").read_text()
    assert "How often at this site" in page
    assert page.count("At this site it falls once in") == 2
    table = pd.read_csv(folder / "rooms" / "results.csv")
    assert np.isfinite(table["annual_falls"][:2]).all()
    assert (table["annual_falls_low"][:2] < table["annual_falls"][:2]).all()


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (("rooms.csv", "rooms.csv"), "not a hazard curve as OpenQuake or the USGS write it"),
        (("none.csv", "rooms.csv"), "no such file"),
        (("curve.csv", "rooms.csv", "--site", "zurich"), "--site: longitude,latitude in degrees"),
        (("curve.csv", "rooms.csv", "--years", 0), "--years must be above 0"),
        (("curve.csv", "rooms.csv", "--measure", "PGA"), "has curves of PGV, not of PGA"),
        (("curve.csv", "bolted.csv"), "every object is anchored"),
    ],
)
def test_what_is_refused(folder: Path, given: tuple[object, ...], said: str) -> None:
    (folder / "bolted.csv").write_text("\n".join([ROOMS.split("\n")[0], ROOMS.split("\n")[3], ""]))
    assert said in refused("hazard", *given, "--out", "yearly", cwd=folder)
    assert not (folder / "yearly").exists()


@pytest.mark.slow  # an inventory of 36 directions
def test_the_example(tmp_path: Path) -> None:
    """The curve and the inventory that come with the package."""
    examples = Path(__file__).parents[2] / "examples"
    assert len(read_inventory(examples / "hospital.csv")) > 10
    assert len(suite("far-field")) == 44
    run = shaketable(
        "hazard", examples / "hazard.csv", examples / "hospital.csv", "--out", "yearly",
        "--motions", "near-field-pulse", cwd=tmp_path,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert "would save" in run.stdout


def test_rates_are_told_where_nothing_can_be_added_up_or_exported(folder: Path) -> None:
    """A panel that every motion overturns to the front has no function there, but one sideways."""
    (folder / "panel.csv").write_text("name,depth_m,width_m,height_m\npanel,0.002,0.3,1.8\n")
    run = shaketable(
        "hazard", "curve.csv", "panel.csv", "--out", "yearly", "--export", "openquake",
        "--accept-sizes", cwd=folder,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    rates = pd.read_csv(folder / "yearly" / "rates.csv")
    assert rates["annual_rate"].isna().tolist() == [True, False]
    assert "no job was written" in run.stdout
    assert not (folder / "yearly" / "totals.csv").exists()
    assert not list((folder / "yearly").glob("openquake_*"))
