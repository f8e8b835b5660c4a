"""Many solids: the same as one by one, in its place."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from shaketable import (
    Body,
    General,
    InputError,
    Motion,
    Outcome,
    Solid,
    Support,
    simulate,
    simulate_each,
)
from shaketable import simulate_many as many
from shaketable.engine.endings import Ending
from shaketable.models.solid_input import ground_of, shapes_of
from shaketable.physics.space.drive import move_solid
from shaketable.physics.space.ending import PER_EVENT, SENTENCES
from shaketable.physics.space.found import FOUND, STILL_MOVING, make_found, make_trace, numbers_of
from shaketable.physics.space.ground import RunSetup
from shaketable.physics.space.telling import tell
from shaketable.physics.space.workspace import WORKSPACE
from tests.support import random_solids

MODEL = General(static_friction=0.6)


def motions() -> list[Motion]:
    t = np.arange(150) * 0.01
    return [
        Motion(a * np.sin(7 * t), 0.01, transverse=a * np.cos(5 * t) - a, name=f"{a} m/s²")
        for a in (2.0, 5.0)
    ]


def solids() -> list[Solid]:
    return [Solid.box(0.2, 0.3, 1.0, name="box"), Solid.cylinder(0.25, 0.9, name="bottle")]


def test_each_member_is_the_single_run_in_its_place() -> None:
    tilts, scales, orientations = (0.0, 0.03), (0.8, 1.3), (0.0, 0.7)
    runs = many(
        solids(), motions(), tilts=tilts, scales=scales, azimuth=1.0, orientations=orientations,
        model=MODEL, progress=False,
    )  # fmt: skip
    assert runs.outcome.dims == ("body", "motion", "polarity", "tilt", "scale", "orientation")
    fell = 0
    for index in np.ndindex(runs.outcome.shape):
        solid, motion = solids()[index[0]], motions()[index[1]].scaled(scales[index[4]])
        single = simulate(
            solid,
            motion if runs.polarity[index[2]] == 1 else motion.reversed(),
            Support(tilt=tilts[index[3]], azimuth=1.0),
            model=MODEL,
            orientation=orientations[index[5]],
        )
        assert runs.outcome.to_numpy()[index] == single.outcome
        assert runs.peak_rotation.to_numpy()[index] == single.peak_rotation
        assert runs.yaw.to_numpy()[index] == single.yaw
        assert runs.displacement_x.to_numpy()[index] == single.displacement_x
        fell += single.outcome is not Outcome.STANDING
    assert 0 < fell < runs.outcome.size


def test_members_side_by_side_are_those_of_the_product() -> None:
    """Everything differs between members; the order of the runs does not matter to them."""
    every = many(
        solids(), motions(), tilts=(0.0, 0.03), scales=(0.8, 1.3), azimuth=1.0,
        orientations=(0.0, 0.7), model=MODEL, progress=False,
    )  # fmt: skip
    places = list(np.ndindex(every.outcome.shape))[::-3]
    body, motion, polarity, tilt, scale, turn = np.transpose(places)
    found = simulate_each(
        [solids()[k] for k in body], [motions()[k] for k in motion],
        tilts=every.tilt.values[tilt], scales=every.scale.values[scale], azimuths=1.0,
        polarities=every.polarity.values[polarity],
        orientations=every.orientation.values[turn], model=MODEL, progress=False,
    )  # fmt: skip
    for name in every:
        assert np.array_equal(
            found[name], every[name].values[tuple(np.transpose(places))], equal_nan=True
        ), name


def test_side_by_side_on_supports_of_any_azimuth() -> None:
    """A quiet ground and a tilt that slides a box: it goes downhill, wherever that is."""
    azimuths = np.array([0.3, 2.0, -1.0])
    still = Motion(np.zeros(50), 0.01, transverse=np.zeros(50))
    found = simulate_each(
        Solid.box(1.0, 1.0, 0.2), still, tilts=0.3, azimuths=azimuths,
        model=General(static_friction=0.2), progress=False,
    )  # fmt: skip
    toward = np.arctan2(found.displacement_y, found.displacement_x)
    assert toward.values == pytest.approx(azimuths, abs=1e-12)  # nothing pushes it aside


def test_threads_do_not_matter() -> None:
    one, two = (
        many(solids(), motions(), model=MODEL, progress=False, threads=threads)
        for threads in (1, 2)
    )
    assert one.identical(two)


@pytest.mark.parametrize(
    ("run", "said"),
    [
        (lambda: many([Solid.box(1, 1, 1), Body.rectangle(1, 2)], motions()), "not a planar Body"),
        (lambda: many([Solid.box(1, 1, 1)], motions(), model="rocking"), "one edge"),
        (lambda: many([Solid.box(1, 1, 1)], motions(), device="gpu"), "unknown device"),
        (lambda: many([Solid.box(1, 1, 1)], motions(), polarities=(2,)), "1 or -1"),
        (lambda: many([Solid.box(0.2, 0.9, 1)], motions(), tilts=(0.3,)), "falls by itself"),
        (lambda: many([Body.rectangle(1, 2)], motions(), azimuth=1.0), "to Solids only"),
        (lambda: many([Body.rectangle(1, 2)], motions(), orientations=(0.1,)), "to Solids only"),
        (lambda: simulate_each(Body.rectangle(1, 2), motions(), azimuths=1.0), "to Solids only"),
        (lambda: simulate_each(Solid.box(0.2, 0.9, 1), motions(), tilts=0.3), "falls by itself"),
        (lambda: simulate_each([*solids(), Body.rectangle(1, 2)], motions()[0]), "planar Body"),
    ],
)
def test_bad_input(run, said: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(InputError, match=said):
        run()


def test_one_component_alone_is_told(caplog: pytest.LogCaptureFixture) -> None:
    many(solids(), [Motion(np.zeros(5), 0.01)], progress=False)
    assert "1 of 1 motions have one horizontal component alone" in caplog.text


def test_what_still_rolls_is_given_up_and_told(caplog: pytest.LogCaptureFixture) -> None:
    """A cylinder that wobbles without slip loses nothing."""
    push = np.zeros(60)
    push[:25] = 5.0
    found = many(
        [Solid.cylinder(0.3, 0.6)], [Motion(push, 0.01, transverse=0.7 * push[::-1])],
        model=General(), polarities=(1,), progress=False,
    )  # fmt: skip
    assert (found.ending == Ending.STILL_ROCKING).all()
    assert (found.outcome == Outcome.STANDING).all()
    assert "1 of 1 simulations still moved when given up" in caplog.text


@pytest.mark.slow
def test_a_run_has_a_budget_of_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is given up in its shaking tells where it was then, as still moving.

    Only the outermost loop is run as Python, with a budget that a usual run exceeds.
    """
    from shaketable.physics.space import run as engine

    monkeypatch.setattr(engine, "MOST_STEPS", 40)
    monkeypatch.setattr(engine, "PER_SAMPLE", 0)
    push = np.full(200, 6.0)
    motion = Motion(push, 0.01, transverse=0.3 * push)
    shapes, workspaces = shapes_of(Solid.box(0.4, 0.4, 1.0), General(static_friction=0.7))
    nothing = make_trace(0)
    found = make_found(1)
    shape, work = shapes[0], workspaces[0]
    engine.place(shape, work, 0.0)
    stand = RunSetup(0.0, math.pi, 0.0, 1.0, 1.0)
    engine.run.py_func(shape, work, ground_of(motion), stand, nothing)
    tell.py_func(shape, work, found[0])
    told = numbers_of(found)
    assert told.ending == STILL_MOVING
    assert told.steps + PER_EVENT * told.events < 40 + 1_000  # the last interval's
    assert 0 < told.samples < 200
    assert (told.shaken_x, told.shaken_y) == (told.displacement_x, told.displacement_y) != (0, 0)
    assert "200,000 steps and" in SENTENCES[STILL_MOVING]


def spoil(numbers: NDArray[Any]) -> None:
    """Fill numbers, or all fields of records, with what no run may read."""
    for name in numbers.dtype.names or ():
        spoil(numbers[name])
    if not numbers.dtype.names:
        numbers[...] = np.nan if numbers.dtype.kind == "f" else 7


def test_a_run_does_not_see_what_lay_in_its_room() -> None:
    """A device's memory holds anything; each number of a room is written before it is read."""
    nothing = make_trace(0)
    compared = 0
    for seed in range(40):
        shaken = random_solids.case(seed, castors=seed % 2 == 1)
        if shaken is None:
            continue
        shapes, clean = shapes_of(shaken.solid, shaken.model)
        spoilt = clean.copy()
        for name in "xy":
            spoilt["points"][name][0, shapes[0]["contacts"] :] = np.nan
        for name in set(WORKSPACE.names or ()) - {"points"}:
            spoil(spoilt[name])
        found = np.full((2, 1), 7, FOUND)
        for workspaces, one in zip((clean, spoilt), found, strict=True):
            move_solid(
                shapes, workspaces, ground_of(shaken.motion), shaken.stand, False, nothing, one
            )
        for name in FOUND.names or ():
            np.testing.assert_array_equal(*found[name], name)
        compared += 1
    assert compared > 20
