"""Blocks: every simulation in one of them, events whole where a summary is kept."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from shaketable import InputError, Motion
from shaketable.campaign.plan import SUMMARY, Plan


def plan_of(small: dict[str, Any], **more: Any) -> Plan:
    given = {name: value for name, value in small.items() if name != "progress"}
    return Plan.of(**(given | more))


@pytest.mark.parametrize("keep", ["all", "summary"])
@pytest.mark.parametrize("block", [1, 7, 60, 10**6])
def test_every_simulation_is_in_one_block(small: dict[str, Any], keep: str, block: int) -> None:
    plan = plan_of(small, keep=keep, block=block)
    counted = np.zeros((len(plan.ensemble.bodies), len(plan.ensemble.motions)), int)
    rows, parts = plan.grid
    for number in range(rows * parts):
        one = plan.block(number)
        counted[one.first_body : one.end_body, one.first_motion : one.end_motion] += 1
    assert (counted == 1).all()
    assert plan.simulations == 5 * 12 * 2 * 2


def test_blocks_are_about_as_large_as_asked_for(small: dict[str, Any]) -> None:
    plan = plan_of(small, block=60)
    largest = max(np.prod(plan.ensemble_of(plan.block(k)).shape) for k in range(np.prod(plan.grid)))
    assert 30 <= largest <= 60


def test_a_summary_has_whole_events(p695: list[Motion]) -> None:
    """Else the squares of their counts could not be summed block by block."""
    plan = Plan.of([*[_body()] * 3], p695, keep=SUMMARY, block=20)
    event = plan.sources.event
    assert len(plan.motion_parts) > 5
    for first, end in plan.motion_parts:
        others = np.r_[event[:first], event[end:]]
        assert not set(event[first:end]) & set(others)
    # the motions are the same, in another order
    assert sorted(m.name for m in plan.ensemble.motions) == sorted(m.name for m in p695)


def test_the_strongest_come_first(small: dict[str, Any]) -> None:
    plan = plan_of(small, block=20)
    energy = [
        sum(float(np.square(m.horizontal).sum()) for m in plan.ensemble_of(plan.block(k)).motions)
        for k in plan.strongest_first()
    ]
    assert energy == sorted(energy, reverse=True)
    assert sorted(plan.strongest_first()) == list(range(len(energy)))


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"keep": "some"}, "keep= must be one of 'all', 'summary', got 'some'"),
        ({"recordings": True}, "recordings= is for keep='summary'"),
        ({"device": "tpu"}, "unknown device 'tpu'; accepted: cpu, cuda"),
        ({"block": 0}, "block must be a positive whole number"),
        ({"bodies": []}, "bodies= is empty"),
        ({"polarities": [2]}, "polarities= must be 1 or -1"),
    ],
)
def test_what_is_refused(small: dict[str, Any], given: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        plan_of(small, **given)


def _body() -> Any:
    from shaketable import Body

    return Body.rectangle(0.2, 1.0)
