"""The pictures of an assessment on the first page: shares of falls, and a building."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from shaketable.drawing.names import drawn

from shaketable.assess import ACCEPTED_FALLS, Assessment, ItemResult
from shaketable.criteria.kaneko_hayashi_2004 import RISK_CLASSES, risk_class
from shaketable.report.figures import COLORS
from shaketable.report.words.headline import floor_name
from shaketable.report.words.numbers import expected_count
from shaketable.units import STANDARD_GRAVITY

WIDTH, HEIGHT = 5.0, 1.0  # of a storey, as drawn


def fall_shares(results: list[ItemResult], ax: Axes | None = None) -> Axes:
    """Share of simulations that overturn each object, the first on top, with its interval."""
    shown = results[::-1]
    if ax is None:
        figure = Figure(figsize=(9, 1.2 + 0.32 * len(shown)), layout="constrained")
        ax = figure.subplots()
    share, low, high = 100 * np.array([result.fall for result in shown]).T
    ax.barh(
        [drawn(result.item.name) for result in shown],
        share,
        xerr=np.clip([share - low, high - share], 0, None),
        color=[COLORS[result.risk] for result in shown],
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


def building_picture(name: str, floors: Sequence[str], assessment: Assessment) -> Figure:
    """Every floor from the lowest up, coloured by the share of its pieces that fall.

    Args:
        name: of the building.
        floors: labels of all floors, from the lowest to the highest.
        assessment: that of the floors that have items.
    """
    found = {floor.floor: floor for floor in assessment.floors}
    figure = Figure(figsize=(8.4, 1.1 + 0.55 * len(floors)), layout="constrained")
    ax = figure.subplots()
    for k, label in enumerate(floors):
        floor = found.get(label)
        share = floor.expected_falls / floor.pieces if floor else 0.0
        colour = COLORS[risk_class(share)] if floor else "white"
        ax.add_patch(Rectangle((0.0, k * HEIGHT), WIDTH, HEIGHT, fc=colour, ec="0.3", lw=1.2))
        ax.text(-0.15, (k + 0.5) * HEIGHT, drawn(floor_name(label)), ha="right", va="center")
        said = "nothing assessed"
        if floor:
            smallest, largest = (
                peak / STANDARD_GRAVITY for peak in (floor.smallest_pga, floor.largest_pga)
            )
            said = (
                f"{expected_count(floor.expected_falls)} of {floor.pieces} pieces fall on average "
                f"({100 * share:.0f} %); peaks {smallest:.2f} to {largest:.2f} g"
            )
        ax.text(WIDTH + 0.15, (k + 0.5) * HEIGHT, said, ha="left", va="center", fontsize="small")
    ax.plot([-0.6, WIDTH + 0.6], [0.0, 0.0], color="0.3", lw=2)
    ax.set_xlim(-1.2, 2.4 * WIDTH)
    ax.set_ylim(-0.15, len(floors) * HEIGHT + 0.1)
    ax.set_axis_off()
    ax.set_title(drawn(name))
    handles = [Rectangle((0, 0), 1, 1, fc=COLORS[risk], ec="0.3") for risk in RISK_CLASSES]
    figure.legend(
        handles, [f"{risk} risk" for risk in RISK_CLASSES], loc="outside lower center",
        ncols=len(RISK_CLASSES), fontsize="small",
    )  # fmt: skip
    return figure
