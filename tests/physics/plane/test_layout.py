"""Rows of numbers with names."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest

from shaketable import Body, General
from shaketable.engine.body_tables import BODY, CORNERS, tabulate_corners
from shaketable.models.engine_input import sizes_of
from shaketable.physics.plane.layout import columns, length, struct_view
from shaketable.physics.plane.rocking import Block, Size


class Inner(NamedTuple):
    a: float
    b: float


class Outer(NamedTuple):
    first: float
    inner: Inner
    last: float


def test_columns_count_through() -> None:
    assert length(Outer) == 4
    assert columns(Outer) == Outer(0, Inner(1, 2), 3)
    assert columns(Outer, first=2, step=8) == Outer(2, Inner(10, 18), 26)


def test_names_are_the_same_memory_as_columns() -> None:
    table = np.arange(8.0).reshape(2, 4)
    rows, at = struct_view(table, Outer), columns(Outer)
    assert rows["inner"]["b"].tolist() == table[:, at.inner.b].tolist()
    rows["last"] = -1.0
    assert table[:, at.last].tolist() == [-1.0, -1.0]


def test_tables_hold_what_their_names_say() -> None:
    body = Body.rectangle(0.4, 1.0, eccentricity=0.45)
    size = struct_view(sizes_of([body], 0.9), Size)[0]
    assert (size["left"], size["restitution_factor"]) == (body.left, 0.9)
    model = General(static_friction=0.5, normal_restitution=0.2, restitution_factor=0.9)
    table = model.tabulate([body], np.array([0.1]))
    row = table.bodies[0]
    assert row[BODY.right] == body.right
    assert row[BODY.tilt_sine] == np.sin(0.1)
    assert row[BODY.a_stick] / row[BODY.b_stick] == pytest.approx(0.5, rel=1e-15)
    assert row[BODY.normal_restitution] == 0.2
    block = struct_view(table.blocks, Block)[0]
    assert block["right"]["phase"] == pytest.approx(body.slenderness_right + 0.1, rel=1e-15)
    corners = tabulate_corners(table.bodies)
    radius = np.hypot(body.left, body.cg_height)
    assert corners[0, CORNERS.left.cone.radius] == pytest.approx(radius, rel=1e-15)
    assert corners[0, CORNERS.left.velocity_ratio] == 0.0  # with restitution no impact is plain
