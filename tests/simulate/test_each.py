"""Members side by side."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from shaketable import (
    Body,
    General,
    InputError,
    Motion,
    Rocking,
    Support,
    simulate,
    simulate_each,
    simulate_many,
)

BODY = Body.rectangle(0.2, 1.0, name="shelf")


@pytest.mark.parametrize("model", [Rocking(), General(static_friction=0.4)])
def test_members_are_single_runs(model: Rocking | General, p695: list[Motion]) -> None:
    rng = np.random.default_rng(4)
    n = 40
    bodies = [
        replace(Body.rectangle(rng.uniform(0.15, 0.4), 1.0), restitution_factor=rng.uniform(0.7, 1))
        for _ in range(n)
    ]
    motions = [p695[k] for k in rng.integers(0, 5, n)]
    tilts, scales = rng.uniform(-0.05, 0.05, n), rng.choice([0.7, 1.4], n)
    polarities = rng.choice([1, -1], n)
    runs = simulate_each(
        bodies, motions, tilts=tilts, scales=scales, polarities=polarities, model=model,
        progress=False,
    )  # fmt: skip
    assert dict(runs.sizes) == {"member": n}
    for k in range(n):
        motion = motions[k].scaled(scales[k])
        motion = motion if polarities[k] == 1 else motion.reversed()
        one = simulate(bodies[k], motion, Support(tilt=tilts[k]), model=model)
        member = runs.isel(member=k)
        assert member.outcome == one.outcome
        # one by one and in lanes the same operations, but for ends of bounces with friction
        assert float(member.peak_rotation) == pytest.approx(one.peak_rotation, abs=1e-7)


def test_a_product_laid_out_by_hand_is_simulate_many(p695: list[Motion]) -> None:
    bodies = [Body.rectangle(width, 1.0, name=f"{width}") for width in (0.1, 0.2, 0.3)]
    many = simulate_many(bodies, p695[:4], tilts=[0.0, 0.02], progress=False)
    product = [(b, m, p, t) for b in bodies for m in p695[:4] for p in (1, -1) for t in (0.0, 0.02)]
    columns = list(zip(*product, strict=True))
    each = simulate_each(
        columns[0], columns[1], polarities=columns[2], tilts=columns[3], progress=False
    )
    for name in many.data_vars:
        assert np.array_equal(each[name].values, many[name].values.ravel(), equal_nan=True)
    assert list(each.motion.values[:2]) == [p695[0].name] * 2


def test_arguments_of_length_one_are_broadcast(p695: list[Motion]) -> None:
    runs = simulate_each(BODY, p695[0], scales=np.linspace(0.2, 1.5, 7), progress=False)
    assert runs.sizes["member"] == 7
    assert (np.diff(runs.scale.values) > 0.0).all()
    assert set(runs.body.values) == {"shelf"}
    assert runs.tilt.attrs["units"] == "rad"


def test_a_member_that_falls_by_itself_is_named(p695: list[Motion]) -> None:
    unnamed = Body.rectangle(0.2, 1.0)
    with pytest.raises(InputError, match=r"body 3: falls by itself on a support tilted by 17\.19°"):
        simulate_each(unnamed, p695[0], tilts=[0.0, 0.1, 0.1, 0.3], progress=False)


def test_progress_is_told(p695: list[Motion]) -> None:
    seen: list[int] = []
    simulate_each([BODY] * 5, p695[:5], progress=seen.append)
    assert sum(seen) == 5


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"scales": [1.0, 2.0]}, "motions 3, tilts 1, scales 2"),
        ({"polarities": [1, 2, 1]}, "polarities= must be 1 or -1"),
        ({"tilts": 0.3}, "falls by itself"),
        ({"tilts": -0.3}, "right / cg_height"),
        ({"tilts": "steep"}, "tilts= must be numbers"),
        ({"scales": [[1.0]]}, "scales= must be one or more finite numbers"),
        ({"scales": np.nan}, "scales= must be one or more finite numbers"),
        ({"scales": -1.0}, "scale factor"),
        ({"model": "sliding"}, "unknown model"),
        ({"motions": []}, "motions= is empty"),
        ({"bodies": ["a", "b", "c"]}, r"bodies\[0\] must be a Body"),
    ],
)
def test_bad_input(change: dict, message: str, p695: list[Motion]) -> None:
    given = {"bodies": BODY, "motions": p695[:3], "progress": False, **change}
    with pytest.raises(InputError, match=message):
        simulate_each(given.pop("bodies"), given.pop("motions"), **given)
