"""Figures of the study."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from shaketable.study import Study
from shaketable_studies.captions import caption
from shaketable_studies.shaketable_2026_solids.claims import PUBLISHED
from shaketable_studies.shaketable_2026_solids.direction import DIRECTIONS, PLANE
from shaketable_studies.shaketable_2026_solids.measures import OF_GROUND, OF_PAIR
from shaketable_studies.shaketable_2026_solids.shares import PLANAR, SCALES, SOLID

BARS = "Bars: 95 % interval over events and their recordings."


def figures(study: Study) -> Iterator[tuple[str, Figure]]:
    """Each figure with its name; matplotlib keeps none of them."""
    for name, (title, draw) in FIGURES.items():
        figure = draw(study)
        caption(figure, f"{title} {study.records}. {BARS}")
        yield name, figure


def _direction(study: Study) -> Figure:
    table = study.tables["direction"]
    figure = Figure(figsize=(11, 4.6), layout="constrained")
    axes = figure.subplots(1, len(DIRECTIONS), sharey=True)
    plane = table[table["base"] == PLANE]
    for ax, (base, directions) in zip(axes, DIRECTIONS.items(), strict=True):
        ax.axvspan(*PUBLISHED, color="0.92", label="published, for 95 %")
        ax.plot(plane["tilt_deg"], 100 * plane["downhill"], "k--", lw=1, label="in a plane")
        for k, direction in enumerate(directions):
            here = table[(table["base"] == base) & (table["direction_deg"] == direction)]
            _with_bars(ax, here, f"{direction:g}°", f"C{k}", 0.06 * (k - 1))
        ax.axhline(95.0, color="0.5", lw=0.8)
        ax.set_title(f"{base} base")
        ax.set_xlabel("tilt [°]")
        ax.legend(loc="lower right", fontsize="small", title="tilted, from the short side")
    axes[0].set_ylabel("falls downhill [%]")
    return figure


def _with_bars(ax: Axes, here, label: str, colour: str, aside: float) -> None:  # type: ignore[no-untyped-def]
    share, low, high = (100 * here[name].to_numpy() for name in ("downhill", "low", "high"))
    ax.errorbar(
        here["tilt_deg"] + aside, share, [share - low, high - share], color=colour, marker="o",
        ms=3, lw=1, elinewidth=0.7, label=label,
    )  # fmt: skip


def _shares(study: Study) -> Figure:
    table = study.tables["shares"]
    figure = Figure(figsize=(10, 5.2), layout="constrained")
    axes = figure.subplots(1, len(SCALES), sharey=True)
    names = [*PLANAR, *SOLID]
    for ax, scale in zip(axes, SCALES, strict=True):
        here = table[table["scale"] == scale]
        sizes = [name for name in here["size"].unique() if name != "all"]
        for k, name in enumerate(names):
            mine = here[(here["case"] == name) & (here["size"] != "all")]
            share, low, high = (
                100 * mine[each].to_numpy() for each in ("fall_share", "low", "high")
            )
            at = np.arange(len(sizes)) + 0.14 * (k - 2)
            solid = name in SOLID
            ax.errorbar(
                at, share, [share - low, high - share], fmt="s" if solid else "o", ms=4,
                mfc=None if solid else "white", lw=0, elinewidth=0.7,
                label=f"{name} base, both components" if solid else f"plane, {name}",
            )  # fmt: skip
        ax.set_xticks(np.arange(len(sizes)), sizes, rotation=60, ha="right", fontsize="small")
        ax.set_title(f"motions × {scale:g}")
        ax.set_ylim(-2, 102)
    axes[0].set_ylabel("overturn [%]")
    figure.legend(
        *axes[0].get_legend_handles_labels(), fontsize="small", loc="outside lower center", ncols=3
    )
    return figure


def _losses(study: Study) -> Figure:
    table = study.tables["losses"]
    figure = Figure(figsize=(9, 5.2), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    names = list(dict.fromkeys(table["changed"]))
    panels = (
        ("square", PLANAR[0], "boxes over the plane"),
        ("round", "square", "cylinders over boxes"),
    )
    for ax, (case, over, title) in zip(axes, panels, strict=True):
        for k, scale in enumerate(SCALES):
            here = table[
                (table["case"] == case) & (table["over"] == over) & (table["scale"] == scale)
            ]
            ratio, low, high = (here[name].to_numpy() for name in ("ratio", "low", "high"))
            ax.errorbar(
                ratio, np.arange(len(names)) + 0.16 * (k - 0.5), xerr=[ratio - low, high - ratio],
                fmt="os"[k], ms=4, elinewidth=0.8, label=f"motions × {scale:g}",
            )  # fmt: skip
        ax.axvline(1.0, color="0.5", lw=0.8)
        ax.set_xscale("log")
        ax.set_xticks([0.5, 1, 2, 4, 8], ["0.5", "1", "2", "4", "8"])
        ax.minorticks_off()
        ax.set_xlabel("overturn so many times as often")
        ax.set_title(title)
    axes[0].set_yticks(range(len(names)), names)
    axes[0].invert_yaxis()
    figure.legend(
        *axes[0].get_legend_handles_labels(), fontsize="small", loc="outside lower center", ncols=2
    )
    return figure


def _measures(study: Study) -> Figure:
    table = study.tables["measures"]
    figure = Figure(figsize=(7, 4.2), layout="constrained")
    ax = figure.subplots()
    for k, ground in enumerate(OF_GROUND):
        here = table[table["of_the_ground"] == ground]
        area, low, high = (here[name].to_numpy() for name in ("area", "low", "high"))
        at = np.arange(len(here)) + 0.12 * (k - 0.5)
        ax.errorbar(at, area, [area - low, high - area], fmt="os"[k], label=ground, elinewidth=0.8)
    ax.set_xticks(range(len(OF_PAIR)), list(OF_PAIR))
    ax.set_ylabel("area under the ROC curve\n(1: knows all, 0.5: nothing)")
    figure.legend(loc="outside lower center", ncols=2)
    return figure


FIGURES = {
    "direction": (
        "Share of the falls that go downhill, against the tilt, for directions of the tilt from "
        "the short side of the base; mean of four sizes with base/height 0.25 to 0.26.",
        _direction,
    ),
    "shares": (
        "Share of the simulations that overturn on a level support: the same sizes as rectangles "
        "in a plane, and as boxes on square bases and cylinders under both components.",
        _shares,
    ),
    "losses": (
        "What friction, impacts and rolling change: how many times as often square boxes overturn "
        "under both components as rectangles under one, and cylinders as square boxes. One thing "
        "is changed at a time.",
        _losses,
    ),
    "measures": (
        "How well peaks of the ground tell which shakings overturn square boxes under both "
        "components.",
        _measures,
    ),
}
