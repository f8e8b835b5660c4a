"""Figures of an assessment."""

from __future__ import annotations

import io
import textwrap

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from shaketable.assess import ACCEPTED_FALLS, Assessment

MOST_BARS = 40
MOST_PANELS = 12
COLORS = {"low": "#4c9f70", "medium": "#e9c46a", "high": "#f4a261", "very high": "#c8553d"}


def svg(figure: Figure) -> str:
    """A figure as the text of an SVG file, the same for the same figure."""
    text = io.StringIO()
    import matplotlib as mpl

    with mpl.rc_context({"svg.hashsalt": "shaketable"}):
        figure.savefig(text, format="svg", metadata={"Date": None})
    return text.getvalue()


def _plain(name: str) -> str:
    """A name as it is, not as a formula."""
    return name.replace("$", r"\$")


def fall_shares(assessment: Assessment, ax: Axes | None = None) -> Axes:
    """Share of simulations that overturn each object, the worst on top, with its interval."""
    table = assessment.worst_first().head(MOST_BARS)[::-1]
    if ax is None:
        figure = Figure(figsize=(9, 1.2 + 0.32 * len(table)), layout="constrained")
        ax = figure.subplots()
    share = 100 * table["fall_share"]
    spread = [share - 100 * table["fall_share_low"], 100 * table["fall_share_high"] - share]
    ax.barh(
        [_plain(name) for name in table["name"]],
        share,
        xerr=np.clip(spread, 0, None),
        color=[COLORS[risk] for risk in table["risk"]],
        ecolor="0.25",
        capsize=2.5,
    )
    ax.axvline(100 * ACCEPTED_FALLS, color="0.4", ls="--", lw=0.9)
    ax.set_xlim(0, 100)
    ax.set_xlabel(
        "share of shakings that overturn it [%]; bars in black: 95 % interval; "
        f"dashed: {100 * ACCEPTED_FALLS:.0f} %"
    )
    ax.margins(y=0.01)
    return ax


def tilt_curves(assessment: Assessment) -> Figure | None:
    """What tilting does to the objects that fall most: how often they fall, and which way."""
    table = assessment.worst_first()
    chosen = table.index[table["fall_share"] > ACCEPTED_FALLS][:MOST_PANELS]
    if not len(chosen):
        return None
    columns = 3  # empty ones too: one panel alone would fill the page
    rows = -(-len(chosen) // columns)
    figure = Figure(figsize=(3.2 * columns, 2.3 * rows + 0.6), layout="constrained")
    axes = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False).ravel()
    for ax, k in zip(axes, chosen, strict=False):
        curves = assessment.curves[k]
        for share, band, color, label in (
            (curves.downhill_share, curves.downhill_band, "tab:blue", "falls that go downhill"),
            (curves.fall_share, curves.fall_band, "tab:red", "shakings that overturn it"),
        ):
            ax.plot(assessment.tilts_deg, 100 * share, color=color, marker=".", label=label)
            low, high = (100 * end for end in band)
            ax.fill_between(assessment.tilts_deg, low, high, color=color, alpha=0.15, lw=0)
        ax.axhline(100 * assessment.control, color="0.5", ls="--", lw=0.8)
        tilt = table["control_tilt_deg"][k]
        if np.isfinite(tilt):
            ax.axvline(tilt, color="tab:blue", ls=":", lw=1.2, label="smallest tilt for control")
        ax.set_title("\n".join(textwrap.wrap(_plain(table["name"][k]), 30)), fontsize="medium")
        ax.set_ylim(0, 103)
    for ax in axes[len(chosen) :]:
        ax.set_visible(False)
    figure.supxlabel("tilt of the support [°]")
    figure.supylabel("share [%]")
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3)
    return figure
