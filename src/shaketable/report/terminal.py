"""An assessment as a table in the terminal."""

from __future__ import annotations

import math

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from shaketable.assess import ACCEPTED_FALLS, Assessment

MOST_ROWS = 60
WIDTHS = {
    "falls %": 10,
    "down-\nhill %": 6,
    "peak\n°": 4,
    "tilt\n°": 4,
    "then\nfalls %": 7,
    "base\nm": 11,
}
STYLES = {"low": "green", "medium": "yellow", "high": "dark_orange", "very high": "red"}


def print_table(assessment: Assessment, console: Console) -> None:
    """The objects that fall most first, in the width of a terminal."""
    view = Table(
        box=SIMPLE_HEAD,
        pad_edge=False,
        padding=(0, 1),
        caption="shares of simulated shakings in %, with their 95 % Wilson interval; peak: median "
        f"rotation; tilt: smallest that sends {100 * assessment.control:g} % of the falls "
        "downhill; base: wide enough that at most "
        f"{100 * ACCEPTED_FALLS:g} % fall",
        caption_justify="left",
    )
    view.add_column("object", no_wrap=True, max_width=20)
    for header, width in WIDTHS.items():
        view.add_column(header, justify="right", no_wrap=True, min_width=width)
    ordered = assessment.worst_first()
    for row in ordered.head(MOST_ROWS).to_dict("records"):
        style = STYLES[row["risk"]]
        low, high = 100 * row["fall_share_low"], 100 * row["fall_share_high"]
        view.add_row(
            escape(row["name"]),
            f"[{style}]{100 * row['fall_share']:.0f}[/] [dim]({low:.0f}-{high:.0f})[/]",
            _number(100 * row["downhill_share"], ".0f"),
            _number(row["peak_rotation_median_deg"], ".1f"),
            _number(row["control_tilt_deg"], ".1f"),
            _number(100 * row["fall_share_at_control_tilt"], ".0f"),
            "wide enough"
            if row["fall_share"] <= ACCEPTED_FALLS
            else f"{row['width_m']:.2f}→{_number(row['safe_width_m'], '.2f')}",
        )
    console.print(view)
    if len(ordered) > MOST_ROWS:
        console.print(f"... and {len(ordered) - MOST_ROWS} more in results.csv")


def _number(value: float, form: str) -> str:
    return "-" if math.isnan(value) else format(value, form)
