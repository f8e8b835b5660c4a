"""Solids on tilted supports: which way they fall, and what it costs."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import Body, InputError, Motion, Outcome, Solid, simulate_many
from shaketable.models import General
from shaketable.records import suite
from shaketable.resampling import recordings_of
from shaketable.simulate import ShakingSet
from shaketable.tilting import TURNS, design_tilt, tilt_effect
from shaketable.tilting.stands import SolidStand
from shaketable.units import radians

SHELF = Solid.box(0.25, 0.7, 1.0, name="shelf")


@pytest.fixture(scope="module")
def pairs() -> list[Motion]:
    return [m for m in suite("fema-p695", pairs=True)[:10] if m.transverse is not None]


def test_counts_are_those_of_the_simulations(pairs: list[Motion]) -> None:
    tilts = np.radians([0.0, 3.0])
    counts = SolidStand(SHELF, 0.5, ShakingSet(pairs, 1.2, General())).count(tilts, False)
    fell = np.zeros((3, tilts.size))
    for turn in np.arange(TURNS) * math.pi / TURNS:
        runs = simulate_many(
            [SHELF], pairs, tilts=tilts, scales=1.2, azimuth=0.5 + turn, orientations=turn,
            progress=False,
        ).squeeze()  # fmt: skip
        away = np.abs(np.remainder(runs.fall_azimuth - 0.5 - turn + math.pi, 2 * math.pi) - math.pi)
        for k, which in enumerate(
            (runs.outcome != Outcome.STANDING, runs.outcome == Outcome.DOWNHILL, away < radians(45))
        ):
            fell[k] += which.sum(["motion", "polarity"]).transpose("tilt").values
    assert counts.straight is not None
    found = (counts.falls, counts.downhill, counts.straight)
    assert [each.sum(axis=(0, 2)).tolist() for each in found] == fell.tolist()
    assert fell[0].min() > 0
    assert counts.simulations.sum() == 2 * TURNS * len(pairs)
    assert counts.recordings == recordings_of(pairs).max() + 1


def test_an_oblong_is_controlled_across_and_not_along(pairs: list[Motion]) -> None:
    """As the study of solids finds: along its length a tilt hardly chooses the side."""
    across = tilt_effect(SHELF, pairs, radians(4.0), azimuth=math.pi, scale=1.5, progress=False)
    along = tilt_effect(SHELF, pairs, radians(4.0), azimuth=math.pi / 2, scale=1.5, progress=False)
    assert across.downhill_share > 0.9 > along.downhill_share
    assert across.straight_share > 0.9
    assert along.straight_share < 0.3  # most go over the long sides
    assert across.likelier > along.likelier


@pytest.mark.slow
def test_the_design_of_a_square_and_of_its_plane(pairs: list[Motion]) -> None:
    square = Solid.box(0.25, 0.25, 1.0)
    design = design_tilt(square, pairs, scale=1.5, control=0.8, progress=False)
    assert design.turns == TURNS
    assert design.effect is not None
    assert design.effect.downhill_share >= 0.8
    assert design.effect.straight_share <= design.effect.downhill_share
    assert design.level.downhill_share == pytest.approx(0.5, abs=0.02)  # each motion counts twice
    assert (
        design.gcor_tilt
        == design_tilt(Body.rectangle(0.25, 1.0), pairs, control=0.8, progress=False).gcor_tilt
    )


@pytest.mark.parametrize(
    ("solid", "azimuth", "left", "right"),
    [
        (SHELF, math.pi, 0.125, 0.125),
        (SHELF, math.pi / 2, 0.35, 0.35),
        (Solid.cylinder(0.3, 1.0), 1.0, 0.15, 0.15),
        (Solid.box(0.4, 0.7, 1.0, eccentricity=(0.25, 0.5)), math.pi, 0.1, 0.3),
        (Solid.box(0.4, 0.7, 1.0, eccentricity=(0.25, 0.5)), 0.0, 0.3, 0.1),
        # toward the corner of a square it stands as far as the corner is away
        (Solid.box(0.2, 0.2, 1.0), math.pi / 4, 0.1 * math.sqrt(2), 0.1 * math.sqrt(2)),
    ],
)
def test_sections(solid: Solid, azimuth: float, left: float, right: float) -> None:
    body = SolidStand(solid, azimuth, ShakingSet([Motion([0.0, 0.0], 0.01)], 1.0, General())).body
    assert (body.left, body.right) == pytest.approx((left, right))
    assert body.cg_height == solid.cg_height


def test_what_it_cannot_do(pairs: list[Motion]) -> None:
    with pytest.raises(InputError, match="Solid needs General"):
        design_tilt(SHELF, pairs, model="rocking")
    with pytest.raises(InputError, match="azimuth= applies to Solids"):
        tilt_effect(Body.rectangle(0.25, 1.0), pairs, 0.05, azimuth=0.0)
    with pytest.raises(InputError, match="falls by itself"):
        tilt_effect(SHELF, pairs, radians(15.0), progress=False)
