"""An assessment, and what a study finds, as tables in the terminal."""

from __future__ import annotations

import math
from pathlib import Path

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from shaketable.assess import ACCEPTED_FALLS, Assessment, FloorAssessment, ItemResult
from shaketable.errors import printable
from shaketable.inventory import Inventory
from shaketable.studies import Study
from shaketable.units import degrees

MOST_ROWS = 60
WIDTHS = {
    "falls %": 10,
    "down-\nhill %": 6,
    "peak\n°": 4,
    "tilt\n°": 4,
    "then\nfalls %": 7,
    "base\nm": 11,
}
LEFT_OUT = ("peak\n°", "then\nfalls %")  # where sliding needs their room within 80 columns
STYLES = {"low": "green", "medium": "yellow", "high": "dark_orange", "very high": "red"}


def print_columns(path: Path, inventory: Inventory, console: Console) -> None:
    """Print how the columns of an inventory were understood."""
    view = Table(box=SIMPLE_HEAD, pad_edge=False, padding=(0, 1), title_justify="left")
    view.add_column("column", overflow="fold")
    view.add_column("read as", overflow="fold")
    for header, column in inventory.columns:
        if not header:
            continue
        meaning = column.meaning.replace("_", " ") if column else "not used"
        unit = ""
        if column and column.unit:
            unit = f" in {column.unit}{'' if column.stated else ', as no unit is given'}"
        view.add_row(plain(header), f"{meaning}{unit}")
    objects = f"{len(inventory.items)} kind{'' if len(inventory.items) == 1 else 's'} of object"
    console.print(f"{plain(str(path))}: {objects}, {inventory.kind}", highlight=False)
    console.print(view)


def print_table(assessment: Assessment, console: Console) -> None:
    """Print every floor's objects, those that fall most first, in the width of a terminal."""
    for floor in assessment.floors:
        if floor.floor:
            console.print(f"floor {plain(floor.floor)}")
        _print_floor(floor, assessment, console)


def _print_floor(floor: FloorAssessment, assessment: Assessment, console: Console) -> None:
    slides = assessment.model.slides
    view = Table(
        box=SIMPLE_HEAD,
        pad_edge=False,
        show_edge=False,
        padding=(0, 1, 0, 0),
        caption="shares of simulated shakings in %, with their 95 % Wilson interval; "
        + ("" if slides else "peak: median rotation; ")
        + f"tilt: smallest that sends {100 * assessment.control:g} % of the falls "
        "downhill; base: wide enough that at most "
        f"{100 * ACCEPTED_FALLS:g} % fall"
        + ("; slip: median of the farthest slip where it stands" if slides else ""),
        caption_justify="left",
    )
    view.add_column("object", no_wrap=True, max_width=20)
    shown = {
        header: width for header, width in WIDTHS.items() if not (slides and header in LEFT_OUT)
    }
    for header, width in shown.items():
        view.add_column(header, justify="right", no_wrap=True, min_width=width)
    if slides:
        view.add_column("slip\ncm", justify="right", no_wrap=True, min_width=4)
        view.add_column("walks\noff %", justify="right", no_wrap=True, min_width=5)
    ordered = floor.worst_first()
    for result in ordered[:MOST_ROWS]:
        cells = _cells(result)
        sliding = _sliding(result)
        view.add_row(plain(result.item.name), *(cells[header] for header in shown), *sliding)
    console.print(view)
    if len(ordered) > MOST_ROWS:
        console.print(f"... and {len(ordered) - MOST_ROWS} more in results.csv")


def plain(text: str) -> str:
    """A text as it is, without markup, control characters as escapes."""
    return escape(printable(text))


def _cells(result: ItemResult) -> dict[str, str]:
    """What each column shows for an item."""
    fall, curves, width = result.fall, result.curves, result.item.body.width
    style = STYLES[result.risk]
    enough = fall.value <= ACCEPTED_FALLS
    return {
        "falls %": f"[{style}]{100 * fall.value:.0f}[/] [dim]({100 * fall.low:.0f}-"
        f"{100 * fall.high:.0f})[/]",
        "down-\nhill %": _number(100 * result.downhill.value, ".0f"),
        "peak\n°": _number(degrees(result.peak_rotation.median), ".1f"),
        "tilt\n°": _number(degrees(curves.control_tilt), ".2f"),
        "then\nfalls %": _number(100 * curves.fall_share_there, ".0f"),
        "base\nm": "wide enough" if enough else f"{width:.2f}→{_number(result.safe_width, '.2f')}",
    }


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


def _sliding(result: ItemResult) -> tuple[str, ...]:
    if result.sliding is None:
        return ()
    return (
        _number(100 * result.sliding.slip.median, ".1f"),
        _number(100 * result.sliding.walks_off, ".0f"),
    )


def _number(value: float, form: str) -> str:
    return format(value, form) if math.isfinite(value) else "-"
