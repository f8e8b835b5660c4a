"""An assessment, and what a study finds, as tables in the terminal."""

from __future__ import annotations

import math
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from shaketable.assess import ACCEPTED_FALLS, Assessment
from shaketable.studies import Study

MOST_ROWS = 60
WIDTHS = {
    "falls %": 10,
    "down-\nhill %": 6,
    "peak\n°": 4,
    "tilt\n°": 4,
    "then\nfalls %": 7,
    "base\nm": 11,
}
LEFT_OUT = ("peak\n°", "then\nfalls %")  # where sliding needs the room of 80 columns
STYLES = {"low": "green", "medium": "yellow", "high": "dark_orange", "very high": "red"}


def print_table(assessment: Assessment, console: Console) -> None:
    """The objects that fall most first, in the width of a terminal."""
    slides = assessment.model == "general"
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
        + ("; slip: median of the farthest where it stands" if slides else ""),
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
    ordered = assessment.worst_first()
    for row in ordered.head(MOST_ROWS).to_dict("records"):
        style = STYLES[row["risk"]]
        low, high = 100 * row["fall_share_low"], 100 * row["fall_share_high"]
        cells = {
            "falls %": f"[{style}]{100 * row['fall_share']:.0f}[/] [dim]({low:.0f}-{high:.0f})[/]",
            "down-\nhill %": _number(100 * row["downhill_share"], ".0f"),
            "peak\n°": _number(row["peak_rotation_median_deg"], ".1f"),
            "tilt\n°": _number(row["control_tilt_deg"], ".1f"),
            "then\nfalls %": _number(100 * row["fall_share_at_control_tilt"], ".0f"),
            "base\nm": "wide enough"
            if row["fall_share"] <= ACCEPTED_FALLS
            else f"{row['width_m']:.2f}→{_number(row['safe_width_m'], '.2f')}",
        }
        sliding = _sliding(row) if slides else ()
        view.add_row(escape(row["name"]), *(cells[header] for header in shown), *sliding)
    console.print(view)
    if len(ordered) > MOST_ROWS:
        console.print(f"... and {len(ordered) - MOST_ROWS} more in results.csv")


def print_claims(study: Study, console: Console) -> None:
    """What the paper says beside what was found."""
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
        view.add_row(*(escape(str(cell)) for cell in cells))
    console.print(view)


def _sliding(row: dict[Any, Any]) -> tuple[str, str]:
    return (
        _number(100 * row["slip_median_m"], ".1f"),
        _number(100 * row["walks_off_share"], ".0f"),
    )


def _number(value: float, form: str) -> str:
    return "-" if math.isnan(value) else format(value, form)
