"""The main job."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import Body, InputError, Motion, Outcome, simulate_many
from shaketable.assess import (
    ACCEPTED_FALLS,
    BASE_GRID,
    FINER_BASES,
    TILT_GRID_DEG,
    Assessment,
    assess,
)
from shaketable.inventory import Item

ITEMS = [
    Item(body=Body.rectangle(0.32, 1.8, name="bookcase"), height=1.8, quantity=3),
    Item(body=Body.rectangle(0.8, 0.5, name="crate"), height=0.5),
    Item(body=Body.rectangle(0.1, 1.0, eccentricity=0.35, name="stick"), height=1.0),
]


@pytest.fixture(scope="module")
def motions(p695: list[Motion]) -> list[Motion]:
    return p695[:16]


@pytest.fixture(scope="module")
def result(motions: list[Motion]) -> Assessment:
    return assess(ITEMS, motions, progress=False)


def test_counts_are_those_of_the_simulations(result: Assessment, motions: list[Motion]) -> None:
    runs = simulate_many([item.body for item in ITEMS], motions, progress=False)
    outcome = runs.outcome.values.reshape(3, -1)
    table = result.table
    assert list(table["simulations"]) == [32, 32, 32]
    assert list(table["falls"]) == list((outcome != 0).sum(axis=1))
    assert list(table["falls_downhill"]) == list((outcome == Outcome.DOWNHILL).sum(axis=1))
    peaks = np.degrees(np.sort(runs.peak_rotation.values.reshape(3, -1), axis=1)[:, 15])
    assert table["peak_rotation_median_deg"].values == pytest.approx(peaks)


def test_wilson_interval(result: Assessment) -> None:
    # Wilson (1927): centre and half width by hand, z = 1.959964
    z = 1.959964
    for _, row in result.table.iterrows():
        n, p = row["simulations"] // 2, row["fall_share"]  # motions: a direction adds no experiment
        centre = (p + z * z / (2 * n)) / (1 + z * z / n)
        half = z / (1 + z * z / n) * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
        assert row["fall_share_low"] == pytest.approx(max(centre - half, 0), abs=1e-6)
        assert row["fall_share_high"] == pytest.approx(min(centre + half, 1), abs=1e-6)


def test_tilt_curve_and_its_crossing(result: Assessment) -> None:
    bookcase = result.table.iloc[0]
    tilt = bookcase["control_tilt_deg"]
    shares = result.curves[0].downhill_share
    at = int(np.flatnonzero(np.isclose(TILT_GRID_DEG, tilt))[0])
    assert at > 0
    assert shares[at - 1] < 0.95
    assert (shares[at:][np.isfinite(shares[at:])] >= 0.95).all()
    assert bookcase["fall_share_at_control_tilt"] == result.curves[0].fall_share[at]
    assert result.curves[0].downhill_share[0] == 0.5  # symmetric body, both polarities
    low, high = bookcase["control_tilt_low_deg"], bookcase["control_tilt_high_deg"]
    assert low < tilt < high


def test_tilts_at_which_a_body_falls_by_itself_are_left_out(result: Assessment) -> None:
    limit = math.degrees(ITEMS[2].body.slenderness_left)
    assert limit < 10
    assert np.isnan(result.curves[2].fall_share[limit <= TILT_GRID_DEG]).all()
    assert np.isfinite(result.curves[2].fall_share[limit - 0.5 > TILT_GRID_DEG]).all()


def test_off_centre_falls_to_its_short_side(result: Assessment) -> None:
    assert result.table["downhill_share"][2] > 0.7


def test_safe_base_is_safe_and_smallest(result: Assessment, motions: list[Motion]) -> None:
    item, base = ITEMS[0], result.table["safe_width_m"][0]

    def share(width: float) -> float:
        runs = simulate_many([item.with_base(width)], motions, progress=False)
        return float((runs.outcome != 0).mean())

    assert base > item.body.width
    assert share(base) <= ACCEPTED_FALLS
    # the width tried just below it is not safe
    grid = BASE_GRID * item.body.width
    k = int(np.searchsorted(grid, base)) - 1
    assert share(base - (grid[k + 1] - grid[k]) / (FINER_BASES + 1)) > ACCEPTED_FALLS
    crate = result.table.iloc[1]
    assert crate["falls"] == 0
    assert crate["safe_width_m"] < crate["width_m"]


def test_a_tilted_support_and_a_scale(motions: list[Motion]) -> None:
    tilted = assess(ITEMS[:1], motions, tilt=math.radians(4.0), scale=0.8, progress=False)
    louder = assess(ITEMS[:1], motions, tilt=math.radians(4.0), scale=1.6, progress=False)
    assert tilted.tilt_deg == pytest.approx(4.0)
    assert tilted.table["downhill_share"][0] > 0.9
    assert louder.table["falls"][0] > tilted.table["falls"][0]


def test_many_items_are_taken_in_bounded_pieces(motions: list[Motion]) -> None:
    items = [
        Item(body=Body.rectangle(0.2 + 0.001 * n, 1.0, name=f"{n}"), height=1.0) for n in range(300)
    ]
    seen: list[int] = []
    result = assess(items, motions[:1], progress=seen.append)
    assert len(result.table) == 300
    alone = assess(items[299:], motions[:1], progress=False).table.iloc[0]
    for column in ("falls", "safe_width_m", "peak_rotation_median_deg"):
        assert result.table[column][299] == alone[column]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"control": 0.5}, "control"),
        ({"control": 1.0}, "control"),
        ({"scale": 0.0}, "scale"),
        ({"tilt": 0.3}, "bookcase: falls by itself"),
        ({"motions": []}, "at least one"),
        ({"items": []}, "at least one"),
    ],
)
def test_bad_input(change: dict, message: str, motions: list[Motion]) -> None:
    given = {"items": ITEMS, "motions": motions[:1], "progress": False, **change}
    with pytest.raises(InputError, match=message):
        assess(given.pop("items"), given.pop("motions"), **given)
