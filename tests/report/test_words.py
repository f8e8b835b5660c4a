"""Results in words."""

from __future__ import annotations

import math

import pytest

from shaketable import Body, Motion
from shaketable.assess import assess
from shaketable.inventory import Item
from shaketable.report import words

ROW = {
    "name": "shelf",
    "simulations": 88,
    "falls": 44,
    "fall_share": 0.5,
    "fall_share_low": 0.4,
    "fall_share_high": 0.6,
    "downhill_share": 0.5,
    "peak_rotation_median_deg": 20.0,
    "control_tilt_deg": 2.0,
    "control_tilt_low_deg": 1.5,
    "control_tilt_high_deg": 2.6,
    "fall_share_at_control_tilt": 0.62,
    "safe_width_m": 0.48,
    "width_m": 0.32,
    "eccentricity": 0.5,
}


@pytest.mark.parametrize(
    ("share", "text"),
    [(0.0, "0"), (0.004, "less than 1"), (0.236, "24"), (0.995, "more than 99"), (1.0, "100")],
)
def test_in_hundred(share: float, text: str) -> None:
    assert words.in_hundred(share) == text


def test_what_happens() -> None:
    assert words.what_happens(ROW) == (
        "Falls in 50 of 100 such shakings (likely between 40 and 60)."
    )
    quiet = {**ROW, "falls": 0, "fall_share": 0.0, "fall_share_high": 0.042}
    assert "any of 88" in words.what_happens(quiet)
    assert "below 5 in 100" in words.what_happens(quiet)
    still = words.what_happens({**quiet, "peak_rotation_median_deg": 0.0})
    assert "did not move" in still


def test_which_way() -> None:
    assert "either way" in words.which_way(ROW, 0.0)
    mostly = {"downhill_share": 0.9, "downhill_share_low": 0.8, "downhill_share_high": 0.95}
    assert words.which_way({**ROW, **mostly}, 3.0) == (
        "90 of 100 falls go downhill (likely between 80 and 95)."
    )
    seldom = {"downhill_share": 0.1, "downhill_share_low": 0.05, "downhill_share_high": 0.2}
    assert words.which_way({**ROW, **seldom}, 0.0) == (
        "90 of 100 falls go right (+x) (likely between 80 and 95)."
    )
    assert "Too few" in words.which_way({**ROW, "falls": 3}, 0.0)
    assert words.which_way({**ROW, "falls": 0}, 0.0) == ""


def test_what_to_do() -> None:
    tilt, base = words.what_to_do(ROW, 0.95, 0.0)
    # 0.32 m sin 2° = 11.2 mm
    assert "to 2.0°" in tilt
    assert "11 mm" in tilt
    assert "from 50 to 62" in tilt
    assert "likely between 1.5 and 2.6°" in tilt
    open_end = {**ROW, "control_tilt_high_deg": math.inf}
    assert "likely above 1.5°" in words.what_to_do(open_end, 0.95, 0.0)[0]
    assert "from 0.32 to 0.48 m" in base
    assert "to the side you choose" in tilt
    assert "turned round" in words.what_to_do({**ROW, "eccentricity": 0.4}, 0.95, 0.0)[0]
    assert "99.9 of 100" in words.what_to_do(ROW, 0.999, 0.0)[0]
    assert "already go downhill" in words.what_to_do(ROW, 0.95, 4.0)[0]
    off_centre = {**ROW, "control_tilt_deg": 0.0}
    assert "already go to its left (-x)" in words.what_to_do(off_centre, 0.95, 0.0)[0]
    hopeless = {**ROW, "control_tilt_deg": math.nan, "safe_width_m": math.nan}
    assert "No tilt up to 10°" in words.what_to_do(hopeless, 0.95, 0.0)[0]
    assert "No base up to 6 times" in words.what_to_do(hopeless, 0.95, 0.0)[1]
    (rare,) = words.what_to_do({**ROW, "fall_share": 0.05, "falls": 4}, 0.95, 0.0)
    assert "rarely" in rare
    (never,) = words.what_to_do({**ROW, "fall_share": 0.0, "falls": 0}, 0.95, 0.0)
    assert "Nothing is needed" in never


def test_headline(p695: list[Motion]) -> None:
    items = [
        Item(body=Body.rectangle(0.2, 1.5, name="tall"), height=1.5, quantity=4),
        Item(body=Body.rectangle(1.0, 0.5, name="flat"), height=0.5, quantity=6),
    ]
    result = assess(items, p695[:6], progress=False)
    first, second, third = words.headline(result)
    assert first.startswith("1 of 2 kinds of object (4 of 10 pieces)")
    assert "'tall'" in second
    expected = 4 * result.table["fall_share"][0]
    assert f"{words.expected_count(expected)} of the 10 pieces" in third
    calm = assess(items[1:], p695[:2], progress=False)
    assert words.headline(calm)[0].startswith("None of 1 kinds")
