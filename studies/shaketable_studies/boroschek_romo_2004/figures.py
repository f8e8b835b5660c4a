"""Figures 4 to 8 of Boroschek and Romo (2004), and how the criteria compare."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from shaketable.criteria import boroschek_romo_2004, ishiyama_1982
from shaketable.study import Study
from shaketable.units import CM
from shaketable_studies.captions import caption

LINES = {  # of the panels: factor on Housner's velocity, arm over base, style
    "Ishiyama (eq. 2), symmetric": (ishiyama_1982.FACTOR, 0.5, "--"),
    "known eccentricity, B' = 2νB": (ishiyama_1982.FACTOR, None, "-"),
    "unknown eccentricity, 0.2": (boroschek_romo_2004.UNKNOWN_FACTOR, 0.5, "-."),
}
COLOURS = ("tab:blue", "tab:orange", "tab:green", "tab:red")


def figures(study: Study) -> Iterator[tuple[str, Figure]]:
    """Each figure with its name."""
    for name, (title, draw) in FIGURES.items():
        figure = draw(study)
        numbered = f"Figure {int(name[-2:])}. " if name.startswith("figure_") else ""
        way = "as recorded" if name == "friction" else "in both directions"
        caption(figure, f"{numbered}{title} {study.records}, {way}.")
        yield name, figure


def _panels(eccentricity: float) -> Callable[[Study], Figure]:
    """Overturned and standing bodies over velocity and base, one panel per height."""

    def draw(study: Study) -> Figure:
        points = study.tables["points"]
        points = points[points["eccentricity"] == eccentricity]
        pgv = study.tables["motions"]["pgv_m_s"].to_numpy() / CM
        figure = Figure(figsize=(9.6, 8.4), layout="constrained")
        axes = figure.subplots(2, 2, sharey=True).ravel()
        for ax, (_, rows) in zip(axes, points.groupby("cg_height_m"), strict=True):
            _panel(ax, float(rows["cg_height_m"].iloc[0]), rows, pgv[rows["motion"]], eccentricity)
        handles, labels = axes[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=3, fontsize="small")
        figure.supylabel("peak ground velocity [cm/s]", fontsize="medium")
        for ax in axes[2:]:
            ax.set_xlabel("base [m]")
        return figure

    return draw


def _panel(
    ax: Axes, height: float, rows: pd.DataFrame, pgv: np.ndarray, eccentricity: float
) -> None:
    fell = rows["falls"].to_numpy() > 0
    ax.plot(rows["base_m"][~fell], pgv[~fell], ".", color="black", ms=2.5, label="stands")
    ax.plot(
        rows["base_m"][fell], pgv[fell], "o", color="tab:red", ms=4, mfc="none", mew=0.7,
        label="overturns",
    )  # fmt: skip
    base = np.linspace(rows["base_m"].min(), rows["base_m"].max(), 100)
    inertia = np.sqrt((base**2 + (2 * height) ** 2) / 12)
    for label, (factor, arm, style) in LINES.items():
        if arm is None and eccentricity == 0.5:
            continue  # the same as the symmetric one
        at = (arm or eccentricity) * base
        limit = ishiyama_1982.overturning_velocity(at, height, inertia, factor)
        ax.plot(base, limit / CM, style, color="tab:blue", lw=1.6, label=label)
    ax.set_yscale("log")
    ax.set_title(f"centre of gravity at {height:g} m", fontsize="small")


def _shares(name: str, value: str, label: str) -> Callable[[Study], Figure]:
    """A value with its interval against the eccentricity, by height."""

    def draw(study: Study) -> Figure:
        figure = Figure(figsize=(6.4, 4.6), layout="constrained")
        ax = figure.subplots()
        table = study.tables[name]
        factor = 100 if value == "overturned" else 1
        for k, (height, rows) in enumerate(table[table["cg_height_m"] > 0].groupby("cg_height_m")):
            found = factor * rows[value]
            ends = [found - factor * rows[f"{value}_low"], factor * rows[f"{value}_high"] - found]
            ax.errorbar(
                rows["eccentricity"] + 0.004 * (k - 1.5),  # apart, so that each can be seen
                found,
                np.clip(ends, 0.0, None),
                fmt="o-",
                ms=4,
                capsize=2,
                lw=1,
                color=COLOURS[k],
                label=f"centre of gravity at {height:g} m",
            )
        ax.set_xlabel("eccentricity ν [-]")
        ax.set_ylabel(label)
        ax.set_ylim(0)
        ax.invert_xaxis()
        ax.grid(color="0.92")
        ax.legend(fontsize="small")
        return figure

    return draw


def _roc(study: Study) -> Figure:
    figure = Figure(figsize=(6.4, 5.0), layout="constrained")
    ax = figure.subplots()
    areas = study.tables["roc_areas"].set_index("criterion")["area_under_roc"]
    for colour, (name, rows) in zip(
        COLOURS, study.tables["roc"].groupby("criterion", sort=False), strict=True
    ):
        label = f"{name}: area {areas[name]:.3f}"
        ax.plot(100 * rows["false_alarm"], 100 * rows["detected"], color=colour, label=label)
    table = study.tables["criteria"]
    every = table[(table["eccentricity"] == 0.0) & (table["cg_height_m"] == 0.0)]
    for colour, (_, row) in zip(COLOURS, every.iterrows(), strict=True):
        ax.plot(100 * row["false_alarm"], 100 * (1 - row["false_safe"]), "o", color=colour)
    ax.set_xlabel("false alarms [% of what stands]")
    ax.set_ylabel("detected [% of what falls]")
    ax.grid(color="0.92")
    ax.legend(fontsize="small", loc="lower right", title="dots: as used")
    return figure


def _calibration(study: Study) -> Figure:
    figure = Figure(figsize=(5.4, 4.8), layout="constrained")
    ax = figure.subplots()
    rows = study.tables["calibration"]
    ax.plot([0, 100], [0, 100], color="0.7", lw=1)
    ax.plot(100 * rows["mean_chance"], 100 * rows["fell"], "o-", color="tab:red", ms=4, lw=1)
    ax.set_xlabel("chance by the fitted rule [%]")
    ax.set_ylabel("fell [%]")
    ax.grid(color="0.92")
    return figure


def _friction(study: Study) -> Figure:
    table = study.tables["friction_demand"]
    figure = Figure(figsize=(7.2, 4.8), layout="constrained")
    ax = figure.subplots()
    for k, (nu, rows) in enumerate(table.groupby("eccentricity")):
        shift = 0.006 * (k - 0.5)
        shown = rows[np.isfinite(rows["demand"])]
        label = "symmetric" if nu == 0.5 else f"ν = {nu:g}"
        ax.plot(shown["b_over_h"] + shift, shown["demand"], ".", ms=3, color=COLOURS[k],
                alpha=0.5, label=label)  # fmt: skip
        at_rest = rows.groupby("b_over_h")["at_rest"].first()
        ax.plot(at_rest.index, at_rest, "-", color=COLOURS[k], lw=1.5,
                label=f"b/h of the farther corner, {label}")  # fmt: skip
    ax.set_ylim(0, 0.8)
    ax.set_xlabel("base over height B/H [-]")
    ax.set_ylabel("friction needed while rocking, max |R_x|/R_y [-]")
    ax.grid(color="0.92")
    ax.legend(fontsize="small", ncols=2)
    return figure


_POINTS = "Bodies that overturn in one direction or both, and that stand in both;"
#: Title and drawing of each figure.
FIGURES: dict[str, tuple[str, Callable[[Study], Figure]]] = {
    "figure_04": (f"{_POINTS} symmetric.", _panels(0.5)),
    "figure_05": (f"{_POINTS} ν = 0.3.", _panels(0.3)),
    "figure_06": (f"{_POINTS} ν = 0.2.", _panels(0.2)),
    "figure_07": (
        "Share overturned; bars: 95 % interval over events and recordings.",
        _shares("figure_07", "overturned", "simulations that overturn the body [%]"),
    ),
    "figure_08": (
        "Overturned over overturned symmetric bodies; bars: 95 % interval over events and "
        "recordings.",
        _shares("figure_08", "ratio", "overturned, ratio to symmetric [-]"),
    ),
    "friction": (
        "The third condition: every body under every fourth motion that rocks it.",
        _friction,
    ),
    "roc": (
        "What the criteria detect, and their false alarms; the fitted rule on recordings that it "
        "was not fitted to.",
        _roc,
    ),
    "calibration": ("The fitted rule on recordings that it was not fitted to.", _calibration),
}
