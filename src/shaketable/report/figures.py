"""Figures of the objects in one place."""

from __future__ import annotations

import io
import textwrap

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from shaketable.assess import ACCEPTED_FALLS, FloorAssessment
from shaketable.drawing.names import drawn
from shaketable.units import degrees

MOST_BARS = 40
MOST_PANELS = 12
COLORS = {"low": "#4c9f70", "medium": "#e9c46a", "high": "#f4a261", "very high": "#c8553d"}


def svg(figure: Figure) -> str:
    """A figure as the text of an SVG file; the same figure always gives the same text."""
    text = io.StringIO()
    import matplotlib as mpl

    with mpl.rc_context({"svg.hashsalt": "shaketable"}):
        figure.savefig(text, format="svg", metadata={"Date": None})
    return text.getvalue()


def fall_shares(floor: FloorAssessment, ax: Axes | None = None) -> Axes:
    """Share of simulations that overturn each object, the worst on top, with its interval."""
    results = floor.worst_first()[:MOST_BARS][::-1]
    if ax is None:
        figure = Figure(figsize=(9, 1.2 + 0.32 * len(results)), layout="constrained")
        ax = figure.subplots()
    share, low, high = 100 * np.array([result.fall for result in results]).T
    ax.barh(
        [drawn(result.item.name) for result in results],
        share,
        xerr=np.clip([share - low, high - share], 0, None),
        color=[COLORS[result.risk] for result in results],
        ecolor="0.25",
        capsize=2.5,
    )
    ax.axvline(100 * ACCEPTED_FALLS, color="0.4", ls="--", lw=0.9)
    ax.set_xlim(0, 100)
    ax.set_xlabel(
        "share of shakings that overturn it [%]; black bars: 95 % interval; "
        f"dashed: {100 * ACCEPTED_FALLS:.0f} %"
    )
    ax.margins(y=0.01)
    return ax


def tilt_curves(floor: FloorAssessment, control: float) -> Figure | None:
    """What tilting does to the objects that fall most: how often they fall, and which way.

    Args:
        floor: what stands in one place.
        control: wanted share of the falls that go downhill.
    """
    often = [each for each in floor.worst_first() if each.fall.value > ACCEPTED_FALLS]
    chosen = often[:MOST_PANELS]
    if not chosen:
        return None
    columns = 3  # some may stay empty: one panel alone would fill the page
    rows = -(-len(chosen) // columns)
    figure = Figure(figsize=(3.2 * columns, 2.3 * rows + 0.6), layout="constrained")
    axes = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel()
    for ax, result in zip(axes, chosen, strict=False):
        curves = result.curves
        tilts = np.degrees(curves.tilts)
        for share, band, color, label in (
            (curves.downhill_share, curves.downhill_band, "tab:blue", "falls that go downhill"),
            (curves.fall_share, curves.fall_band, "tab:red", "shakings that overturn it"),
        ):
            ax.plot(tilts, 100 * share, color=color, marker=".", ms=3, label=label)
            low, high = (100 * end for end in band)
            ax.fill_between(tilts, low, high, color=color, alpha=0.15, lw=0)
        ax.axhline(100 * control, color="0.5", ls="--", lw=0.8)
        if np.isfinite(curves.control_tilt):
            label = "smallest tilt for control"
            ax.axvline(degrees(curves.control_tilt), color="tab:blue", ls=":", lw=1.2, label=label)
        name = "\n".join(textwrap.wrap(drawn(result.item.name), 30))
        ax.set_title(name, fontsize="medium")
        ax.set_ylim(0, 103)
    for ax in axes[len(chosen) :]:
        ax.set_visible(False)
    figure.supxlabel("tilt of the support [°]")
    figure.supylabel("share [%]")
    every = [ax.get_legend_handles_labels() for ax in axes[: len(chosen)]]
    handles, labels = max(every, key=lambda each: len(each[1]))  # with the tilt, if any has one
    figure.legend(handles, labels, loc="outside upper center", ncols=3)
    return figure
