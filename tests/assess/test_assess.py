"""The main job."""

from __future__ import annotations

import math

import numpy as np
import pytest

from shaketable import Body, InputError, Motion, Outcome, simulate_many
from shaketable.assess import ACCEPTED_FALLS, BASE_GRID, FINER_BASES, Assessment, assess, widened
from shaketable.inventory import Item
from shaketable.tilting import FEWEST_FALLS, TILTS, design_tilt

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
    assert list(table["plane_falls_downhill"]) == list((outcome == Outcome.DOWNHILL).sum(axis=1))
    peaks = np.degrees(np.sort(runs.peak_rotation.values.reshape(3, -1), axis=1)[:, 15])
    assert table["plane_peak_rotation_median_deg"].values == pytest.approx(peaks)


def test_few_falls_tell_no_direction(motions: list[Motion]) -> None:
    sturdy = Item(body=Body.rectangle(0.42, 1.8), height=1.8)
    (found,) = assess([sturdy], motions, progress=False).results
    assert 0 < found.falls < FEWEST_FALLS
    assert all(math.isnan(each) for each in found.downhill)


def test_wilson_interval(result: Assessment) -> None:
    # Wilson (1927): centre and half width by hand, z = 1.959964
    z = 1.959964
    for _, row in result.table.iterrows():
        # 16 motions are 8 recordings: neither a component nor a direction adds an experiment
        assert row["recordings"] == 8
        n, p = row["recordings"], row["fall_share"]
        centre = (p + z * z / (2 * n)) / (1 + z * z / n)
        half = z / (1 + z * z / n) * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
        assert row["fall_share_low"] == pytest.approx(max(centre - half, 0), abs=1e-6)
        assert row["fall_share_high"] == pytest.approx(min(centre + half, 1), abs=1e-6)


def test_tilt_curve_and_its_crossing(result: Assessment) -> None:
    bookcase = result.table.iloc[0]
    tilt = bookcase["plane_control_tilt_deg"]
    curves = result.results[0].curves
    shares = curves.downhill_share
    at = int(np.flatnonzero(np.isclose(np.degrees(TILTS), tilt))[0])
    assert at > 0
    assert shares[at - 1] < 0.95
    assert (shares[at:][np.isfinite(shares[at:])] >= 0.95).all()
    assert bookcase["plane_fall_share_at_control_tilt"] == curves.fall_share[at]
    assert curves.downhill_share[0] == 0.5  # symmetric body, both polarities
    low, high = bookcase["plane_control_tilt_low_deg"], bookcase["plane_control_tilt_high_deg"]
    assert low < tilt < high


def test_tilts_at_which_a_body_falls_by_itself_are_left_out(result: Assessment) -> None:
    limit = math.degrees(ITEMS[2].body.slenderness_left)
    assert limit < 10
    tilts, shares = np.degrees(TILTS), result.results[2].curves.fall_share
    assert np.isnan(shares[limit <= tilts]).all()
    assert np.isfinite(shares[limit - 0.5 > tilts]).all()


def test_off_centre_falls_to_its_short_side(result: Assessment) -> None:
    assert result.table["plane_downhill_share"][2] > 0.7


def test_safe_base_is_safe_and_smallest(result: Assessment, motions: list[Motion]) -> None:
    item, base = ITEMS[0], result.table["plane_safe_base_m"][0]

    def share(width: float) -> float:
        runs = simulate_many([widened(item.body, width)], motions, progress=False)
        return float((runs.outcome != 0).mean())

    assert base > item.body.base
    assert share(base) <= ACCEPTED_FALLS
    # the width tried just below it is not safe
    grid = BASE_GRID * item.body.base
    k = int(np.searchsorted(grid, base)) - 1
    assert share(base - (grid[k + 1] - grid[k]) / (FINER_BASES + 1)) > ACCEPTED_FALLS
    crate = result.table.iloc[1]
    assert crate["falls"] == 0
    assert crate["plane_safe_base_m"] < crate["base_along_direction_m"]


def test_a_tilted_support_and_a_scale(motions: list[Motion]) -> None:
    tilted = assess(ITEMS[:1], motions, tilt=math.radians(4.0), scale=0.8, progress=False)
    louder = assess(ITEMS[:1], motions, tilt=math.radians(4.0), scale=1.6, progress=False)
    assert tilted.tilt == pytest.approx(math.radians(4.0))
    assert tilted.table["plane_downhill_share"][0] > 0.9
    assert louder.table["falls"][0] > tilted.table["falls"][0]


def test_many_items_are_taken_in_bounded_pieces(motions: list[Motion]) -> None:
    items = [
        Item(body=Body.rectangle(0.2 + 0.001 * n, 1.0, name=f"{n}"), height=1.0) for n in range(300)
    ]
    seen: list[int] = []
    result = assess(items, motions[:1], progress=seen.append)
    assert len(result.table) == 300
    alone = assess(items[299:], motions[:1], progress=False).table.iloc[0]
    for column in ("falls", "plane_safe_base_m", "plane_peak_rotation_median_deg"):
        assert result.table[column][299] == alone[column]


def test_the_tilt_tool_says_the_same_of_the_same_object(
    result: Assessment, motions: list[Motion]
) -> None:
    design = design_tilt(ITEMS[0].body, motions, progress=False)
    found = result.results[0]
    assert found.fall.value == design.level.fall_share
    assert (found.fall.low, found.fall.high) == design.level.fall_share_interval
    assert found.curves.control_tilt == design.curves.control_tilt
    assert found.curves.control_tilt_interval == design.curves.control_tilt_interval
    stands = slice(design.curves.tilts.size)  # the tool leaves out tilts on which it falls anyway
    for curve in ("downhill_share", "fall_share"):
        ours, theirs = getattr(found.curves, curve), getattr(design.curves, curve)
        assert np.array_equal(ours[stands], theirs)
    assert np.array_equal(found.curves.fall_band[1][stands], design.curves.fall_band[1])


def test_an_assessment_shows_itself(result: Assessment) -> None:
    assert repr(result).startswith("Assessment(3 items, 5 pieces, Rocking(")
    assert "bookcase" in result._repr_html_()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"control": 0.5}, "control"),
        ({"control": 1.0}, "control"),
        ({"scale": 0.0}, "scale"),
        ({"tilt": 0.3}, "bookcase: falls by itself"),
        ({"tilt": -0.1}, r"tilt must not be negative, got -5\.73°"),
        ({"tilt": "3"}, "tilt must be a number"),
        ({"control": None}, "control must be a number"),
        ({"scale": "2"}, "scale must be a number"),
        ({"motions": []}, "motions= is empty"),
        ({"items": []}, "items= is empty; at least one"),
        ({"items": ITEMS[0]}, r"write items=\[item\]"),
        ({"items": [Body.rectangle(0.3, 1.0)]}, r"items\[0\] must be an Item"),
    ],
)
def test_bad_input(change: dict, message: str, motions: list[Motion]) -> None:
    given = {"items": ITEMS, "motions": motions[:1], "progress": False, **change}
    with pytest.raises(InputError, match=message):
        assess(given.pop("items"), given.pop("motions"), **given)
