"""An assessment, and what a study finds, as tables in the terminal."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Literal, NamedTuple

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from shaketable.assess import (
    ACCEPTED_FALLS,
    FEW_FALLS,
    NOT_CLASSED,
    Assessment,
    ItemResult,
    fate_of,
)
from shaketable.errors import printable
from shaketable.inventory import Inventory
from shaketable.language import listed, tell, translated
from shaketable.report.words import headline
from shaketable.report.words.advice import first_measure, safe_base
from shaketable.report.words.carried import often
from shaketable.report.words.numbers import (
    counted,
    expected_count,
    in_hundred_short,
    of_pieces,
    with_interval,
)
from shaketable.study import Study
from shaketable.units import degrees

MOST_FIRST = 10  # of a building
MOST_ROWS = 20
NAME = 18  # columns at least for a name
FOLDED = 16  # characters to which a column may be folded
STYLES = {
    "low": "green",
    FEW_FALLS: "cyan",
    "medium": "yellow",
    "high": "dark_orange",
    "very high": "red",
    NOT_CLASSED: "default",
}


def _table() -> Table:
    return Table(box=SIMPLE_HEAD, pad_edge=False, show_edge=False, padding=0)


SAMPLES = 3  # cells of a column that are shown
SHORT = 12  # characters of each


def _short(text: str) -> str:
    return text if len(text) <= SHORT else f"{text[:SHORT]}…"


def print_columns(path: Path, inventory: Inventory, console: Console) -> None:
    """Print how the columns of an inventory were understood."""
    view = _table()
    view.add_column(tell("column"), overflow="fold")
    view.add_column(tell("read as"), overflow="fold")
    view.add_column(tell("cells"), overflow="fold")
    for k, (header, column) in enumerate(inventory.columns):
        if not header:
            continue
        cells = [_short(row[k]) for row in inventory.rows if row[k : k + 1] and row[k]]
        meaning = translated(column.meaning.replace("_", " ") if column else "not used")
        unit = ""
        if column and column.unit:
            unit = tell(" in {unit}", unit=column.unit)
            unit += "" if column.stated else tell(", as no unit is given")
        view.add_row(plain(header), f"{meaning}{unit}", plain(" · ".join(cells[:SAMPLES])))
    objects = counted(len(inventory.items), "kind of object")
    console.print(f"{plain(str(path))}: {objects}, {inventory.kind}", highlight=False)
    console.print(view)


def print_assessment(assessment: Assessment, console: Console, folder: Path, shaking: str) -> None:
    """Print what happens, how sure that is, and what to look at first.

    Args:
        assessment: what was found.
        console: its width decides how many columns are shown.
        folder: where the results lie.
        shaking: the motions in words.
    """
    peaks = headline.peaks(assessment.floors)
    console.print(
        plain(tell("Shaken by {motions}, peaks {peaks}", motions=shaking, peaks=peaks)),
        highlight=False,
    )
    sentences = (
        *headline.headline(assessment),
        *headline.how_sure(assessment),
        *headline.uncertainty(assessment),
    )
    for sentence in sentences:
        console.print(plain(sentence), highlight=False)
    _print_levels(assessment, console)
    in_building = assessment.in_building
    ordered = assessment.ranked()
    shown = ordered[: MOST_FIRST if in_building else MOST_ROWS]
    columns, left_out = _fitting(assessment, shown, console.width)
    name = max(len(tell("object")), *(len(printable(result.item.name)) for result in shown))
    name = min(name, console.width - sum(columns.values()) - 1)
    view = _table()
    view.add_column(tell("object"), no_wrap=True, width=name)
    for column, width in columns.items():
        view.add_column(
            column.header, justify=column.justify, no_wrap=not column.folds, width=width - 1
        )
    for result in shown:
        cells = (f"[{STYLES[result.risk]}]{column.cell(result)}[/]" if column.coloured
                 else column.cell(result) for column in columns)  # fmt: skip
        view.add_row(plain(result.item.name), *cells)
    console.print(view)
    told = [column.told for column in columns if column.told]
    if len(ordered) > len(shown):
        told.append(
            tell("{count} more objects are in results.csv", count=len(ordered) - len(shown))
        )
    if left_out:
        told.append(
            tell(
                "left out for want of room: {columns}; see {page}",
                columns=listed([translated(column.name) for column in left_out]),
                page=folder / "report.html",
            )
        )
    console.print(f"[dim]{plain('; '.join(told))}[/]", highlight=False)
    if in_building:
        _print_floors(assessment, console)


class _Column(NamedTuple):
    """A column of the table."""

    header: str
    name: str
    told: str  # what it means, for the lines below the table
    cell: Callable[[ItemResult], str]
    justify: Literal["left", "right"] = "right"
    coloured: bool = False
    folds: bool = False  # whether its texts may take several lines


def _columns(assessment: Assessment) -> list[_Column]:
    """All columns, the most important first."""
    rolls = any(each.item.rolls for each in assessment.results)
    held = any(each.as_it_stands for each in assessment.results)
    flat = [each for each in assessment.results if each.solid is None]
    what = tell(
        "falls in 100 shakings from {recordings} independent {sources}, with the 95 % interval",
        recordings=assessment.recordings,
        sources=translated(assessment.sources),
    )
    what += tell(" (on castors: falls, or goes farther than half a metre)") if rolls else ""
    what += tell(" (at walls and in straps: falls, or only these hold it up)") if held else ""
    what += tell(", some in a plane alone") if flat and assessment.solids else ""
    found = [
        _Column(tell("in 100\nshakings"), "falls", what, _share, coloured=True),
        _Column(tell("at a\nwall"), "at a wall", tell("at a wall: the same against one"), _walled),
        _Column(tell("objects\nuncertain"), "objects uncertain", tell(
                "objects uncertain: the same for objects like it"), _uncertain),
        _Column(tell("first measure"), "first measure", "", partial(first_measure,
                premises=assessment.premises), "left", folds=True),
        _Column(tell("risk"), "risk", "", _risk, "left", coloured=True),
        _Column(tell("floor"), "floor", "", lambda result: plain(result.item.floor), "left"),
        _Column(tell("base\nm"), "base", tell("base: deep enough that at most {limit:g} % fall",
                limit=100 * ACCEPTED_FALLS), _base),
        _Column(tell("slip\ncm"), "slip", tell("slip: median of the farthest where it stands"),
                _slip),
        _Column(tell("walks\noff"), "walks off", tell("walks off its support in 100 shakings"),
                _walks),
        _Column(tell("tilt\n°"), "tilt", tell("tilt: sends {share:g} % of the falls one way",
                share=100 * assessment.control), _tilt),
    ]  # fmt: skip
    slides = any(each.sliding for each in flat)
    off = any(each.profile.support_length for each in assessment.results)
    unused = {
        "at a wall": all(_walled(each) == "-" for each in assessment.results),
        "objects uncertain": not assessment.uncertain,
        "floor": not any(each.item.floor for each in assessment.results),
        "base": not flat,
        "tilt": not flat,
        "slip": not slides,
        "walks off": not (slides and off),
    }
    return [column for column in found if not unused.get(column.name)]


def _fitting(
    assessment: Assessment, shown: list[ItemResult], width: int
) -> tuple[dict[_Column, int], list[_Column]]:
    """The columns that fit into a width, each with its own, and the others."""
    room = width - NAME - 1
    fitting: dict[_Column, int] = {}
    left_out: list[_Column] = []
    for column in _columns(assessment):
        own = _width(column, shown)
        if column.folds and FOLDED <= room < own:
            own = room
        room -= own
        if room >= 0:
            fitting[column] = own
        else:
            left_out.append(column)
            room = -1  # what is less important is not shown in its place
    return fitting, left_out


def _width(column: _Column, shown: list[ItemResult]) -> int:
    """The width of a column and the gap before it."""
    texts = [*column.header.split("\n"), *(column.cell(result) for result in shown)]
    return max(map(len, texts)) + 1


def _share(result: ItemResult) -> str:
    return often(result)


def _walled(result: ItemResult) -> str:
    walled = result.at_a_wall
    return "-" if walled is None or result.as_it_stands else in_hundred_short(walled.value)


def _uncertain(result: ItemResult) -> str:
    return with_interval(result.uncertain.fall) if result.uncertain else "-"


def _risk(result: ItemResult) -> str:
    rolls = result.item.rolls and result.risk == NOT_CLASSED
    if result.item.stands_on and result.risk == NOT_CLASSED:
        return tell("on furniture")
    return tell("on castors") if rolls else translated(result.risk)


def _base(result: ItemResult) -> str:
    width = result.profile.body.base
    if result.curves is None or result.solid:
        return "-"
    if result.fall.value <= ACCEPTED_FALLS:
        return f"{width:.2f}"
    return f"{width:.2f}→{safe_base(result)}"


def _slip(result: ItemResult) -> str:
    if result.sliding is None or result.solid:
        return "-"
    return _number(100 * result.sliding.slip.median, ".1f")


def _walks(result: ItemResult) -> str:
    return in_hundred_short(result.sliding.walks_off) if result.sliding else "-"


def _tilt(result: ItemResult) -> str:
    if result.curves is None or result.item.must_not_fall or result.falls_either_way:
        return "-"
    if result.solid:
        return "-"
    return _number(degrees(result.curves.control_tilt), ".2f")


def _print_levels(assessment: Assessment, console: Console) -> None:
    if not assessment.levels:
        return
    view = _table()
    view.add_column(tell("level"))
    kinds = tell("kinds over {limit:g} %", limit=100 * ACCEPTED_FALLS)
    for header in (tell("pieces that fall"), kinds):
        view.add_column(header, justify="right")
    for k, level in enumerate(assessment.levels):
        falls, many = assessment.at_level(k)
        view.add_row(plain(level.name), expected_count(falls), f"{many}")
    console.print(view)


def _print_floors(assessment: Assessment, console: Console) -> None:
    fates = [(floor.floor, fate_of(floor.results)) for floor in reversed(assessment.floors)]
    rolling = any(fate.rolling for _, fate in fates)
    view = _table()
    view.add_column(tell("floor"))
    far = [tell("roll far")] if rolling else []
    for header in (translated("pieces"), tell("fall"), *far):
        view.add_column(header, justify="right")
    for label, fate in fates:
        far = [of_pieces(fate.rolls_far, fate.pieces)] if rolling else []
        view.add_row(plain(label), f"{fate.pieces}", of_pieces(fate.falls, fate.pieces), *far)
    console.print(view)


def plain(text: str) -> str:
    """A text as it is, without markup, control characters as escapes."""
    return escape(printable(text))


def print_claims(study: Study, console: Console) -> None:
    """Print what the paper says beside what was found."""
    view = Table(
        box=SIMPLE_HEAD,
        pad_edge=False,
        caption=study.records,
        caption_justify="left",
    )
    for header in ("claim", "paper says", "we find", "holds"):
        view.add_column(header)
    for row in study.tables["claims"].to_dict("records"):
        cells = (row["claim"], row["paper_says"], row["we_find"], row["holds"])
        view.add_row(*(plain(str(cell)) for cell in cells))
    console.print(view)


def _number(value: float, form: str) -> str:
    return format(value, form) if math.isfinite(value) else "-"
