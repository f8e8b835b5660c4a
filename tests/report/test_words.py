"""Results in words."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from shaketable import Body, Motion
from shaketable.assess import ItemResult, Quartiles, Share, assess
from shaketable.inventory import Item
from shaketable.report import words
from shaketable.tilting import TiltCurves

NOTHING = np.zeros(3)
CURVES = TiltCurves(
    tilts=NOTHING,
    downhill_share=NOTHING,
    downhill_band=(NOTHING, NOTHING),
    fall_share=NOTHING,
    fall_band=(NOTHING, NOTHING),
    control_tilt=math.radians(2.0),
    control_tilt_interval=(math.radians(1.5), math.radians(2.6)),
    fall_share_there=0.62,
    fall_share_there_interval=(0.5, 0.7),
)
ITEM = Item(body=Body.rectangle(0.32, 1.8, name="shelf"), height=1.8)
RESULT = ItemResult(
    item=ITEM,
    simulations=88,
    recordings=22,
    falls=44,
    falls_downhill=22,
    fall=Share(0.5, 0.4, 0.6),
    downhill=Share(0.5, 0.4, 0.6),
    peak_rotation=Quartiles(*np.radians([10.0, 20.0, 90.0])),
    curves=CURVES,
    safe_width=0.48,
)
LEANS = math.radians(3.0)


@pytest.mark.parametrize(
    ("share", "text"),
    [(0.0, "0"), (0.004, "less than 1"), (0.236, "24"), (0.995, "more than 99"), (1.0, "100")],
)
def test_in_hundred(share: float, text: str) -> None:
    assert words.in_hundred(share) == text


def test_what_happens() -> None:
    assert words.what_happens(RESULT) == (
        "Falls in 50 of 100 such shakings (likely between 40 and 60)."
    )
    quiet = replace(RESULT, falls=0, fall=Share(0.0, 0.0, 0.042))
    assert "any of 88" in words.what_happens(quiet)
    assert "below 5 in 100" in words.what_happens(quiet)
    still = words.what_happens(replace(quiet, peak_rotation=Quartiles(0.0, 0.0, 0.0)))
    assert "did not move" in still


def test_which_way() -> None:
    assert "either way" in words.which_way(RESULT, 0.0)
    mostly = replace(RESULT, downhill=Share(0.9, 0.8, 0.95))
    assert words.which_way(mostly, LEANS) == (
        "90 of 100 falls go downhill (likely between 80 and 95)."
    )
    seldom = replace(RESULT, downhill=Share(0.1, 0.05, 0.2))
    assert words.which_way(seldom, 0.0) == (
        "90 of 100 falls go right (+x) (likely between 80 and 95)."
    )
    assert "Too few" in words.which_way(replace(RESULT, falls=3), 0.0)
    assert words.which_way(replace(RESULT, falls=0), 0.0) == ""


def test_what_to_do() -> None:
    tilt, base = words.what_to_do(RESULT, 0.95, 0.0)
    # 0.32 m sin 2° = 11.2 mm
    assert "to 2.0°" in tilt
    assert "11 mm" in tilt
    assert "from 50 to 62" in tilt
    assert "likely between 1.5° and 2.6°" in tilt

    def advice(control: float = 0.95, present: float = 0.0, **curves: object) -> list[str]:
        changed = replace(RESULT, curves=replace(CURVES, **curves))
        return words.what_to_do(changed, control, present)

    open_end = advice(control_tilt_interval=(math.radians(1.5), math.inf))
    assert "likely above 1.5°" in open_end[0]
    assert "from 0.32 to 0.48 m" in base
    assert "to the side you choose" in tilt
    askew = replace(ITEM, body=Body.rectangle(0.32, 1.8, eccentricity=0.4))
    assert "turned round" in words.what_to_do(replace(RESULT, item=askew), 0.95, 0.0)[0]
    assert "99.9 of 100" in advice(control=0.999)[0]
    assert "already go downhill" in advice(present=math.radians(4.0))[0]
    assert "already go to its left (-x)" in advice(control_tilt=0.0)[0]
    unknown = replace(RESULT, curves=replace(CURVES, control_tilt=math.nan), safe_width=math.nan)
    hopeless = words.what_to_do(unknown, 0.95, 0.0)
    assert "No tilt up to 10°" in hopeless[0]
    assert "No base up to 6 times" in hopeless[1]
    seldom = replace(RESULT, fall=Share(0.05, 0.0, 0.1), falls=4)
    (rare,) = words.what_to_do(seldom, 0.95, 0.0)
    assert "rarely" in rare
    (never,) = words.what_to_do(replace(seldom, fall=Share(0.0, 0.0, 0.1), falls=0), 0.95, 0.0)
    assert "Nothing is needed" in never


def test_headline(p695: list[Motion]) -> None:
    items = [
        Item(body=Body.rectangle(0.2, 1.5, name="tall"), height=1.5, quantity=4),
        Item(body=Body.rectangle(1.0, 0.5, name="flat"), height=0.5, quantity=6),
    ]
    result = assess(items, p695[:6], progress=False)
    first, second, third, *_ = words.headline(result)
    assert first.startswith("1 of 2 kinds of object (4 of 10 pieces)")
    assert "'tall'" in second
    expected = 4 * result.table["fall_share"][0]
    assert f"{words.expected_count(expected)} of the 10 pieces" in third
    calm = assess(items[1:], p695[:2], progress=False)
    assert words.headline(calm)[0].startswith("None of 1 kind of object")
