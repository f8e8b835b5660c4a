"""One bookcase, one number: every door gives the same share of falls for the same thing."""

from __future__ import annotations

import json
from pathlib import Path

import pandas as pd
import pytest

from shaketable import InputError, Motion, assess, suite
from shaketable.assess import Walls
from shaketable.assess.walls import WALL_GAP
from shaketable.inventory import RESTITUTION, read_inventory
from shaketable.report.words import headline, method
from shaketable.web import space
from shaketable.web.lists import assess_list
from shaketable.web.questions import Assess, ManyInSpace, Upright
from tests.support.command import shaketable

pytest.importorskip("pebble", reason="the extra web is not installed: pip install '.[web]'")

SUITE = "fema-p695-near-field-pulse"
LIST = "name,depth_m,width_m,height_m\nBookcase,0.32,0.9,1.8\n"


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("doors") / "list.csv"
    path.write_text(LIST)
    return path


@pytest.fixture(scope="module")
def pairs() -> list[Motion]:
    return [each for each in suite(SUITE, pairs=True) if each.transverse is not None]


def share_of(file: Path, pairs: list[Motion], walls: str = "") -> float:
    found = assess(read_inventory(file), pairs, walls=walls, leading=0, progress=False)
    return found.results[0].governing_share.value


def test_python_the_terminal_my_list_and_one_thing(
    file: Path, pairs: list[Motion], tmp_path: Path
) -> None:
    """*One thing* as it begins: a box in all directions that cannot slide."""
    expected = share_of(file, pairs)
    assert 0.1 < expected < 0.9
    run = shaketable(
        "assess", str(file), "--motions", SUITE, "--advise", "0", "--out", str(tmp_path / "out")
    )
    assert run.returncode == 0, run.stderr
    table = pd.read_csv(tmp_path / "out" / "results.csv")
    assert table["governing_share"].tolist() == [pytest.approx(expected, abs=1e-6)]  # six digits
    (tmp_path / "job").mkdir()
    assess_list(Assess(text=LIST, suite=SUITE), str(tmp_path / "job"))
    told = json.loads((tmp_path / "job" / "result.en.json").read_text())
    assert told["objects"][0]["share"] == pytest.approx(expected, abs=1e-12)
    thing = Upright(depth_m=0.32, width_m=0.9, height_m=1.8)
    many = space.many(ManyInSpace(thing=thing, suite=SUITE, curve=False))
    assert many.share == pytest.approx(expected, abs=1e-12)


def test_at_a_wall_every_door_means_the_same_wall(
    file: Path, pairs: list[Motion], tmp_path: Path
) -> None:
    """`--wall yes`, the page's answer, and a list that gives the wall of each."""
    expected = share_of(file, pairs, "yes")
    assert expected < share_of(file, pairs)
    run = shaketable("assess", str(file), "--motions", SUITE, "--advise", "0", "--wall", "yes",
                     "--out", str(tmp_path / "out"))  # fmt: skip
    assert run.returncode == 0, run.stderr
    table = pd.read_csv(tmp_path / "out" / "results.csv")
    assert table["governing_share"].tolist() == [pytest.approx(expected, abs=1e-6)]  # six digits
    assert "As was said, most things stand against a wall" in run.stdout.replace("\n", " ")
    (tmp_path / "job").mkdir()
    assess_list(Assess(text=LIST, suite=SUITE, wall="yes"), str(tmp_path / "job"))
    told = json.loads((tmp_path / "job" / "result.en.json").read_text())
    assert told["objects"][0]["share"] == pytest.approx(expected, abs=1e-12)
    given = tmp_path / "given.csv"
    given.write_text("name,depth_m,width_m,height_m,wall_gap_mm\nBookcase,0.32,0.9,1.8,10\n")
    (item,) = read_inventory(given)
    assert item.surroundings is not None
    (wall,) = item.surroundings.walls
    assert (wall.gap, wall.restitution) == (WALL_GAP, RESTITUTION)
    assert share_of(given, pairs) == pytest.approx(expected, abs=1e-12)


def test_the_strength_of_my_list_is_that_of_the_terminal(tmp_path: Path) -> None:
    (tmp_path / "job").mkdir()
    assess_list(Assess(text=LIST, suite=SUITE, scale=0.5, planar=True), str(tmp_path / "job"))
    page = (tmp_path / "job" / "report" / "report.html").read_text()
    assert "× 0.5" in page


def test_what_was_said_of_walls_stands_in_the_first_lines(file: Path, pairs: list[Motion]) -> None:
    items = read_inventory(file)
    found = assess(items, pairs, leading=1, progress=False)
    assert found.walls is Walls.UNKNOWN
    assert found.crustal
    assert not found.vertical
    first = headline.assumed(found)
    assert first[0].startswith("Do most things stand against a wall? Nobody said so")
    assert "of shallow crustal earthquakes" in first[1]
    assert "the vertical component (with it falls were 1.03 times" in method.not_considered(found)
    (result,) = found.results
    assert result.at_a_wall is not None
    assert result.at_a_wall < result.governing_share
    no = assess(items, pairs, walls="no", leading=0, progress=False)
    assert headline.assumed(no)[0] == "As was said, most things stand free of walls."
    assert no.results[0].governing_share == result.governing_share
    own = [
        Motion(
            each.horizontal, each.time_step, transverse=each.transverse, vertical=each.horizontal
        )
        for each in pairs[:2]
    ]
    others = assess(items, own, leading=0, progress=False)
    assert others.vertical
    assert not others.crustal
    assert not any("crustal" in each for each in headline.assumed(others))
    assert "vertical" not in method.not_considered(others)


def test_answers_that_are_none(file: Path, pairs: list[Motion]) -> None:
    items = read_inventory(file)
    with pytest.raises(InputError, match="is yes, no or each, found 'maybe'"):
        assess(items, pairs, walls="maybe", progress=False)
    with pytest.raises(InputError, match="the list says of nothing how far it stands from a wall"):
        assess(items, pairs, walls="each", progress=False)
    refused = shaketable("assess", str(file), "--wall", "each")
    assert refused.returncode == 2
    assert "--wall: each: the list says of nothing" in refused.stderr.replace("\n", " ")
