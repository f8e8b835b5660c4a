"""Draws over events and over the recordings within each."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from shaketable import Motion, Origin
from shaketable.resampling import events_of, nested_resamples, recordings_of, sums_of_groups


def test_events_of_p695(p695: list[Motion]) -> None:
    """FEMA P-695: 50 recordings of 19 events, by the names of the set."""
    events = events_of(p695)
    assert events.size == 50
    assert events.max() + 1 == 19


def test_an_unknown_event_is_one_of_its_own() -> None:
    motion = Motion(np.zeros(4), 0.1)
    known = replace(motion, origin=Origin(event="Kobe", station="JMA"))
    other = replace(motion, origin=Origin(event="Kobe", station="Takatori"))
    assert events_of([known, motion, other, motion]).tolist() == [0, 1, 0, 2]


def test_a_draw_takes_whole_numbers_of_each() -> None:
    """Three events of 1, 2 and 3 recordings: a draw of an event takes as many as it has."""
    event = np.array([0, 1, 1, 2, 2, 2])
    weights = nested_resamples(event, 4000, seed=2)
    assert (weights[0] == 1.0).all()
    drawn = weights[1:]
    totals = np.stack([drawn[:, event == k].sum(axis=1) for k in range(3)], axis=1)
    sizes = np.array([1, 2, 3])
    assert (totals % sizes == 0).all()
    assert ((totals / sizes).sum(axis=1) == 3).all()
    # every recording is taken once in the mean; its variance is that of both stages, and the
    # mean of 4,000 draws has a standard error below 0.03
    assert drawn.mean(axis=0) == pytest.approx(np.ones(6), abs=0.1)


def test_like_recordings_of_one_event_do_not_narrow_an_interval() -> None:
    """Twenty events, each recorded five times alike: the mean varies as that of twenty."""
    event = np.repeat(np.arange(20), 5)
    values = np.repeat(np.random.default_rng(0).normal(size=20), 5)
    drawn = nested_resamples(event, 2000, seed=1)[1:]
    spread = (drawn @ values / drawn.sum(axis=1)).std()
    # 2,000 draws know a standard deviation to 1.6 %; four times that
    assert spread == pytest.approx(values.std() / np.sqrt(20), rel=0.065)


def test_names_that_differ_in_blanks_or_case_are_one(p695: list[Motion]) -> None:
    """44 recordings were made of 22 by a blank behind an event's name."""

    def named(motion: Motion, event: str, station: str) -> Motion:
        origin = replace(motion.origin or Origin(), event=event, station=station)
        return replace(motion, origin=origin)

    one = named(p695[0], "Loma Prieta", "Gilroy 3")
    two = named(p695[1], " Loma  Prieta ", "GILROY 3 ")
    other = named(p695[2], "Loma Prieta", "Gilroy 4")
    assert recordings_of([one, two, other]).tolist() == [0, 0, 1]
    assert events_of([one, two, other]).tolist() == [0, 0]


def test_a_draw_takes_recordings_within_its_events_anew() -> None:
    """Of one event each draw would be the observation itself, had it no inner draw."""
    weights = nested_resamples(np.zeros(6, np.intp), 200, seed=1)[1:]
    assert (weights.sum(axis=1) == 6).all()
    assert len({tuple(row) for row in weights.tolist()}) > 100
    some = nested_resamples(np.repeat([0, 1], 3).astype(np.intp), 20_000, seed=2)[1:]
    # given E ~ Binomial(2, 1/2) takes of its event, a recording has Binomial(3 E, 1/3):
    # variance = E[3E] (1/3)(2/3) + var(E) = 2/3 + 1/2; 4 standard errors of 20,000 draws are 0.06
    assert some[:, 0].var() == pytest.approx(2 / 3 + 1 / 2, abs=0.06)


def test_sums_of_groups() -> None:
    """Against a sum over each group by itself."""
    rng = np.random.default_rng(3)
    values, group = rng.integers(-5, 9, (50, 3, 2)), rng.choice([0, 2, 3, 7], 50)
    found = sums_of_groups(values, group)
    assert len(found) == 4
    for k, number in enumerate((0, 2, 3, 7)):
        assert (found[k] == values[group == number].sum(axis=0)).all()
