"""Campaigns of solids: what `simulate_many` gives, in blocks, and as a summary."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from shaketable import (
    General,
    InputError,
    Motion,
    Outcome,
    Solid,
    Strap,
    Surroundings,
    run_campaign,
    simulate_many,
)
from shaketable.campaign.collect import falls_table
from shaketable.campaign.objects import Objects
from shaketable.campaign.results import open_campaign, simulations_of
from shaketable.campaign.status import estimate


@pytest.fixture
def wanted() -> dict[str, Any]:
    t = np.arange(150) * 0.01
    motions = [
        Motion(a * np.sin(7 * t), 0.01, transverse=a * np.cos(5 * t) - a, name=f"{a} m/s²")
        for a in (2.0, 3.0, 5.0)
    ]
    feet = np.array([[0.2, 0.1], [-0.2, 0.1], [-0.2, -0.1], [0.2, -0.1]])
    castors = [True, False, False, True]
    return {
        "bodies": [
            Solid.box(0.2, 0.3, 1.0, name="box"),
            Solid.cylinder(0.25, 0.9, name="bottle"),
            Solid.on_feet(feet, 0.9, castors=castors, name="trolley"),
        ],
        "motions": motions,
        "tilts": (0.0, 0.03),
        "azimuth": 1.0,
        "orientations": (0.0, 0.7),
        "model": General(static_friction=0.6),
        "progress": False,
    }


def test_every_simulation_and_again_from_its_store(wanted: dict[str, Any], tmp_path: Path) -> None:
    known = simulate_many(**wanted)
    found = run_campaign(**wanted, store=tmp_path / "c", block=20)
    xr.testing.assert_identical(found.load(), known)
    xr.testing.assert_identical(open_campaign(tmp_path / "c").load(), known)
    work = simulations_of(Objects(tmp_path / "c"))
    plan = work.plan
    assert plan.grid == (2, 3)
    assert [motion.transverse is None for motion in plan.ensemble.motions] == [False] * 3
    assert estimate(work).count == known.outcome.size


def test_a_summary_counts_the_same_falls(wanted: dict[str, Any], tmp_path: Path) -> None:
    known = simulate_many(**wanted)
    counted = run_campaign(**wanted, store=tmp_path / "s", keep="summary", recordings=True)
    falls = (known.outcome != Outcome.STANDING).sum(("motion", "polarity", "scale", "orientation"))
    assert (counted.downhill + counted.uphill).values[..., 0].tolist() == falls.values.tolist()
    assert counted.attrs["simulations"] == 3 * 2 * 2
    assert counted.by_recording.sum() == falls.sum() > 0
    every = run_campaign(**wanted, store=tmp_path / "a")
    tables = []
    for name, results in (("s", counted), ("a", every)):
        plan = simulations_of(Objects(tmp_path / name)).plan
        tables.append(falls_table(results, plan))
    pd.testing.assert_frame_equal(*tables)
    assert tables[0]["depth_m"].tolist()[::2] == pytest.approx([0.2, 0.25, 0.4])
    assert tables[0]["width_m"].tolist()[::2] == pytest.approx([0.3, 0.25, 0.2])


def test_another_orientation_is_another_campaign(wanted: dict[str, Any], tmp_path: Path) -> None:
    wanted["bodies"] = wanted["bodies"][:1]
    run_campaign(**wanted, store=tmp_path / "c")
    with pytest.raises(InputError, match=r"orientations: .* → "):
        run_campaign(**{**wanted, "orientations": (0.0, 0.8)}, store=tmp_path / "c")


@pytest.fixture
def held() -> dict[str, Any]:
    """Two shelves of their own heights, each with a strap so slack that it may hang in it."""
    t = np.arange(300) * 0.01
    motions = [
        Motion(a * np.sin(9 * t), 0.01, transverse=np.zeros(300), name=f"{a} m/s²")
        for a in (3.0, 4.0, 6.0)
    ]
    return {
        "bodies": [Solid.box(0.3, 0.8, h, mass=60.0, name=f"{h} m") for h in (1.0, 1.8)],
        "motions": motions,
        "model": General(static_friction=0.35),
        "surroundings": [
            Surroundings(
                straps=(
                    Strap(
                        point=(-0.15, 0.0, h), anchor=(-0.25, 0.0, h), stiffness=5e4,
                        damping=3000.0, slack=0.3, strength=strength,
                    ),
                )
            )
            for h, strength in ((1.0, 1500.0), (1.8, 2500.0))
        ],
        "progress": False,
    }  # fmt: skip


def test_each_is_held_by_its_straps(held: dict[str, Any], tmp_path: Path) -> None:
    known = simulate_many(**held)
    found = run_campaign(**held, store=tmp_path / "c", block=4)
    assert simulations_of(Objects(tmp_path / "c")).plan.grid == (1, 3)
    xr.testing.assert_identical(found.load(), known)
    assert found.strap_force.dims == (*found.outcome.dims, "strap")
    assert found.strap_force.attrs["units"] == "N"
    assert np.isfinite(found.strap_broke_at).any()
    one = run_campaign(**held, store=tmp_path / "d", block=1)
    xr.testing.assert_identical(one.load(), known)


@pytest.mark.parametrize("around", [[1, None], [None, 2], [1, 2]])
def test_bodies_of_a_block_lack_what_others_have(
    held: dict[str, Any], around: list[int | None], tmp_path: Path
) -> None:
    """One has no surroundings, one strap or two."""
    straps = held["surroundings"][0].straps
    held["surroundings"] = [count and Surroundings(straps=straps * count) for count in around]
    known = simulate_many(**held)
    xr.testing.assert_identical(run_campaign(**held, store=tmp_path / "c", block=1).load(), known)
    counted = run_campaign(**held, store=tmp_path / "s", block=1, keep="summary")
    kept = known.held_up.sum(("motion", "polarity", "orientation"))
    assert counted.held_up.values.tolist() == kept.values.tolist()


def test_a_summary_counts_what_is_held_up(held: dict[str, Any], tmp_path: Path) -> None:
    known = simulate_many(**held)
    kept = known.held_up.sum(("motion", "polarity", "orientation"))
    assert 0 < kept.sum() < known.held_up.size
    counted = run_campaign(**held, store=tmp_path / "s", keep="summary")
    assert counted.held_up.values[..., 0].tolist() == kept.values[..., 0].tolist()
    every = run_campaign(**held, store=tmp_path / "a")
    for name, results in (("s", counted), ("a", every)):
        table = falls_table(results, simulations_of(Objects(tmp_path / name)).plan)
        assert table["held_up"].tolist() == kept.values.ravel().tolist()


def test_other_straps_are_another_campaign(held: dict[str, Any], tmp_path: Path) -> None:
    run_campaign(**held, store=tmp_path / "c")
    held["surroundings"] = [held["surroundings"][0]] * 2
    with pytest.raises(InputError, match=r"bodies: 1 of 2 differ \(1\.8 m\)"):
        run_campaign(**held, store=tmp_path / "c")


def test_what_cannot_be(wanted: dict[str, Any], tmp_path: Path) -> None:
    with pytest.raises(InputError, match="device"):
        run_campaign(**wanted, store=tmp_path / "c", device="gpu")
    with pytest.raises(InputError, match="one edge"):
        run_campaign(**{**wanted, "model": "rocking"}, store=tmp_path / "c")


def test_a_summary_counts_what_is_held_at_its_own_scale(
    held: dict[str, Any], tmp_path: Path
) -> None:
    """At two scales, neither of them one, with unequal counts of each."""
    held["scales"] = (0.6, 1.3)
    known = simulate_many(**held)
    others = ("motion", "polarity", "orientation")
    kept = known.held_up.sum(others)
    fallen = (known.outcome == -1).sum(others)
    assert kept.values[..., 0].tolist() != kept.values[..., 1].tolist()
    counted = run_campaign(**held, store=tmp_path / "s", keep="summary")
    assert counted.held_up.values.tolist() == kept.values.tolist()
    assert counted.downhill.values.tolist() == fallen.values.tolist()
    bins = counted.peaks.values.argmax(axis=-1)  # where most peaks lie, of each cell
    assert (bins[..., 0] < bins[..., 1]).any()
