"""The main job with the general model: who slides, how far, and off what."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from shaketable import Body, General, InputError, Motion, Outcome, simulate_many
from shaketable.assess import Assessment, Quartiles, Share, Sliding, assess
from shaketable.inventory import Item, read_inventory
from shaketable.report.page import render
from shaketable.report.terminal import print_assessment
from shaketable.report.words.findings import how_far_it_goes
from shaketable.report.words.headline import headline
from shaketable.report.words.numbers import distance
from shaketable.tilting import SLIDES

MODEL = General(static_friction=0.2, kinetic_friction=0.15)
ITEMS = [
    Item(body=Body.rectangle(0.4, 0.3, name="analyser"), height=0.3, support_length=0.45),
    Item(
        body=Body.rectangle(0.4, 0.3, eccentricity=0.4, name="askew"),
        height=0.3,
        support_length=0.6,
    ),
    Item(body=Body.rectangle(0.32, 1.8, name="bookcase"), height=1.8),
]


@pytest.fixture(scope="module")
def motions(p695: list[Motion]) -> list[Motion]:
    return p695[:8]


@pytest.fixture(scope="module")
def result(motions: list[Motion]) -> Assessment:
    return assess(ITEMS, motions, model=MODEL, scale=1.5, progress=False)


def test_distances_are_those_of_the_simulations(result: Assessment, motions: list[Motion]) -> None:
    runs = simulate_many(
        [item.body for item in ITEMS],
        motions,
        scales=[1.5],
        model=MODEL,
        progress=False,
    )
    down = runs.slip_downhill.values.reshape(3, -1)
    up = runs.slip_uphill.values.reshape(3, -1)
    stands = runs.outcome.values.reshape(3, -1) == Outcome.STANDING
    farthest = np.maximum(down, up)
    table = result.table
    for k in range(3):  # of those that stay upright, the observed value in the middle
        upright = np.sort(farthest[k][stands[k]])
        middle = upright[(upright.size - 1) // 2]
        assert table["slip_median_m"][k] == pytest.approx(middle)
    slides = stands & (farthest > SLIDES)
    assert table["slides_share"].values == pytest.approx(slides.mean(axis=1))
    assert table["slides_share"][0] > 0.5
    # the centre of gravity passes the edge: 0.45 m / 2 both ways; 0.3 m ± 0.04 m askew
    off = [stands[0] & (farthest[0] > 0.225), stands[1] & ((down[1] > 0.26) | (up[1] > 0.34))]
    assert table["walks_off_share"][0] == pytest.approx(off[0].mean())
    assert table["walks_off_share"][1] == pytest.approx(off[1].mean())
    assert np.isnan(table["walks_off_share"][2])


def steepest_of(result: Assessment) -> float:
    """The steepest tilt tried [degrees]."""
    curves = [each.curves for each in result.results]
    stands = np.any([np.isfinite(each.fall_share) for each in curves], axis=0)
    return float(np.degrees(curves[0].tilts[stands].max()))


def test_no_tilt_is_tried_on_which_things_slide_by_themselves(result: Assessment) -> None:
    assert steepest_of(result) == pytest.approx(10.0)  # atan 0.2 = 11.3°
    slippery = assess(
        ITEMS[:1],
        [Motion(np.zeros(10), 0.01)],
        model=General(static_friction=0.1),
        progress=False,
    )
    assert steepest_of(slippery) == pytest.approx(5.25)  # atan 0.1 = 5.7°, less a quarter


def test_the_rocking_model_has_no_such_columns(motions: list[Motion]) -> None:
    table = assess(ITEMS, motions[:2], progress=False).table
    assert not {"slip_median_m", "walks_off_share"} & set(table)


def test_sliding_in_words(result: Assessment) -> None:
    none = Share(0.0, 0.0, 0.1)
    slides = Sliding(
        share=0.44,
        slip=Quartiles(0.001, 0.0082, 0.137),
        reach=0.3,
        far=none,
        falls_or_far=none,
        walks_off=0.06,
        falls_or_off=none,
    )
    item = replace(ITEMS[0], support_length=0.8)

    def said(fall: float = 0.1, sliding: Sliding | None = slides, item: Item = item) -> str:
        profile = replace(result.results[0].profile, item=item, support_length=item.support_length)
        shown = replace(
            result.results[0],
            profile=profile,
            recordings=22,
            fall=Share(fall, 0.0, 1.0),
            sliding=sliding,
        )
        return how_far_it_goes(shown)

    assert said() == (
        "Where it does not fall, it slides by 8.2 mm or more in half of the shakings and by 14 cm "
        "or more in a quarter of them; it stays upright and slides by more than 1 cm in 44 of 100. "
        "In 6 of 100 it walks off its support of 0.80 m."
    )
    still = slides._replace(share=0.0, walks_off=0.0)
    assert said(0.0, still) == (
        "It never slides by more than 1 cm. It stays on its support of 0.80 m."
    )
    free = replace(item, support_length=None)
    unknown = slides._replace(share=0.0, walks_off=np.nan)
    assert said(0.0, unknown, free) == "It never slides by more than 1 cm."
    assert said(1.0) == ""
    assert said(0.1, None) == ""
    assert distance(1.234) == "1.2 m"


def test_report_and_table_show_it(result: Assessment) -> None:
    import io

    from rich.console import Console

    run = {
        "messages": [],
        "scaling": "",
        "inventory": {"path": "things.csv", "sha256": "0" * 64},
        "motions": {
            "count": 8,
            "description": "eight",
            "smallest_pga_g": 0.1,
            "largest_pga_g": 0.9,
            "sources": [],
        },
        "finished": "now",
        "command": "shaketable assess",
        "versions": {"shaketable": "0"},
    }
    page = render(result, run)
    assert "How far things slide or roll" in page
    assert "static 0.2 and kinetic 0.15" in page
    assert "without sliding" not in page
    assert any("slides farthest" in line for line in headline(result))
    console = Console(file=io.StringIO(), width=80)
    print_assessment(result, console, Path("out"), "8 motions")
    text = console.file.getvalue()
    assert "walks" in text
    assert "bookcase" in text  # whole names fit in 80 columns


def test_a_support_shorter_than_the_base(tmp_path) -> None:
    path = tmp_path / "things.csv"
    path.write_text("name,width_m,height_m,support_length_m\na,0.5,1,0.4\nb,0.5,1,\nc,0.5,1,2\n")
    with pytest.raises(InputError, match=r"line 2, support_length_m: found 0\.4 m, shorter"):
        read_inventory(path)
    path.write_text(path.read_text().replace("0.4", "0.5"))
    assert [item.support_length for item in read_inventory(path)] == [0.5, None, 2.0]
