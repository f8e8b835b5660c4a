"""Large inventories: memory, and the same results however many objects are taken at a time."""

from __future__ import annotations

import logging
import tracemalloc
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from shaketable import Body, General, Motion
from shaketable.assess import CastorFriction, Weights, assess
from shaketable.assess.floor import floor_of
from shaketable.assess.results_table import table_of
from shaketable.inventory import Castors, Item
from shaketable.models import Model
from shaketable.records import suite
from shaketable.tilting import counts
from tests.support.stub import Stub

MOTIONS = [Motion(np.sin(np.arange(40.0) + k), 0.02, name=f"{k}") for k in range(3)]


def objects(number: int) -> list[Item]:
    return [
        Item(body=Body.rectangle(0.2 + 1e-4 * k, 1.5, name=f"object {k}"), height=1.5)
        for k in range(number)
    ]


def memory_of(number: int) -> tuple[int, int]:
    """Bytes that remain with the results, and the most that were used beside them."""
    items = objects(number)
    tracemalloc.start()
    result = assess(items, MOTIONS, model=Stub(), progress=False)
    held, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert len(result.results) == number
    return held, peak - held


def test_memory_does_not_grow_with_the_objects(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(counts, "BODIES_AT_ONCE", 16)
    memory_of(1)  # imports
    held, beside = memory_of(16)
    most_held, most_beside = memory_of(128)
    # 9 curves over 41 tilts, 3 kB, and small things: 9 to 10 kB were measured; the draws of one
    # curve (a thousand times 41 tilts), which must not be kept, would be 328 kB
    assert (most_held - held) / 112 < 15_000
    # one group of 16 objects at a time: 112 more would need 8 times as much if they were kept
    assert most_beside < 1.5 * beside


@pytest.mark.parametrize(
    "model", ["rocking", General(static_friction=0.3)], ids=["rocks", "slides"]
)
def test_results_do_not_depend_on_the_groups(
    p695: list[Motion], monkeypatch: pytest.MonkeyPatch, model: Model
) -> None:
    items = objects(5)
    whole = assess(items, p695[:8], model=model, progress=False).table
    monkeypatch.setattr(counts, "SIMULATIONS_AT_ONCE", 100)  # fewer than those of one object
    pd.testing.assert_frame_equal(assess(items, p695[:8], model=model, progress=False).table, whole)
    monkeypatch.setattr(counts, "SIMULATIONS_AT_ONCE", 2_000)  # three groups
    pd.testing.assert_frame_equal(assess(items, p695[:8], model=model, progress=False).table, whole)


def test_a_warning_is_told_once(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(counts, "BODIES_AT_ONCE", 2)
    with caplog.at_level(logging.WARNING):
        assess(objects(6), MOTIONS, model=Stub(), progress=False)
    told = [record.getMessage() for record in caplog.records]
    assert told  # of few recordings
    assert len(told) == len(set(told))


@pytest.fixture(scope="module")
def pairs() -> list[Motion]:
    return [m for m in suite("fema-p695", pairs=True)[:6] if m.transverse is not None]


@pytest.mark.parametrize("planar", [True, False])
def test_what_moves_alike_is_simulated_once(pairs: list[Motion], planar: bool) -> None:
    """Names, rooms, numbers and what they mean to people are each one's own."""
    trolley = Item(
        body=Body.rectangle(0.4, 0.9, name="trolley"),
        sideways=Body.rectangle(0.5, 0.9, name="trolley"),
        height=0.9,
        castors=Castors.FREE,
    )
    oblong = replace(trolley, castors=Castors.NONE, height=0.9)
    others = [
        replace(
            each,
            body=replace(each.body, name="another"),
            sideways=replace(each.sideways, name="another"),
            quantity=3,
            location="store",
            critical=4,
            people_nearby=True,
        )
        for each in (trolley, oblong)
    ]
    floor = floor_of(pairs, planar, 2.0, 0.0, 0.9, (), General(), CastorFriction())
    done: list[int] = []
    both = floor.assessed([trolley, oblong, *others], False, done.append)
    made = sum(done)
    for item, found in zip([trolley, oblong, *others], both, strict=True):
        assert found.item is item
        (alone,) = floor.assessed([item], False, done.append)
        rows = [table_of([("", [each])], Weights(), ()) for each in (found, alone)]
        pd.testing.assert_frame_equal(*rows)
        if found.locked is not None:
            assert alone.locked is not None
            assert found.locked.profile == alone.locked.profile
    assert sum(done) == 3 * made  # once for all, and each alone
    # how far others like it differ hangs on what it is
    vase = replace(oblong, body=replace(oblong.body, name="vase"))
    shelf = replace(oblong, body=replace(oblong.body, name="shelf"))
    known = [each.uncertain for each in floor.assessed([shelf, vase], True, done.append)]
    assert [each and each.kind for each in known] == ["filled and emptied", "solid"]
    assert floor.planned([trolley, oblong, *others], False) == floor.planned(
        [trolley, oblong], False
    )
