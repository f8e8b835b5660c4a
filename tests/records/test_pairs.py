"""Both horizontal components of a recording as one motion."""

from __future__ import annotations

import logging
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from shaketable import Motion, suite
from shaketable.origin import Origin
from shaketable.records.pairs import paired

X, Y = np.random.default_rng(0).normal(size=(2, 300))


def component(series: np.ndarray, azimuth: float | None, **about: object) -> Motion:
    told = {"event": "quake", "station": "here", "azimuth": azimuth, **about}
    return Motion(series, 0.01, name=f"{azimuth}", origin=Origin(**told))


@pytest.mark.parametrize("order", [1, -1])
@pytest.mark.parametrize(("along", "across"), [(90.0, 0.0), (9.0, 279.0), (45.5, 315.0)])
def test_transverse_is_to_the_left_of_horizontal(along: float, across: float, order: int) -> None:
    """East and north: x is east (90°), y north (0°), whichever comes first."""
    given = [component(X, along), component(Y, across)]
    (pair,) = paired(given[::order])
    assert pair.name == f"{along}"
    assert np.array_equal(pair.horizontal, X)
    assert np.array_equal(pair.transverse, Y)
    assert pair.origin is not None
    assert pair.transverse_origin is not None
    assert (pair.origin.azimuth, pair.transverse_origin.azimuth) == (along, across)


@pytest.mark.parametrize(
    "others",
    [
        [component(Y, None)],
        [component(Y, 30.0)],
        [component(Y, 0.0, station="there")],
        [component(Y, 0.0, location="roof")],
        [component(Y, 0.0, start=0.5)],
        [component(Y, 0.0), component(Y, 180.0)],  # either would fit
        [],
    ],
)
def test_what_is_no_pair_stays_alone(
    others: list[Motion], caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING):
        found = paired([component(X, 90.0), *others])
    assert [motion.transverse for motion in found] == [None] * (1 + len(others))
    assert f"{1 + len(others)} of {1 + len(others)} motions have no transverse" in caplog.text


def test_lengths_and_steps_are_made_equal() -> None:
    """The shorter is padded, the coarser interpolated at the finer step; the origins say so."""
    (pair,) = paired([component(X, 90.0), component(Y[:200], 0.0)])
    assert pair.transverse is not None
    assert np.array_equal(pair.transverse, np.pad(Y[:200], (0, 100)))
    assert pair.transverse_origin is not None
    assert "100 zeros added" in pair.transverse_origin.processing[-1]
    coarse = replace(component(Y[::2], 0.0), time_step=0.02)
    (pair,) = paired([component(X, 90.0), coarse])
    assert pair.transverse is not None
    assert pair.time_step == 0.01
    assert pair.transverse[:-1:2] == pytest.approx(Y[::2])


def test_the_vertical_component_is_kept() -> None:
    up = replace(component(Y, 0.0), vertical=X + Y, vertical_origin=Origin(component="UP"))
    (pair,) = paired([component(X, 90.0), up])
    assert np.array_equal(pair.vertical, X + Y)
    assert pair.vertical_origin == Origin(component="UP")


def test_pairs_of_fema_p695(caplog: pytest.LogCaptureFixture) -> None:
    """50 recordings; of two the azimuths are not told (longitudinal, transverse)."""
    found = suite("fema-p695", pairs=True)
    pairs = [motion for motion in found if motion.transverse is not None]
    assert len(pairs) == 48
    assert "4 of 100 motions have no transverse component" in caplog.text
    for motion in pairs:
        assert motion.origin is not None
        assert motion.transverse_origin is not None
        assert motion.origin.azimuth is not None
        assert motion.transverse_origin.azimuth is not None
        assert (motion.origin.azimuth - motion.transverse_origin.azimuth) % 360.0 == 90.0
    # the Chi-Chi records say E and N
    chichi = next(motion for motion in pairs if motion.name == "CHICHI/TCU045-E")
    assert chichi.transverse_origin is not None
    assert chichi.transverse_origin.component == "N"


def test_pairs_of_a_folder(tmp_path: Path, p695: list[Motion]) -> None:
    for motion in p695[:4]:
        assert motion.origin is not None
        rows = "\n".join(f"{a:.6e}" for a in motion.horizontal)
        name = motion.name.replace("/", "_")
        (tmp_path / f"{name}.csv").write_text(f"acceleration\n{rows}\n")
    found = suite(tmp_path, units="m/s2", time_step=0.01, pairs=True)
    assert len(found) == 4  # columns of numbers tell no azimuth: nothing is guessed
    again = suite(tmp_path, units="m/s2", time_step=0.01, pairs=True)  # from the cache
    assert [motion.name for motion in again] == [motion.name for motion in found]
