"""`shaketable simulate` with motions of the suites, by their names."""

from __future__ import annotations

from pathlib import Path

import pytest

from shaketable import Body, Solid, simulate, suite
from shaketable.cli.response_summary import sentence_of
from shaketable.cli.shaking import DEFAULT_MOTION
from tests.support.command import refused, shaketable

SIZE = ("--base-m", 0.3, "--height-m", 1.8)


def test_without_a_record_one_of_the_suites_is_taken(tmp_path: Path) -> None:
    run = shaketable("simulate", *SIZE, cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    motion = next(each for each in suite("fema-p695") if each.name == DEFAULT_MOTION)
    found = simulate(Body.rectangle(0.3, 1.8), motion)
    assert run.stdout.strip().endswith(f"under {DEFAULT_MOTION}: {sentence_of(found)}")


def test_a_motion_by_its_name_has_both_components_in_space(tmp_path: Path) -> None:
    box = ("--depth-m", 0.3, "--width-m", 0.4, "--height-m", 1.8, "--record", "DUZCE/BOL090")
    run = shaketable("simulate", *box, cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    pairs = suite("fema-p695-both-directions", pairs=True)
    motion = next(each for each in pairs if each.name == "DUZCE/BOL090")
    found = simulate(Solid.box(0.3, 0.4, 1.8), motion)
    assert run.stdout.strip().endswith(sentence_of(found))
    one = shaketable("simulate", *box, "--components", 1, cwd=tmp_path)
    assert one.stdout != run.stdout


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (("--record", "nothere"), "no such file; nor is it a motion of the suites, such as NORTHR"),
        (("--units", "g"), "--units: for a record file; NORTHR/MUL009 is a motion of the suites"),
        (("--components", 3), "--components 3: for a record file"),
        (
            ("--record", "LANDERS/CLW-LN", "--shape", "cylinder"),
            "its second component is not known; give --components 1",
        ),
    ],
)
def test_what_a_motion_of_the_suites_has_not(
    tmp_path: Path, given: tuple[object, ...], said: str
) -> None:
    assert said in refused("simulate", *SIZE, *given, cwd=tmp_path)
