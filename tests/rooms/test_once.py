"""One shaking of a room: its poses in the plan, its film and its scene."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pygltflib
import pytest
from PIL import Image
from scipy.spatial.transform import Rotation

from shaketable import InputError, Motion, Outcome
from shaketable.plot.room_film import animate_room
from shaketable.plot.room_gltf import write_room_gltf
from shaketable.records import suite
from shaketable.rooms import RoomShaken, assess_room, shake_once
from shaketable.rooms.shapes import foot_of, own_angle
from tests.rooms.test_assessment import MODEL, ROOM


@pytest.fixture(scope="module")
def pairs() -> list[Motion]:
    known = [m for m in suite("fema-p695", pairs=True) if m.transverse is not None]
    return [m.scaled(1.5) for m in sorted(known, key=lambda m: m.duration)[:6]]


@pytest.fixture(scope="module")
def shaken(pairs: list[Motion]) -> RoomShaken:
    return shake_once(ROOM, pairs[2], model=MODEL)


@pytest.mark.parametrize("north", [ROOM.north, None])
def test_the_worst_run_falls_as_it_did_among_all(pairs: list[Motion], north: float | None) -> None:
    """Which things fall in it, and to which side; where north is not known in its direction."""
    room = replace(ROOM, north=north)
    found = assess_room(room, pairs, model=MODEL, progress=False)
    worst = found.worst
    motion = next(each for each in pairs if each.name == worst.motion)
    motion = motion.reversed() if worst.reversed else motion
    once = shake_once(room, motion, along=worst.along, model=MODEL)
    fell = [each.response.outcome is not Outcome.STANDING for each in once.things]
    assert sum(fell) == worst.falls > 0
    if north is not None:  # that direction is the one that its azimuth says
        again = shake_once(room, motion, model=MODEL)
        assert again.along == pytest.approx(worst.along)


def test_it_begins_where_the_plan_has_it_and_ends_where_it_fell(shaken: RoomShaken) -> None:
    for each in shaken.things:
        run = each.response
        position, quaternions = each.poses(np.array([0.0, 1e9]))
        foot = foot_of(each.thing, ROOM)
        np.testing.assert_allclose(position[0], [*foot, each.thing.item.body.cg_height], atol=1e-9)
        turn = Rotation.from_quat(quaternions[0]).as_euler("ZYX")
        expected = math.remainder(own_angle(each.thing, ROOM), 2 * math.pi)
        assert math.remainder(turn[0] - expected, 2 * math.pi) == pytest.approx(0.0, abs=1e-9)
        # after its end it stays, as far as the response says, turned into the plan
        x, y = run.displacement_x, run.displacement_y
        if run.outcome is Outcome.STANDING:
            c, s = math.cos(each.along), math.sin(each.along)
            np.testing.assert_allclose(
                position[1][:2] - foot, [c * x - s * y, s * x + c * y], atol=1e-3
            )
        else:
            axis = Rotation.from_quat(quaternions[1]).apply([0.0, 0.0, 1.0])
            toward = math.atan2(axis[1], axis[0])
            assert math.remainder(
                toward - run.fall_azimuth - each.along, 2 * math.pi
            ) == pytest.approx(0.0, abs=0.35)  # over a corner the axis leans beside the fall


def test_what_is_not_simulated_is_not_among_them(pairs: list[Motion]) -> None:
    left, right = ROOM.things
    held = replace(left, item=replace(left.item, anchored=True))
    once = shake_once(replace(ROOM, things=(held, right)), pairs[0], model=MODEL)
    assert [each.thing.name for each in once.things] == ["right"]
    with pytest.raises(InputError, match="both horizontal components"):
        shake_once(ROOM, replace(pairs[0], transverse=None), model=MODEL)


@pytest.mark.slow  # 5 s; that a film is drawn is quick, in tests/cli/test_room.py
def test_the_film_shows_things_move_in_both_views(shaken: RoomShaken, tmp_path: Path) -> None:
    """Over the white paper around the room nothing is drawn; within it pictures differ."""
    path = animate_room(shaken, tmp_path / "room.gif")
    with Image.open(path) as film:
        assert film.n_frames > 20
        first = np.asarray(film.convert("RGB"), np.int16)
        film.seek(film.n_frames - 1)
        last = np.asarray(film.convert("RGB"), np.int16)
    moved = np.abs(first - last).max(axis=2) > 60
    above_trace = moved[: int(0.75 * len(moved))]
    half = above_trace.shape[1] // 2
    assert above_trace[:, :half].sum() > 500
    assert above_trace[:, half:].sum() > 500
    assert (np.abs(last - [214, 94, 0]).sum(axis=2) < 120).sum() > 300  # what has fallen


def test_the_scene_has_every_thing_where_it_stands(shaken: RoomShaken, tmp_path: Path) -> None:
    made = pygltflib.GLTF2().load(str(write_room_gltf(shaken, tmp_path / "room.glb")))
    assert made is not None
    nodes = {node.name: node for node in made.nodes}
    assert {"left", "right", "walls", "level ground"} <= nodes.keys()
    for each in shaken.things:
        foot = foot_of(each.thing, ROOM)
        place = nodes[each.thing.name].translation
        np.testing.assert_allclose(place[:2], foot, atol=2e-3)  # just before it moves
    assert len(made.animations[0].channels) == 4  # place and turn of two things
    with pytest.raises(InputError, match="must end in"):
        write_room_gltf(shaken, tmp_path / "room.obj")
    with pytest.raises(InputError, match="must end in"):
        animate_room(shaken, tmp_path / "room.avi")
