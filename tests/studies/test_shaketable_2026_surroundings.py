"""What walls and straps change, on a few of FEMA P-695's pairs."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd
import pytest

from shaketable import Body, Edge, General, Motion, Outcome, Surroundings, Wall, simulate_many
from shaketable.study import NO, OPEN, YES, Study, StudyInput, installed_studies
from shaketable_studies.shaketable_2026_solids.setting import pairs_of
from shaketable_studies.shaketable_2026_surroundings import cases
from shaketable_studies.shaketable_2026_surroundings.claims import (
    _caught,
    _lip_keeps,
    _slack,
    _static,
    _turned,
    _wall_helps,
    _weak,
)
from shaketable_studies.shaketable_2026_surroundings.lips import DROP, LIPS, count_lips, lips
from shaketable_studies.shaketable_2026_surroundings.setting import BOOKCASE, FRICTION, MODEL

FEW = 2  # recordings


@pytest.fixture(scope="module")
def some(p695: list[Motion]) -> list[Motion]:
    return p695[: 2 * FEW]


# all that ask for it are slow: it takes 20 s
@pytest.fixture(scope="module", params=[pytest.param("", marks=pytest.mark.slow)])
def study(some: list[Motion]) -> Study:
    given = StudyInput(motions=some, description="FEMA P-695", progress=False)
    return installed_studies()["shaketable-2026-surroundings"].do(given)


def test_falls_beside_walls_are_those_of_the_simulations(study: Study, some: list[Motion]) -> None:
    pairs = pairs_of(some, 0)
    walls = study.tables["walls"]
    around = Surroundings(walls=(Wall(gap=0.05, friction=FRICTION, restitution=0.3),))
    runs = simulate_many(
        [BOOKCASE], pairs.motions, scales=[2.0], model=MODEL, azimuth=0.0, surroundings=around,
        progress=False,
    )  # fmt: skip
    here = walls[(walls["gap_mm"] == 50.0) & (walls["restitution"] == 0.3)]
    row = here[here["scale"] == 2.0].iloc[0]
    assert row["runs"] == 2 * FEW
    assert row["falls"] == int((runs.outcome != int(Outcome.STANDING)).sum())
    assert row["to_the_wall"] == int((runs.outcome == int(Outcome.DOWNHILL)).sum())
    assert row["fall_share"] == pytest.approx(row["falls"] / row["runs"])
    assert row["low"] <= row["fall_share"] <= row["high"]
    free = simulate_many([BOOKCASE], pairs.motions, scales=[2.0], model=MODEL, azimuth=0.0,
                         progress=False)  # fmt: skip
    change = row["fall_share"] - float((free.outcome != int(Outcome.STANDING)).mean())
    assert row["change_low"] <= change <= row["change_high"]


def test_every_case_is_there_and_counted(study: Study, some: list[Motion]) -> None:
    tables = study.tables
    rows = sum(len(tables[name]) for name in ("walls", "straps", "weak_straps", "tilts"))
    bare = len(cases.HELD_AT) * len(cases.SCALES)  # walls alone, beside which straps break
    assert (rows + bare) * 2 * FEW == cases.count_all(FEW)
    held = tables["straps"]
    assert (held["falls"] == 0).all()  # no strap breaks
    assert (held["force_50"] <= held["force_90"]).all()
    assert (tables["weak_straps"]["broke"] > 0).any()


def test_falls_off_a_shelf_are_those_of_the_simulations(some: list[Motion]) -> None:
    pairs = pairs_of(some, 0)
    done: list[int] = []
    table = lips(pairs, done.append)
    assert sum(done) == count_lips(FEW) == len(table) * 2 * FEW
    around = Surroundings(edge=Edge(at=0.11, azimuth=math.pi, lip=0.005, drop=DROP))
    runs = simulate_many(
        [Body.rectangle(0.12, 0.30)], [motion.components()[0] for motion in pairs.motions],
        scales=[2.0], model=General(static_friction=0.2), surroundings=around, progress=False,
    )  # fmt: skip
    here = table[(table["thing"] == "slender") & (table["friction"] == 0.2)]
    row = here[(here["scale"] == 2.0) & (here["lip_mm"] == 5.0)].iloc[0]
    assert row["falls"] == int((runs.outcome != int(Outcome.STANDING)).sum())
    assert row["off_edge"] == int(runs.off_edge.sum())
    assert row["low"] <= row["fall_share"] <= row["high"]
    assert sorted(here["lip_mm"].unique()) == [1e3 * lip for lip in LIPS]


def test_claims_come_out_either_way() -> None:
    def wall(gap: float, falls: int, low: float, high: float, toward: int = 0) -> dict[str, object]:
        return {
            "gap_mm": gap, "restitution": 0.3, "scale": 1.0, "runs": 40, "falls": falls,
            "low": low, "high": high, "to_the_wall": toward,
        }  # fmt: skip

    free = wall(np.nan, 20, 0.4, 0.6)
    for near, holds in (((2, 0.0, 0.1), YES), ((38, 0.9, 1.0), NO), ((18, 0.3, 0.5), OPEN)):
        table = pd.DataFrame([free, wall(10.0, *near)])
        assert _wall_helps(table, 1.0).holds is holds
    assert _turned(pd.DataFrame([free, wall(10.0, 4, 0, 1)])).holds is YES
    assert _turned(pd.DataFrame([free, wall(10.0, 4, 0, 1, 1)])).holds is NO
    assert _turned(pd.DataFrame([free])).holds is OPEN

    def strap(slack: float, force: float) -> dict[str, object]:
        return {
            "gap_mm": 10.0, "stiffness_per_mass": 500.0, "scale": 1.0, "slack_mm": slack,
            "force_90": force,
        }  # fmt: skip

    for forces, static, slack in (((0.5, 0.9), NO, YES), ((0.02, 0.01), YES, NO)):
        table = pd.DataFrame([strap(0.0, forces[0]), strap(20.0, forces[1])])
        assert _static(table, 1.0).holds is static
        assert _slack(table).holds is slack
    for low, high, holds in ((0.1, 0.2, YES), (-0.2, -0.1, NO), (-0.1, 0.1, OPEN)):
        weak = {"saved": [3], "harmed": [1], "change_low": [low], "change_high": [high]}
        assert _weak(pd.DataFrame(weak)).holds is holds

    def tilted(tilt: float, falls: int, gap: float = 10.0) -> dict[str, object]:
        return {
            "scale": 1.0, "wall": "vertical", "tilt_deg": tilt, "gap_mm": gap, "falls": falls,
            "runs": 40, "low": (falls - 2) / 40, "high": (falls + 2) / 40,
        }  # fmt: skip

    for level, at_3, holds in ((9, 2, YES), (2, 9, NO), (2, 3, OPEN)):
        assert _caught(pd.DataFrame([tilted(0.0, level), tilted(3.0, at_3)])).holds is holds

    def edge(lip: float, falls: int, low: float, high: float) -> dict[str, object]:
        return {
            "thing": "squat", "friction": 0.2, "scale": 2.0, "lip_mm": lip, "runs": 40,
            "falls": falls, "off_edge": falls, "low": low, "high": high,
        }  # fmt: skip

    for near, holds in (((1, 0.0, 0.1), YES), ((38, 0.9, 1.0), NO), ((18, 0.3, 0.5), OPEN)):
        table = pd.DataFrame([edge(0.0, 20, 0.4, 0.6), edge(5.0, *near)])
        assert _lip_keeps(table, "squat").holds is holds
