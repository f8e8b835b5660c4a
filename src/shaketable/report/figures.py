"""Figures of the objects in one place."""

from __future__ import annotations

import io
import textwrap

import numpy as np
from matplotlib.figure import Figure

from shaketable.assess import FEW_FALLS, NOT_CLASSED, ItemResult
from shaketable.drawing.shown import drawn
from shaketable.units import degrees

#: Of the classes, the worse the darker, so that they are told apart in grey and by all eyes.
COLORS = {
    "low": "#d4ecd0",
    FEW_FALLS: "#bcd7ee",
    "medium": "#e9bd4f",
    "high": "#dd7a37",
    "very high": "#8f2a1c",
    NOT_CLASSED: "#9a9a9a",
}
PANEL = (3.4, 2.6)  # inches: as wide as a card, with text as large as the page's


def svg(figure: Figure) -> str:
    """A figure as the text of an SVG file; the same figure always gives the same text."""
    text = io.StringIO()
    import matplotlib as mpl

    with mpl.rc_context({"svg.hashsalt": "shaketable"}):
        figure.savefig(text, format="svg", metadata={"Date": None})
    return text.getvalue()


def tilt_curve(result: ItemResult, control: float) -> Figure:
    """What tilting does to an object: how often it falls, and which way.

    Args:
        result: of an item that does not roll.
        control: wanted share of the falls that go downhill.
    """
    curves = result.curves
    assert curves is not None
    figure = Figure(figsize=PANEL, layout="constrained")
    ax = figure.subplots()
    tilts = np.degrees(curves.tilts)
    for share, band, color, style in (
        (curves.downhill_share, curves.downhill_band, "tab:blue", "-"),
        (curves.fall_share, curves.fall_band, "tab:red", "--"),
    ):
        ax.plot(tilts, 100 * share, color=color, ls=style, marker=".", ms=3)
        low, high = (100 * end for end in band)
        ax.fill_between(tilts, low, high, color=color, alpha=0.15, lw=0)
    ax.axhline(100 * control, color="0.5", ls="--", lw=0.8)
    if np.isfinite(curves.control_tilt):
        ax.axvline(degrees(curves.control_tilt), color="tab:blue", ls=":", lw=1.2)
    ax.set_title("\n".join(textwrap.wrap(drawn(result.item.name), 32)), fontsize=11)
    ax.set_ylim(0, 103)
    ax.set_xlabel("tilt of the support [°]")
    ax.set_ylabel("share [%]")
    return figure
