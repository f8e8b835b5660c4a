"""`shaketable tilt` and `shaketable study`, as a user meets them."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pandas as pd
import pytest
from PIL import Image

from shaketable import Body, Rocking, suite
from shaketable.records import DEFAULT_SUITE
from shaketable.report.words.numbers import tilt_degrees
from shaketable.tilting import design_tilt
from shaketable_studies.boroschek_iruretagoyena_2006.figures import FIGURES
from tests.support.command import refused, shaketable

CABINET = ("tilt", "--base-m", 0.25, "--height-m", 1.0)
STUDY = ("study", "boroschek-iruretagoyena-2006", "--motions", "near-field-pulse")


def test_tilt_says_what_to_do(tmp_path: Path) -> None:
    run = shaketable(*CABINET, "--shelf-depth-m", 0.4, "--plot", "tilt.png", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    design = design_tilt(Body.rectangle(0.25, 1.0), suite(DEFAULT_SUITE), progress=False)
    tilt = re.escape(tilt_degrees(design.curves.control_tilt))
    assert re.search(rf"simulated +{tilt} \(likely between", run.stdout)
    assert re.search(r"GCOR, any body +4\.7°", run.stdout)  # 0.048 atanh(0.45/0.48) rad
    assert "over the shelf of 0.4 m" in run.stdout
    assert "times as often as without a tilt" in run.stdout
    assert "tilted or not, where static friction is above 0.25" in run.stdout
    assert width_of(tmp_path / "tilt.png") > 500


def test_tilt_inverse_as_json(tmp_path: Path) -> None:
    run = shaketable(*CABINET, "--tilt-deg", 3, "--json", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    told = json.loads(run.stdout)
    assert "designed" not in told  # no tilt was asked for
    effect = told["asked"]
    assert effect["tilt_deg"] == pytest.approx(3.0)
    assert effect["downhill_share"] == effect["downhill"] / effect["falls"]
    assert effect["downhill_interval"][0] < effect["downhill_share"]
    assert effect["raised_m"]["base"] == pytest.approx(0.25 * 0.0523360, abs=1e-6)
    assert effect["slides_share"] is None
    assert told["level"]["downhill_share"] == 0.5
    assert told["settings"]["motions"] == DEFAULT_SUITE


def test_tilt_tells_none_from_unknown(tmp_path: Path) -> None:
    few = shaketable(*CABINET, "--scale", 0.3, "--json", cwd=tmp_path)
    assert json.loads(few.stdout)["designed"]["found"] == "too few falls to tell"
    leans = ("tilt", "--base-m", 0.3, "--height-m", 1, "--eccentricity", 0.75, "--scale", 2)
    none = shaketable(*leans, "--json", cwd=tmp_path)
    told = json.loads(none.stdout)["designed"]
    assert told["found"] == "none does"
    assert told["tilt_deg"] is None
    assert told["effect"] is None


def test_tilt_with_friction(tmp_path: Path) -> None:
    run = shaketable(
        *CABINET,
        "--tilt-deg",
        2,
        "--model",
        "general",
        "--static-friction",
        0.2,
        "--motions",
        "near-field-pulse",
        cwd=tmp_path,
    )
    assert run.returncode == 0, run.stderr
    assert "it slides downhill first, from 0.20 g on" in run.stdout
    assert "it stays upright but is moved by more than 1 cm" in run.stdout


def test_tilt_warns_outside_of_scor(tmp_path: Path) -> None:
    run = shaketable(
        "tilt", "--base-m", 0.72, "--height-m", 3.6, "--motions", "near-field-pulse", cwd=tmp_path
    )
    assert run.returncode == 0, run.stderr
    assert "no curve: its c1 is not positive for a body so large" in run.stdout
    assert "r [m] = 1.84 is outside 0.10 to 0.77" in run.stderr


def width_of(picture: Path) -> int:
    with Image.open(picture) as image:
        return image.width


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--downhill-share", 1.5], "control must lie between 0.5 and 1"),
        (["--tilt-deg", 20], "falls by itself on a support tilted by 20°"),
        (["--tilt-deg", -1], "the tilt must not be negative"),
        (["--tilt-deg", 3, "--plot", "x.png"], "give --downhill-share as well"),
        (["--plot", "x.doc"], "must end in one of"),
        (["--seed", -1], "greater than or equal to 0"),
        (["--shelf-depth-m", 0], "--shelf-depth-m must be a positive"),
        (["--static-friction", 0.3], "only --model general slides"),
        (["--motions", "nowhere"], "neither a file, a folder nor a suite"),
    ],
)
def test_tilt_bad_input(arguments: list, message: str, tmp_path: Path) -> None:
    assert message in refused(*CABINET, *arguments, cwd=tmp_path)


def test_tilt_on_the_floors_of_a_building(tmp_path: Path) -> None:
    """The lowest floor is the ground: what is told of it is what is told without a building."""
    (tmp_path / "house.toml").write_text("storeys = 2\nfirst_period_s = 0.4\ndamping = 0.05\n")
    with_house = shaketable(*CABINET, "--motions", "near-field-pulse", "--building", "house.toml",
                            "--json", cwd=tmp_path)  # fmt: skip
    assert with_house.returncode == 0, with_house.stderr
    told = json.loads(with_house.stdout)
    alone = shaketable(*CABINET, "--motions", "near-field-pulse", "--json", cwd=tmp_path)
    assert [floor.pop("floor") for floor in told["floors"]] == ["0", "1", "2"]
    ground = json.loads(alone.stdout)
    del ground["settings"]
    assert told["floors"][0] == ground
    assert told["floors"][2] != ground
    said = refused(*CABINET, "--building", "house.toml", "--plot", "a.png", cwd=tmp_path)
    assert "leave --building out" in said
    words = shaketable(*CABINET, "--motions", "near-field-pulse", "--building", "house.toml",
                       "--tilt-deg", 2, "--downhill-share", 0.95, cwd=tmp_path).stdout  # fmt: skip
    tilts = {str(k): floor["designed"]["tilt_deg"] for k, floor in enumerate(told["floors"])}
    worst = max(tilts, key=tilts.__getitem__)
    assert f"to {tilts[worst]:.3g}° (floor {worst}); take the steepest" in words
    assert "falls at 2.0°" in words.split("All floors")[1]


@pytest.mark.slow
def test_study_writes_every_result(tmp_path: Path) -> None:
    """In place of an earlier study, and of nothing else."""
    (tmp_path / "result").mkdir()
    precious = tmp_path / "result" / "precious.csv"
    precious.write_text("mine")
    again = (*STUDY, "--out", "result", "--overwrite")
    assert "precious.csv" in refused(*again, cwd=tmp_path)
    # beside earlier results, too
    (tmp_path / "result" / "table_1.csv").write_text("old")
    (tmp_path / "result" / "run.json").write_text(
        json.dumps({"command": "shaketable study", "files": ["run.json", "table_1.csv"]})
    )
    assert "precious.csv" in refused(*again, cwd=tmp_path)
    precious.unlink()
    run = shaketable(*again, cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert (tmp_path / "result" / "table_1.csv").read_text() != "old"
    assert "we find" in run.stdout
    out = tmp_path / "result"
    names = {path.name for path in out.iterdir()}
    assert {"table_1.csv", "table_2.csv", "table_3.csv", "table_5.csv", "study.json"} <= names
    pictures = {f"figure_{number:02d}.png" for number in (2, 3, 4, 5, 6, 7, 8, 9, 10, 13)}
    pictures |= {"open_questions.png", "dimensionless.png"}
    assert {f"{name}.png" for name in FIGURES} == pictures <= names
    assert all(width_of(out / name) > 700 for name in pictures)
    told = json.loads((out / "study.json").read_text())
    assert told["run"]["motions"]["count"] == 28
    assert told["run"]["inputs"] == {"models": {"rocking": repr(Rocking())}}
    for name, rows in told["tables"].items():
        table = pd.read_csv(out / f"{name}.csv")
        assert list(table.columns) == list(rows)
        assert {len(values) for values in rows.values()} == {len(table)}
    assert set(json.loads((out / "run.json").read_text())["files"]) == names
    # an earlier result is kept, unless told otherwise
    run = shaketable(*STUDY, "--out", "result", cwd=tmp_path)
    assert run.returncode == 2
    assert "--overwrite" in run.stderr


@pytest.mark.slow
def test_tilt_in_three_dimensions(tmp_path: Path) -> None:
    box = ("tilt", "--depth-m", 0.25, "--width-m", 0.7, "--height-m", 1.0)
    given = (*box, "--azimuth-deg", 170, "--motions", "near-field-pulse")
    run = shaketable(*given, "--downhill-share", 0.8, "--plot", "tilt.png", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert "14 motions of 14 recordings in both directions, the object turned" in run.stdout
    assert re.search(r"within 45° of it +\d+ % of the falls", run.stdout)
    assert "in three dimensions go by the simulated tilt alone" in run.stderr
    assert width_of(tmp_path / "tilt.png") > 500
    told = json.loads(shaketable(*given, "--tilt-deg", 3, "--json", cwd=tmp_path).stdout)
    assert told["settings"]["depth_m"] == 0.25
    assert told["settings"]["width_m"] == 0.7
    assert told["settings"]["azimuth_deg"] == 170.0
    assert told["settings"]["model"] == "general"
    assert 0.0 < told["asked"]["straight_share"] <= told["asked"]["downhill_share"]
    assert "only in three dimensions" in refused(*CABINET, "--azimuth-deg", 90, cwd=tmp_path)
    said = refused(*CABINET, "--shape", "cylinder", "--building", "b.toml", cwd=tmp_path)
    assert "its floors have one component" in said
