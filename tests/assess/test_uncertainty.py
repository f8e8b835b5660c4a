"""Objects that are not known exactly, in the main job."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from shaketable import Body, Item, Motion, assess
from shaketable.assess.ranking import Weights, ranked
from shaketable.assess.results import Sliding
from shaketable.assess.shares import Quartiles, Share
from shaketable.assess.uncertainty import KINDS, components, kind_of
from shaketable.inventory import Castors
from shaketable.report.words import headline
from shaketable.resampling import wilson_interval
from tests.support.command import shaketable


def item(name: str, width: float, height: float, **given: object) -> Item:
    return Item(body=Body.rectangle(width, height, name=name), height=height, **given)


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("Bookcase 1.80 m", "filled and emptied"),
        ("Vertical file 2 drawers", "filled and emptied"),
        ("Marble bust", "solid"),
        ("Oxygen cylinder 50 l", "solid"),
        ("Infusion pump", "equipment"),
        ("Profiler", "equipment"),  # no file
        ("Estantería", "filled and emptied"),
        ("Bücherregal", "filled and emptied"),
        ("Sauerstoffflasche", "solid"),
        ("Jarrón de cerámica", "solid"),
        ("", "equipment"),
        ("—", "equipment"),
    ],
)
def test_kinds_by_name(name: str, kind: str) -> None:
    assert kind_of(item(name, 0.3, 1.0)).name == kind


def test_components_by_hand() -> None:
    """Falls that hang on the motion alone, and on the object alone."""
    by_motion = np.tile([0.0, 1.0, 0.0, 1.0], (3, 1))
    # four motions of shares 0 and 1: a sample variance of 1/3
    assert components(by_motion) == pytest.approx((0.0, np.sqrt(1 / 3)))
    assert components(by_motion.T) == pytest.approx((np.sqrt(1 / 3), 0.0))
    noise = np.random.default_rng(0).integers(0, 2, (200, 200)).astype(float)
    # nothing but chance: both deviations are estimated about zero
    assert max(components(noise)) < 0.02


def test_the_share_of_the_motions_becomes_a_probability(p695: list[Motion]) -> None:
    items = [
        item("Bookcase", 0.32, 1.8),
        item("Wide freezer", 1.2, 1.5),
        item("Cart", 0.5, 1.1, castors=Castors.FREE),
    ]
    found = assess(items, p695[:30], uncertainty=True, progress=False)
    shelf, freezer, cart = found.results
    assert cart.uncertain is None
    assert shelf.uncertain is not None
    assert shelf.uncertain.kind == "filled and emptied"
    # objects like it fall about as often, and the motion makes the larger difference
    assert shelf.uncertain.fall.value == pytest.approx(shelf.fall.value, abs=0.1)
    assert shelf.uncertain.fall.low < shelf.uncertain.fall.value < shelf.uncertain.fall.high
    assert shelf.uncertain.matters_more == "motion"
    assert freezer.uncertain is not None
    assert freezer.uncertain.fall.value < 0.1
    said = " ".join(headline.uncertainty(found))
    assert freezer.uncertain.matters_more == "neither"  # nothing like it ever falls
    assert "which motion comes, for 1 kind of object; neither" in said
    assert "castors is not in it (1 kind of object)" in said
    # the table's order is that of the probability, on castors of the share
    assert shelf.ranking_share == shelf.uncertain.fall
    assert cart.ranking_share == cart.governing_share
    often = replace(freezer, uncertain=freezer.uncertain._replace(fall=Share(0.99, 0.9, 1.0)))
    assert ranked([shelf, often], Weights())[0] is often
    assert ranked([shelf, freezer], Weights())[0] is shelf
    often_off = Share(0.95, 0.9, 1.0)
    slides = Sliding(0.0, Quartiles(0.0, 0.0, 0.0), 0.0, often_off, often_off, 0.95, often_off)
    walks = replace(shelf, sliding=slides)
    assert walks.ranking_share.value == 0.95  # more than the falls of uncertain objects
    assert all(kind.name in headline.assumed_uncertainty() for kind in KINDS)
    plain = assess(items, p695[:30], progress=False)
    assert headline.uncertainty(plain) == []
    # nothing else changes
    both = found.table[plain.table.columns]
    pd.testing.assert_frame_equal(both, plain.table)


def test_from_the_command_line(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("name,depth_m,width_m,height_m\nshelf,0.3,0.9,1.8\n")
    run = shaketable(
        "assess", "a.csv", "--uncertainty", "--motions", "near-field-pulse", "--advise", 0,
        "--out", "out", cwd=tmp_path,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert "With the objects uncertain too" in run.stdout
    table = pd.read_csv(tmp_path / "out" / "results.csv")
    assert 0.0 < table["fall_probability"].iloc[0] < 1.0
    assert "If the objects are uncertain, too" in (tmp_path / "out" / "report.html").read_text()


def test_the_interval_counts_recordings_and_no_motions_or_simulations(p695: list[Motion]) -> None:
    """Six motions of three recordings, with hundreds of objects: an interval of three."""
    three = [p695[k] for k in (0, 2, 4)]
    twice = [each.scaled(factor) for each in three for factor in (0.8, 1.1)]
    found = assess([item("Bookcase", 0.32, 1.8)], twice, uncertainty=True, planar=True,
                   progress=False)  # fmt: skip
    (result,) = found.results
    assert result.recordings == 3
    assert result.uncertain is not None
    fall = result.uncertain.fall
    assert 0.0 < fall.value < 1.0
    assert (fall.low, fall.high) == pytest.approx(wilson_interval(fall.value, 3))
