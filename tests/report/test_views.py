"""One result in all views of it: report, terminal, CSV, the page, a Word document."""

from __future__ import annotations

import html
import io
import math
import re
from dataclasses import replace
from pathlib import Path

import docx
import pandas as pd
import pytest
from rich.console import Console

from shaketable import Body
from shaketable.assess import Assessment, ItemResult, Share, assess
from shaketable.cli.assess import example_inventory
from shaketable.errors import SimulationError
from shaketable.inventory import BaseShape, Item, read_inventory
from shaketable.inventory.read import read_with_columns
from shaketable.language import LANGUAGES, Language, speaking
from shaketable.records import suite
from shaketable.report.as_docx import write_docx
from shaketable.report.assessment_folder import write_results
from shaketable.report.page import render
from shaketable.report.print_pdf import print_pdf
from shaketable.report.terminal import print_assessment
from shaketable.report.words.numbers import limits_in_hundred, two_digits, with_interval
from shaketable.report.words.straps import code_force
from shaketable.web import space
from shaketable.web.lists import _assessed, _with_remarks
from shaketable.web.questions import ManyInSpace, Upright
from tests.support.builders import RUN
from tests.support.printer import skip_without_printer


@pytest.fixture(scope="module")
def result() -> Assessment:
    """The example hospital, with what falls seldom and often, rolls, and is round."""
    pairs = [m for m in suite("fema-p695", pairs=True)[:12] if m.transverse is not None]
    return assess(read_inventory(example_inventory()), pairs, leading=3, progress=False)


@pytest.fixture(scope="module")
def page(result: Assessment) -> str:
    return plain(render(result, RUN))


def plain(page: str) -> str:
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]*>", " ", page)))


def share(row: pd.Series, name: str) -> str:
    """A share of the table with its interval, as every view writes it."""
    return with_interval(Share(row[name], row[f"{name}_low"], row[f"{name}_high"]))


def test_every_view_has_the_same_shares(result: Assessment, page: str, tmp_path: Path) -> None:
    """To the digit, with the interval and the number of recordings; and no second one."""
    console = Console(file=io.StringIO(), width=140)
    print_assessment(result, console, Path("out"), "24 motions")
    terminal = console.file.getvalue()  # type: ignore[attr-defined]
    objects = {each.name: each for each in _assessed(result, []).objects}
    inventory = read_with_columns(example_inventory())
    remarks = _with_remarks(inventory, _with(result, inventory.items)).set_index("name")
    write_docx(result, RUN, None, tmp_path / "a.docx")
    document = docx.Document(str(tmp_path / "a.docx"))
    written = "\n".join(each.text for each in document.paragraphs)
    first = page.partition("What to do first")[2].partition("How sure is that")[0]
    rooms = page.partition("Room by room")[2].partition("Annex")[0]
    cards = page.partition("Thing by thing")[2].partition("Forces")[0]
    table = result.table.set_index("name")
    assert set(table["recordings"]) == {result.recordings}
    for place in (first, rooms, cards):
        assert f"from {result.recordings} independent recordings" in place
    for each in result.ranked():
        name, row = each.item.name, table.loc[each.item.name]
        said = with_interval(each.governing_share)
        assert share(row, "governing_share") == said
        assert share(row, "fall_share") == with_interval(each.overturns)
        assert re.search(rf"{re.escape(name[:17])}.*{re.escape(said)}", terminal), name
        found = objects[name].in_100
        assert f"{found.share} ({found.low}–{found.high})" == said
        assert remarks.loc[name, "likely"] == f"{found.low} to {found.high}"
        assert remarks.loc[name, "risk"] == objects[name].risk_in_words
        if each in result.ranked()[:10]:
            assert re.search(rf"{re.escape(name)} .{{0,80}}{re.escape(said)}", first), name
        assert re.search(rf"× {re.escape(name)}: .{{0,60}}{re.escape(said)}", rooms), name
        assert re.search(rf"× {re.escape(name)}: .{{0,60}}\({re.escape(said)}\)", written), name
        low, high = limits_in_hundred(each.overturns)
        happens = " ".join(objects[name].happens)
        if each.overturns.value:
            assert f"(likely between {low} and {high})" in happens
        else:
            assert f"up to {high} in 100 cannot be excluded" in happens
        assert "In a plane" not in happens
        assert all(line in cards for line in objects[name].happens)
        assert all(line in cards for line in objects[name].advice)


def test_in_a_narrow_terminal_the_measure_stays_and_the_class_goes(result: Assessment) -> None:
    def shown(width: int) -> str:
        console = Console(file=io.StringIO(), width=width)
        print_assessment(result, console, Path("out"), "24 motions")
        return console.file.getvalue()  # type: ignore[attr-defined]

    assert "first measure" in shown(62).partition("left out")[0]
    assert "left out for want of room: risk" in " ".join(shown(62).split())
    assert "left out for want of room" not in shown(140)


def test_a_document_that_fails_takes_nothing_with_it(
    result: Assessment, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*_: object) -> None:
        raise ValueError("no such style")

    monkeypatch.setattr("shaketable.report.as_docx.write_docx", fails)
    out = tmp_path / "out"
    with pytest.raises(SimulationError, match=r"report\.docx: no such style; all other results"):
        write_results(result, RUN, out, docx=True)
    assert {"report.html", "results.csv", "run.json"} <= {path.name for path in out.iterdir()}


def test_control_characters_of_names_are_escapes_in_a_document(tmp_path: Path) -> None:
    """XML cannot hold them, and the whole run was lost."""
    path = tmp_path / "list.csv"
    path.write_text("name,depth_m,width_m,height_m\nShelf\x0bleft,0.32,0.9,1.8\n")
    pairs = [m for m in suite("fema-p695", pairs=True)[:4] if m.transverse is not None]
    odd = assess(read_inventory(path), pairs, leading=0, progress=False)
    write_docx(odd, RUN, None, tmp_path / "a.docx")
    document = docx.Document(str(tmp_path / "a.docx"))
    assert any("Shelf\\x0bleft" in each.text for each in document.paragraphs)


def test_what_is_not_assessed_is_told_at_the_top(result: Assessment) -> None:
    inventory = {**RUN["inventory"], "not_assessed": ["Water heater"]}
    top = plain(render(result, {**RUN, "inventory": inventory})).partition("What to do first")[0]
    assert (
        "Not assessed, as the list does not give their sizes: Water heater. They may fall." in top
    )


def test_one_thing_on_the_page_has_the_number_of_a_list(tmp_path: Path) -> None:
    """A bookcase and a drum as one thing, in a list, and in Python: to the digit."""
    (tmp_path / "a.csv").write_text(
        "name,depth_m,width_m,height_m,shape\nbookcase,0.32,0.9,1.8,\ndrum,0.3,0.3,1.2,cylinder\n"
    )
    listed = assess(read_inventory(tmp_path / "a.csv"), leading=0, progress=False)
    front, side = Body.rectangle(0.32, 1.8, name="b"), Body.rectangle(0.9, 1.8, name="b")
    drum = Body.rectangle(0.3, 1.2, name="d")
    made = assess(
        [
            Item(body=front, sideways=side, height=1.8),
            Item(body=drum, sideways=drum, height=1.2, shape=BaseShape.CYLINDER),
        ],
        leading=0,
        progress=False,
    )
    things = (
        Upright(shape="box", depth_m=0.32, width_m=0.9, height_m=1.8),
        Upright(shape="cylinder", base_m=0.3, height_m=1.2),
    )
    for thing, row, own in zip(things, listed.results, made.results, strict=True):
        found = space.many(ManyInSpace(thing=thing, curve=False))
        assert row.overturns == own.overturns == Share(found.share, found.low, found.high)
        assert row.by == found.recordings == 48
        assert f"{found.in_100.share} ({found.in_100.low}–{found.in_100.high})" == with_interval(
            row.governing_share
        )


#: A share of 100, as sentences and tables of a report write it.
SHARE = re.compile(r"\d+ (?:of|von|de) 100\b")
INTERVAL = re.compile(r"\(\d+–\d+\)|(?:between|zwischen|entre) \d+ (?:and|und|y) \d+")


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_block_with_a_share_has_its_recordings_and_its_interval(
    result: Assessment, language: Language
) -> None:
    """So that no number stands alone; the cards' are told above all of them."""
    page = render(result, RUN, language=language)
    assert f'lang="{language}"' in page
    shown = re.sub(r"<(script|style)[^>]*>.*?</\1>", "", page, flags=re.DOTALL)
    sections = re.split(r"<h[23][^>]*>", shown)
    told = 0
    for section in sections:
        text = plain(section)
        if re.search(r"class=\"(first|rooms|cards)", section) and SHARE.search(text):
            told += 1
            assert re.search(rf"\b{result.recordings}\b", text), text[:200]
            assert INTERVAL.search(text), text[:200]
    assert told >= 2


@pytest.mark.parametrize("language", [each for each in LANGUAGES if each != "en"])
def test_a_report_speaks_one_language(result: Assessment, language: Language) -> None:
    """No English sentence is left: words that neither Spanish nor German has."""
    page = render(result, RUN, language=language)
    shown = re.sub(r"<(script|style)[^>]*>.*?</\1>", "", page, flags=re.DOTALL)
    text = plain(shown)
    for each in result.results:
        text = text.replace(each.item.name, "").replace(each.item.location, "")
        text = text.replace(each.item.note, "") if each.item.note else text
    left = re.findall(r"\b(?:the|which|falls|its|with|shakings?|of 100|strap)\b", text)
    assert not left, [text[max(0, m.start() - 60) : m.end() + 60]
                      for m in re.finditer(r"\b(?:the|which|its|with)\b", text)][:5]  # fmt: skip


def test_a_page_is_signed_and_names_who_may_do_it(page: str, result: Assessment) -> None:
    first = page.partition("What to do first")[2].partition("How sure is that")[0]
    assert "by a craftsman" in first or "by an engineer" in first or "by anybody" in first
    assert "Seen and decided Date Name Signature" in page
    (best,) = [each for each in result.ranked()[:1] if each.helpful]
    left = best.helpful[0].left
    low, high = limits_in_hundred(left)
    assert f"({low}–{high})" in first
    assert "Not considered: " in page


def test_the_report_can_be_printed(result: Assessment, tmp_path: Path) -> None:
    """The first part on two pages at most, the annex on few more, for 19 kinds."""
    skip_without_printer()
    (tmp_path / "report.html").write_text(render(result, RUN), encoding="utf-8")
    print_pdf(tmp_path / "report.html", tmp_path / "report.pdf")
    content = (tmp_path / "report.pdf").read_bytes()
    assert content.startswith(b"%PDF")
    assert 3 <= len(re.findall(rb"/Type\s*/Page[^s]", content)) <= 6


def _with(result: Assessment, items: list[Item]) -> Assessment:
    """The assessment as one of the same items, read again."""
    by_name = {item.name: item for item in items}

    def same(each: ItemResult) -> ItemResult:
        item = by_name[each.item.name]
        return replace(each, profile=replace(each.profile, item=item))

    (floor,) = result.floors
    return replace(result, floors=[replace(floor, results=[*map(same, floor.results)])])


def test_every_force_of_a_strap_is_what_was_simulated(result: Assessment, page: str) -> None:
    """On cards without a wall and beside one, in the table of forces that beside a wall."""
    objects = {each.name: each for each in _assessed(result, []).objects}
    table = page.partition("Forces")[2].partition("What simple criteria say")[0]
    strapped = [each for each in result.ranked() if each.straps]
    assert len(strapped) == sum(
        any(measure.kind == "strap" for measure in each.mitigations) for each in result.results
    )
    assert strapped
    for each in strapped:
        forces = {
            math.isnan(trial.about["wall_gap_m"]): trial.force  # type: ignore[arg-type]
            for trial in each.straps
            if trial.force
        }
        said = " ".join(objects[each.item.name].advice)
        for force in forces.values():
            assert f"{two_digits(force.high)} times its weight" in said
        told = f"{two_digits(forces[False].high)} ({two_digits(forces[False].largest)})"
        assert re.search(rf"{re.escape(each.item.name)} {re.escape(told)} ", table), each.item.name
    for place in (table, page.partition("Method")[2]):
        assert "A static force is no design value" in place


def test_the_least_force_of_the_code(result: Assessment, page: str) -> None:
    """(0.3 h − b)/H at the top: (0.27 − 0.16)/1.8 of a bookcase of 0.32 × 1.80 m; squat: none."""
    by_name = {each.item.name: each for each in result.results}
    assert code_force(by_name["Bookcase 1.80 m"]) == "0.061"  # 0.11 / 1.8
    assert code_force(by_name["Vertical file 2 drawers"]) == "–"  # its weight holds it
    helps = page.partition("Forces")[2].partition("What simple criteria say")[0]
    assert re.search(r"Bookcase 1\.80 m [\d.]+ \([\d.]+\) 0\.061 ", helps)


@pytest.mark.parametrize("language", ["es", "de"])
def test_other_languages_write_all_numbers_alike(result: Assessment, language: Language) -> None:
    with speaking(language):
        found = _assessed(result, [])
    texts = [*found.headline, *found.how_sure]
    for each in found.objects:
        texts += [*each.happens, *each.advice, each.measure, each.risk_in_words]
    for text in texts:
        for name in (each.name for each in found.objects):
            text = text.replace(name, "")
        assert not re.search(r"\d\.\d(?!\d\d)", text), text
    assert any(re.search(r"\d,\d", text) for text in texts)


def test_places_never_say_zero(page: str) -> None:
    where = page.partition("Room by room")[2].partition("Annex")[0]
    rows = re.findall(r"(none|[\d.]+) \((\d+)–(\d+)\) of \d+ pieces", where)
    assert rows
    assert all(told != "0.0" and int(low) <= int(high) for told, low, high in rows)
