"""Figures 2 and 5 to 8 of Cimellaro et al. (2020), with the floors at hand."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.special import ndtr

from shaketable.criteria import cimellaro_2020, kaneko_hayashi_2004
from shaketable.study import Study
from shaketable.units import STANDARD_GRAVITY
from shaketable_studies.captions import caption
from shaketable_studies.cimellaro_2020 import pulse
from shaketable_studies.cimellaro_2020.recovered import G

#: Figures for which the floors do not matter.
NEED_NO_FLOORS = ("figure_02", "calibration", "recovered", "edges", "slide")
LEVELS = np.linspace(0.0, 1.0, 11)
SHOWN = 1.8  # m, of figure 6
AMPLITUDES = (3.0, 3.06, 6.7, 6.8, 7.45, 7.55)  # on both sides of each border of figure 2


def figures(study: Study) -> Iterator[tuple[str, Figure]]:
    """Each figure with its name."""
    for name, (title, draw) in FIGURES.items():
        figure = draw(study)
        numbered = f"Figure {int(name[7:9])}. " if name.startswith("figure_") else ""
        source = f" {study.records}. The paper's records are not at hand."
        source = "" if name in NEED_NO_FLOORS else source
        caption(figure, f"{numbered}{title}{source}")
        yield name, figure


def _pulse(study: Study) -> Figure:
    figure = Figure(figsize=(9.0, 6.6), layout="constrained")
    axes = figure.subplots(2, 3, sharex=True, sharey=True).ravel()
    for ax, amplitude in zip(axes, AMPLITUDES, strict=True):
        ours = pulse.response(amplitude, 0.9)
        time, rotation, _ = pulse.follow(amplitude, 0.9)
        ax.plot(ours.time, ours.rotation / pulse.ALPHA, color="tab:blue", lw=2.5, label="ours")
        label = pulse.RADAU.name
        ax.plot(time, rotation / pulse.ALPHA, "--", color="black", lw=1, label=label)
        ax.set_title(f"$a_p$ = {amplitude:g} $αg$", fontsize="small")
        ax.set_xlim(0.0, 4.0)
        ax.set_ylim(-2.5, 2.5)
        ax.grid(color="0.92")
    axes[0].legend(fontsize="small")
    table = study.tables["figure_02"]
    found = table[table["restitution"] == "0.9"]
    said = ", ".join(f"{row.found:.4f} ({row.known:.4f})" for row in found.itertuples())
    figure.supxlabel(f"time [s]; borders of overturning, ours (known): {said}", fontsize="medium")
    figure.supylabel("rotation θ/α [-]", fontsize="medium")
    return figure


def _spectra(study: Study) -> Figure:
    figure = Figure(figsize=(6.4, 4.8), layout="constrained")
    ax = figure.subplots()
    table = study.tables["figure_05"]
    made = [name for name in table if str(name).startswith("compatible_")]
    for k, name in enumerate(made):
        label = f"{len(made)} compatible motions" if k == 0 else None
        ax.plot(table["period_s"], table[name] / STANDARD_GRAVITY, color="0.7", lw=0.6, label=label)
    mean = table[made].mean(axis=1) / STANDARD_GRAVITY
    ax.plot(table["period_s"], mean, color="tab:blue", label="their mean")
    floor = table["floor_m_s2"] / STANDARD_GRAVITY
    ax.plot(table["period_s"], floor, color="tab:red", label=table["channel"].iloc[0])
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlabel("period [s]")
    ax.set_ylabel("pseudo-acceleration [g], 5 % damping")
    ax.grid(color="0.92", which="both")
    ax.legend(fontsize="small")
    return figure


def _surfaces(study: Study) -> Figure:
    risks = study.tables["figure_06"]
    risks = risks[risks["height_m"] == SHOWN]
    buildings = list(dict.fromkeys(risks["building"]))
    figure = Figure(figsize=(9.6, 3.1 * len(buildings) + 0.8), layout="constrained")
    axes = figure.subplots(len(buildings), 3, sharex=True, sharey=True, squeeze=False)
    shown: Any = None
    for row, building in zip(axes, buildings, strict=True):
        here = risks[risks["building"] == building]
        for ax, (way, label) in zip(
            row,
            {
                "simplified": "Kaneko & Hayashi",
                "direct": "direct integration",
                "formula": "eq. 9 as printed",
            }.items(),
            strict=True,
        ):
            shown = _contours(ax, here, way)
            if building == buildings[0]:
                ax.set_title(label, fontsize="small")
        row[0].set_ylabel(f"{building}\n{here['channel'].iloc[0]}", fontsize="x-small")
    figure.supxlabel(f"B/H [-], H = {SHOWN:g} m", fontsize="medium")
    figure.supylabel("peak floor acceleration [g]", fontsize="medium")
    figure.colorbar(shown, ax=axes, label="risk of overturning [-]", shrink=0.6)
    return figure


def _contours(ax: Axes, rows: pd.DataFrame, way: str) -> object:
    grid = rows.pivot_table(index="pfa_g", columns="b_over_h", values=way)
    return ax.contourf(grid.columns, grid.index, grid.to_numpy(), levels=LEVELS, cmap="YlOrRd")


def _fitted(study: Study) -> Figure:
    """Direct integration against the fitted surface, and the residuals by height."""
    risks, table = study.tables["figure_06"], study.tables["figure_07"]
    refit = cimellaro_2020.Surface(*table["refit"])
    pfa = risks["pfa_g"].to_numpy() * STANDARD_GRAVITY
    figure = Figure(figsize=(9.6, 4.2), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    for ax, (label, surface) in zip(
        axes, {"as printed": cimellaro_2020.PRINTED, "fitted anew": refit}.items(), strict=True
    ):
        values = cimellaro_2020.overturning_ratio(risks["b_over_h"].to_numpy(), pfa, surface)
        for colour, (height, here) in zip(
            ("C0", "C1", "C2", "C3"), risks.groupby("height_m"), strict=True
        ):
            off = values[here.index] - here["direct"]
            bins = here.assign(off=off).groupby("pfa_g")["off"]
            mean, spread = bins.mean(), bins.std()
            ax.errorbar(
                mean.index, mean, spread, color=colour, marker="o", ms=4, lw=1, capsize=2,
                label=f"H = {height} m",
            )  # fmt: skip
        ax.axhline(0.0, color="0.5", lw=0.8)
        ax.set_title(f"eq. 9 {label}", fontsize="small")
        ax.set_xlabel("peak floor acceleration [g]")
        ax.grid(color="0.92")
    axes[0].set_ylabel("formula less direct integration [-]: mean, deviation")
    axes[1].legend(fontsize="small", title=f"R² {table['r_squared'].iloc[0]:.2f}")
    return figure


def _printed_and_refit(study: Study) -> Figure:
    table = study.tables["figure_07"]
    ratio = np.linspace(0.1, 0.45, 80)
    pfa_g = np.linspace(0.1, 1.0, 80)
    x, y = np.meshgrid(ratio, pfa_g)
    figure = Figure(figsize=(8.4, 3.9), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    shown: Any = None
    for ax, label in zip(axes, ("printed", "refit"), strict=True):
        surface = cimellaro_2020.Surface(*table[label])
        risk = cimellaro_2020.overturning_ratio(x, y * STANDARD_GRAVITY, surface)
        shown = ax.contourf(ratio, pfa_g, risk, levels=LEVELS, cmap="YlOrRd")
        ax.set_title(f"eq. 9, {'as printed' if label == 'printed' else 'fitted anew'}")
        ax.set_xlabel("B/H [-]")
    axes[0].set_ylabel("peak floor acceleration [g]")
    figure.colorbar(shown, ax=axes, label="risk of overturning [-]")
    return figure


def _two_surfaces(study: Study) -> Figure:
    """The paper's own figure 7: the formula's surface beside that of direct integration."""
    risks = study.tables["figure_06"]
    risks = risks[risks["height_m"] == SHOWN]
    grids = {
        "eq. 9 as printed": risks.pivot_table("formula", "pfa_g", "b_over_h"),
        "direct integration, mean over the buildings": risks.pivot_table(
            "direct", "pfa_g", "b_over_h"
        ),
    }
    figure = Figure(figsize=(10.2, 4.6), layout="constrained")
    for k, (title, grid) in enumerate(grids.items(), 1):
        ax: Any = figure.add_subplot(1, 2, k, projection="3d")
        x, y = np.meshgrid(grid.columns.to_numpy(float), grid.index.to_numpy(float))
        ax.plot_surface(x, y, grid.to_numpy(), cmap="YlOrRd", vmin=0, vmax=1, lw=0.2, ec="0.4")
        ax.set_title(title, fontsize="small")
        ax.set_xlabel("B/H [-]")
        ax.set_ylabel("peak floor acceleration [g]")
        ax.set_zlabel("risk [-]")
        ax.set_zlim(0, 1)
        ax.view_init(22, -125)
        ax.set_box_aspect(None, zoom=0.85)  # room for the labels
    return figure


def _recovered(study: Study) -> Figure:
    """Printed simplified risks over the recovered accelerations, with the recovered curve."""
    table = study.tables["table_2_recovered"]
    figure = Figure(figsize=(6.8, 4.6), layout="constrained")
    ax = figure.subplots()
    pfa = np.linspace(0.1, 0.8, 200) * G
    ratio = kaneko_hayashi_2004.RECOVERED_RATIO
    median = ratio * G * (1.0 + ratio)
    curve = ndtr(np.log(pfa / median) / kaneko_hayashi_2004.RECOVERED_ZETA_A)
    ax.plot(pfa / G, 100 * curve, color="0.5", label="the acceleration's branch, recovered")
    for branch, colour, marker in (("PFA", "tab:blue", "o"), ("PFV", "tab:red", "s")):
        here = table[table["branch"] == branch]
        spread = (here["pfa_g"] - here["pfa_low_g"], here["pfa_high_g"] - here["pfa_g"])
        label = "by its acceleration" if branch == "PFA" else "below it: by its velocity"
        ax.errorbar(here["pfa_g"], here["simplified"], xerr=np.abs(spread), color=colour,
                    fmt=marker, ms=4, lw=1, label=label)  # fmt: skip
    ax.set_xlabel("peak floor acceleration by eq. 9 inverted [g]")
    ax.set_ylabel("printed simplified risk [%]")
    ax.legend(fontsize="small")
    ax.grid(color="0.92")
    return figure


def _slide(study: Study) -> Figure:
    table = study.tables["slide_coefficient"]
    figure = Figure(figsize=(6.4, 4.2), layout="constrained")
    ax = figure.subplots()
    for ratio, here in table.groupby("b_over_h"):
        ax.plot(here["friction_over_b_over_h"], here["coefficient"], "o-", ms=4, lw=1,
                label=f"B/H = {ratio:g}")  # fmt: skip
    ax.set_xlabel("friction over B/H [-]")
    ax.set_ylabel("slide coefficient [-]: falls over falls without sliding")
    ax.legend(fontsize="small")
    ax.grid(color="0.92")
    return figure


def _edges(study: Study) -> Figure:
    table = study.tables["edges_of_floors"]
    figure = Figure(figsize=(6.8, 4.2), layout="constrained")
    ax = figure.subplots()
    bins = np.linspace(0.0, 100.0, 21).tolist()
    for mixes, label, colour in (
        (False, "both channels on one branch", "tab:blue"),
        (True, "one on each branch", "tab:red"),
    ):
        spread = 100 * table.loc[table["mixes"] == mixes, "simplified_spread"]
        label = f"{label} ({len(spread)})"
        ax.hist(spread, bins, density=True, histtype="step", lw=1.5, color=colour, label=label)
    ax.set_xlabel("difference of Kaneko & Hayashi's ratio between two edges of a floor [%]")
    ax.set_ylabel("share of cases per per cent")
    ax.legend(fontsize="small")
    return figure


def _calibration(study: Study) -> Figure:
    table = study.tables["calibration"]
    scores = study.tables["models"].set_index(["bodies", "model"])["brier"]
    colours = {model: f"C{k}" for k, model in enumerate(dict.fromkeys(table["model"]))}
    figure = Figure(figsize=(10.4, 4.8), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    for ax, (bodies, here) in zip(axes, table.groupby("bodies", sort=False), strict=True):
        ax.plot([0, 100], [0, 100], color="0.7", lw=1)
        for model, rows in here.groupby("model", sort=False):
            label = f"{model}: {scores[bodies, model]:.3f}"
            colour = colours[model]
            x, y = 100 * rows["mean_chance"], 100 * rows["fell"]
            ax.plot(x, y, "o-", ms=4, lw=1, color=colour, label=label)
        ax.set_title(str(bodies), fontsize="small")
        ax.set_xlabel("chance of overturning [%]")
        ax.grid(color="0.92")
        ax.legend(fontsize="x-small", title="Brier score", title_fontsize="x-small")
    axes[0].set_ylabel("fell [%]")
    return figure


#: Title and drawing of each figure.
FIGURES: dict[str, tuple[str, Callable[[Study], Figure]]] = {
    "figure_02": (
        "A block (p = 2.14 rad/s, α = 0.25, η = 0.9) under one sine with ω_p/p = 5.", _pulse
    ),
    "figure_05": ("A floor's spectrum and those of motions compatible with it.", _spectra),
    "figure_06": ("Risk over shape and acceleration; the worst channel of each.", _surfaces),
    "figure_07": ("Eq. 9 against direct integration.", _fitted),
    "figure_07_surfaces": (
        "As the paper draws it: its surface, and that of direct integration.", _two_surfaces
    ),
    "recovered": ("What the paper's table 2 tells of its floors and its constants.", _recovered),
    "edges": ("Channels at both edges of floors that twist.", _edges),
    "slide": ("The slide coefficient from the general model.", _slide),
    "figure_08": ("The surface of eq. 9.", _printed_and_refit),
    "calibration": (
        "What falls under the recorded motions at four scales, and the chances by every "
        "model; those fitted here on recordings that they were not fitted to.", _calibration,
    ),
}  # fmt: skip
