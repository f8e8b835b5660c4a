"""Figures 2 to 10 and 13 of Boroschek and Iruretagoyena (2006), with the motions at hand."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
import pandas as pd
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from shaketable.study import Study
from shaketable_studies.captions import caption

MODELS = {  # label, marker, colour
    "rocking": ("rocking equation", "o", "tab:blue"),
    "general": ("general equation", "x", "tab:orange"),
}
BARS = "Bars: 95 % interval over events and their recordings."
SAME_SHAPE = (1, 4, 8, 11)  # of table I, b/h = 0.2


def figures(study: Study) -> Iterator[tuple[str, Figure]]:
    """Each figure with its name; matplotlib keeps none of them."""
    for name, (title, draw) in FIGURES.items():
        figure = draw(study)
        if name.startswith("figure_"):
            number = int(name.rpartition("_")[2])
            caption(figure, f"Figure {number}. {title} {_source(study, number)}")
        else:
            caption(figure, f"{title} {study.records}.")
        yield name, figure


def _source(study: Study, number: int) -> str:
    """Which motions made a figure."""
    if number == 2:
        return "Simulated under an acceleration that grows slowly."
    if number != 13:
        return (
            f"Points: {study.records}, in both directions; of them those above eq. 1 for the "
            "level support (table 1)." + ("" if number == 10 else f" {BARS}")
        )
    chosen = study.tables["table_6"]
    printed = int((chosen["printed_record"] != "").sum())
    return (
        f"Points: {len(chosen)} of {study.records}: {printed} of table VI, scaled as printed, and "
        f"those that overturn the most bodies, scaled to the limits of the table (table 6). {BARS}"
    )


def _figure_02(study: Study) -> Figure:
    figure, ax = _one()
    table = study.tables["figure_02"]
    for colour, (ratio, rows) in zip(("C0", "C1", "C2"), table.groupby("b_over_h"), strict=True):
        for side, line in (("uphill", "-"), ("downhill", "--")):
            label = f"b/h = {ratio:.2f}, {side}"
            ax.plot(rows["tilt_deg"], rows[f"{side}_g"], line, color=colour, label=label)
            ax.plot(rows["tilt_deg"], rows[f"simulated_{side}_g"], ".", color=colour)
    ax.set_ylabel("acceleration [g]")
    ax.set_xlabel("tilt of the support [°]")
    ax.legend(fontsize="small", ncols=3, loc="upper left")
    ax.set_ylim(0.0, 0.6)
    return figure


def _one_body(number: int) -> Callable[[Study], Figure]:
    def draw(study: Study) -> Figure:
        figure, ax = _one()
        _points(ax, _of(study.tables["rates"], number))
        _curve(ax, study, 0, "black", "-", "GCOR as printed")
        _curve(ax, study, number, "black", "--", "SCOR as printed")
        return _finished(figure, [ax])

    return draw


def _figure_06(study: Study) -> Figure:
    figure, ax = _one()
    rates = study.tables["rates"]
    for _, rows in rates[rates["model"] == rates["model"].iloc[0]].groupby("body"):
        ax.plot(rows["tilt_deg"], 100 * rows["rate"], color="0.8", lw=0.8)
    ax.plot([], [], color="0.8", lw=0.8, label="each of the 12 bodies")
    _points(ax, study.tables["mean_rates"])
    _curve(ax, study, 0, "black", "-", "GCOR as printed")
    return _finished(figure, [ax])


def _figure_07(study: Study) -> Figure:
    figure, ax = _one()
    mean = study.tables["mean_rates"]
    first = mean[mean["model"] == mean["model"].iloc[0]]
    _points(ax, first)
    _curve(ax, study, 0, "black", "-", "GCOR as printed")
    _curve(ax, study, 0, "tab:red", "-", "GCOR fitted to these points, 95 % band", refit=True)
    errors = study.tables["fit_errors"].set_index("curve")["printed_error_pct"]
    error = errors["GCOR, mean of the bodies"]
    ax.text(6.9, 62, f"error of GCOR as printed (eq. 12): {error:.1f} %", ha="right")
    return _finished(figure, [ax])


def _six_bodies(first: int) -> Callable[[Study], Figure]:
    def draw(study: Study) -> Figure:
        figure = Figure(figsize=(9.0, 9.6), layout="constrained")
        axes = figure.subplots(3, 2, sharex=True, sharey=True).ravel()
        errors = study.tables["table_3"].set_index("body")
        for number, ax in enumerate(axes, first):
            _points(ax, _of(study.tables["rates"], number))
            _curve(ax, study, 0, "black", "-", "GCOR as printed")
            _curve(ax, study, number, "black", "--", "SCOR as printed")
            _curve(ax, study, number, "tab:red", "--", "SCOR fitted anew", refit=True)
            row = errors.loc[number]
            ax.set_title(
                f"body {number}: {row['base_m']:g} m × {row['height_m']:g} m; error GCOR "
                f"{row['gcor_error_pct']:.1f} %, SCOR {row['scor_error_pct']:.1f} %",
                fontsize="small",
            )
        return _finished(figure, list(axes), legend=axes[0])

    return draw


def _figure_10(study: Study) -> Figure:
    figure, ax = _one()
    rates = study.tables["rates"]
    first = rates[rates["model"] == rates["model"].iloc[0]]
    sizes = study.tables["table_1"].set_index("body")["height_m"]
    for colour, number in zip(("C0", "C1", "C2", "C3"), SAME_SHAPE, strict=True):
        rows = _of(first, number)
        label = f"body {number}, {sizes[number]:g} m high"
        ax.plot(rows["tilt_deg"], 100 * rows["rate"], "o", ms=4, color=colour, label=label)
        _curve(ax, study, number, colour, "--", None)
    ax.plot([], [], "--", color="0.4", label="SCOR as printed")
    return _finished(figure, [ax])


def _figure_13(study: Study) -> Figure:
    figure, ax = _one()
    bodies = study.tables["table_5"]
    tests = study.tables["figure_13"]
    for k, row in enumerate(bodies.to_dict("records")):
        rates = [100 * row[f"rate_at_{tilt:g}_deg"] for tilt in tests["tilt_deg"]]
        label = f"{row['base_mm']:g} mm × {row['height_mm']:g} mm"
        beside = tests["tilt_deg"] + 0.03 * (k - 3)  # apart, so that each can be seen
        ax.plot(beside, rates, "s", ms=3, alpha=0.7, label=label)
    _points(ax, tests.assign(model="rocking"), label="mean of the seven bodies, simulated")
    _curve(ax, study, 0, "black", "-", "GCOR as printed")
    _finished(figure, [ax])
    ax.set_xlim(-0.3, 7.1)
    ax.set_ylim(0.0, 101.5)  # level, a body off centre falls more to one side
    return figure


def _one() -> tuple[Figure, Axes]:
    figure = Figure(figsize=(7.2, 5.2), layout="constrained")
    return figure, figure.subplots()


def _of(rates: pd.DataFrame, number: int) -> pd.DataFrame:
    return rates[rates["body"] == number]


def _points(ax: Axes, rates: pd.DataFrame, label: str | None = None) -> None:
    """Rates with their intervals, by model."""
    for model, rows in rates.groupby("model", sort=False):
        said, marker, colour = MODELS[str(model)]
        rate = 100 * rows["rate"]
        ends = [rate - 100 * rows["rate_low"], 100 * rows["rate_high"] - rate]
        ax.errorbar(
            rows["tilt_deg"],
            rate,
            np.clip(ends, 0.0, None),
            fmt=marker,
            ms=4.5,
            color=colour,
            ecolor=colour,
            elinewidth=0.8,
            capsize=2,
            label=label or said,
        )


def _curve(
    ax: Axes,
    study: Study,
    number: int,
    colour: str,
    line: str,
    label: str | None,
    *,
    refit: bool = False,
) -> None:
    """GCOR (body 0) or a body's SCOR; the fitted one with its band."""
    curves = study.tables["curves"]
    rows = curves[curves["body"] == number]
    if refit:
        low, high = 100 * rows["refit_low"], 100 * rows["refit_high"]
        ax.fill_between(rows["tilt_deg"], low, high, color=colour, alpha=0.15, lw=0)
    values = 100 * rows["refit" if refit else "printed"]
    ax.plot(rows["tilt_deg"], values, line, color=colour, lw=1.2, label=label)


def _open_questions(study: Study) -> Figure:
    table = study.tables["open_questions"]
    figure = Figure(figsize=(10.2, 7.4), layout="constrained")
    axes = figure.subplots(2, 2, sharex=True, sharey=True).ravel()
    for ax, (question, rows) in zip(axes, table.groupby("question", sort=False), strict=True):
        values = list(dict.fromkeys(rows["value"]))
        for k, value in enumerate(values):
            here = rows[rows["value"] == value]
            colour = colormaps["viridis"](k / max(1, len(values) - 1))
            label = "ground" if (question, value) == ("floor", 0) else f"{value:g}"
            ax.plot(here["tilt_deg"], 100 * here["downhill"], ".-", color=colour, label=label)
            low, high = 100 * here["low"], 100 * here["high"]
            ax.fill_between(here["tilt_deg"], low, high, color=colour, alpha=0.08, lw=0)
        ax.axhline(95.0, color="0.6", lw=0.8)
        ax.grid(color="0.92")
        ax.legend(title=str(question), fontsize="x-small", title_fontsize="small", ncols=2)
    figure.supxlabel("tilt of the support [°]", fontsize="medium")
    figure.supylabel("overturnings that go downhill [%]", fontsize="medium")
    return figure


def _dimensionless(study: Study) -> Figure:
    table = study.tables["dimensionless"]
    figure = Figure(figsize=(7.2, 4.8), layout="constrained")
    ax = figure.subplots()
    curves = list(dict.fromkeys(table["curve"]))
    groups = list(dict.fromkeys(table["bodies"]))
    for k, name in enumerate(curves):
        brier = table[table["curve"] == name].set_index("bodies")["brier"]
        places = np.arange(len(groups)) + (k - (len(curves) - 1) / 2) / (len(curves) + 1)
        ax.bar(places, [brier[group] for group in groups], 0.9 / (len(curves) + 1), label=name)
    ax.set_xticks(range(len(groups)), [f"bodies of {g}" if g == "table I" else g for g in groups])
    ax.set_ylabel("Brier score of which way a body falls")
    # the bars fill the axes
    ax.legend(fontsize="small", loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=3)
    return figure


def _finished(figure: Figure, axes: list[Axes], legend: Axes | None = None) -> Figure:
    for ax in axes:
        ax.set_xlim(-0.1, 7.1)
        ax.set_ylim(45, 101.5)
        ax.grid(color="0.92")
    figure.supxlabel("tilt of the support [°]", fontsize="medium")
    figure.supylabel("overturnings that go downhill [%]", fontsize="medium")
    (legend or axes[0]).legend(fontsize="small", loc="lower right")
    return figure


#: Title and drawing of each figure.
FIGURES: dict[str, tuple[str, Callable[[Study], Figure]]] = {
    "figure_02": ("Acceleration at which a body begins to rock; lines: eq. 1.", _figure_02),
    "figure_03": ("Body 1 (0.04 m × 0.2 m).", _one_body(1)),
    "figure_04": ("Body 4 (0.10 m × 0.5 m).", _one_body(4)),
    "figure_05": ("Body 12 (0.38 m × 1.5 m).", _one_body(12)),
    "figure_06": ("Mean of the 12 bodies.", _figure_06),
    "figure_07": ("GCOR and the mean of the 12 bodies.", _figure_07),
    "figure_08": ("GCOR and SCOR, bodies 1 to 6.", _six_bodies(1)),
    "figure_09": ("GCOR and SCOR, bodies 7 to 12.", _six_bodies(7)),
    "figure_10": ("Bodies of one shape, h/b = 5.", _figure_10),
    "figure_13": ("The seven bodies of the shaking-table tests.", _figure_13),
    "open_questions": (
        "What the paper leaves open: four bodies of table I, one thing changed at a time.",
        _open_questions,
    ),
    "dimensionless": (
        "Which way falls go: the paper's curves, printed and fitted anew, and a dimensionless one.",
        _dimensionless,
    ),
}
