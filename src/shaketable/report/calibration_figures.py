"""Figures of a calibration: what it rests on, how good it is, and what it finds."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable, Iterator, Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter
from numpy.typing import NDArray

from shaketable.calibration import PARAMETERS, Calibration, reliability, scores
from shaketable.calibration.likelihood import Setting
from shaketable.calibration.rivals import AFTERWARDS, peak_measures
from shaketable.units import STANDARD_GRAVITY

SIZE = (6.4, 4.4)  # inches
BENEATH = (
    "The colours beneath are the mean of the probabilities that the ensemble gives to tests near "
    "by, each predicted without its own recording."
)
AT_ONCE = 20  # tests in a bar of the residuals


def figures(
    calibration: Calibration, rivals: Mapping[str, NDArray[np.float64]]
) -> Iterator[tuple[str, str, Figure]]:
    """The name, the caption and the figure of each.

    Args:
        calibration: with its cross-validation.
        rivals: probabilities by other ways, as `rival_predictions` gives them.
    """
    fitted = calibration.fitted
    figure, ax = _new()
    _outcomes(calibration, ax)
    yield (
        "outcomes",
        "Every test, by the peak acceleration of the table and by peak velocity over peak "
        "acceleration, which tells how slow the motion is."
        + (f" {BENEATH}" if fitted is not None else ""),
        figure,
    )
    if fitted is not None:
        figure, ax = _new()
        _reliability(calibration, ax)
        yield (
            "reliability",
            "Of the tests that were given about the same probability, the share that fell, with "
            "Wilson's 95 % interval and the number of tests. On the line the probabilities are "
            "right.",
            figure,
        )
        figure, ax = _new()
        _settings(fitted.brier, fitted.setting, ax)
        yield (
            "settings",
            "The Brier score in cross-validation over the error rate that is granted to each test, "
            "for each noise on the motions, with the memory that was chosen. The cross marks the "
            "choice; its score is lower than that of the predictions, because it was chosen on "
            "all of these tests.",
            figure,
        )
        figure, ax = _new()
        _residuals(calibration, ax)
        yield (
            "residuals",
            "What was seen minus what was predicted, in the order of the tests, or of "
            "the table where that is not known. Points far from zero on one side hint at a body "
            "that was placed otherwise, or that changed.",
            figure,
        )
        figure, ax = _new()
        _one_run(calibration, rivals, ax)
        yield (
            "ways",
            "The Brier score and the share of tests that are predicted right, by this ensemble and "
            "by other ways, each without the recording that it predicts, but for the grey one, "
            "which has seen the tests.",
            figure,
        )
    figure, ax = _new()
    _posterior(calibration, ax)
    yield (
        "posterior",
        "The bodies of the ensemble: the larger a dot, the better the body explains the tests. "
        "Lines are the middle and both ends of each parameter's range by the tests.",
        figure,
    )


def _new() -> tuple[Figure, Axes]:
    figure = Figure(figsize=SIZE, layout="constrained")
    return figure, figure.subplots()


def _in_logarithms(axis: Axis, scale: Callable[[str], None]) -> None:
    """A logarithmic axis with plain numbers that do not collide."""
    scale("log")
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())


def _outcomes(calibration: Calibration, ax: Axes) -> None:
    measures = peak_measures(calibration.tests)
    pga, ratio = measures[:, 0] / STANDARD_GRAVITY, measures[:, 1]
    fell = calibration.fell
    if calibration.fitted is not None:
        x, y = np.log(pga), np.log(ratio)
        across = np.linspace(x.min() - 0.1, x.max() + 0.1, 80)
        up = np.linspace(y.min() - 0.1, y.max() + 0.1, 80)
        near = np.exp(
            -0.5 * ((across[None, :, None] - x) / (0.35 * x.std() + 1e-9)) ** 2
            - 0.5 * ((up[:, None, None] - y) / (0.35 * y.std() + 1e-9)) ** 2
        )
        mass = near.sum(axis=2)
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = np.where(mass > 0.5, near @ calibration.fitted.predicted / mass, np.nan)
        drawn = ax.pcolormesh(
            np.exp(across), np.exp(up), mean, cmap="RdYlBu_r", vmin=0, vmax=1, alpha=0.6
        )
        ax.figure.colorbar(drawn, ax=ax, label="probability of a fall")
    ax.scatter(pga[~fell], ratio[~fell], s=14, fc="none", ec="k", lw=0.8, label="stands")
    ax.scatter(pga[fell], ratio[fell], s=18, marker="x", color="k", lw=1.0, label="falls")
    _in_logarithms(ax.xaxis, ax.set_xscale)
    _in_logarithms(ax.yaxis, ax.set_yscale)
    ax.set_xlabel("PGA [g]")
    ax.set_ylabel("PGV/PGA [s]")
    ax.legend(loc="upper right", fontsize="small")


def _reliability(calibration: Calibration, ax: Axes) -> None:
    assert calibration.fitted is not None
    bins = reliability(calibration.fitted.predicted, calibration.fell)
    ax.plot([0, 1], [0, 1], color="0.6", lw=1)
    ax.errorbar(
        bins.predicted,
        bins.seen,
        yerr=(np.maximum(bins.seen - bins.low, 0), np.maximum(bins.high - bins.seen, 0)),
        fmt="o",
        capsize=3,
        color="tab:blue",
    )
    for x, y, n in zip(bins.predicted, bins.seen, bins.tests, strict=True):
        ax.annotate(f"{n}", (x, y), xytext=(7, -10), textcoords="offset points", fontsize="small")
    ax.set_xlabel("predicted probability of a fall")
    ax.set_ylabel("share that fell")


def _settings(brier: Mapping[Setting, float], chosen: Setting, ax: Axes) -> None:
    for noise in sorted({setting.noise for setting in brier}):
        here = sorted(s for s in brier if s.noise == noise and s.memory == chosen.memory)
        ax.plot(
            [s.error for s in here],
            [brier[s] for s in here],
            marker=".",
            label=f"noise of {100 * noise:g} %" if noise else "motions as recorded",
        )
    ax.plot(chosen.error, brier[chosen], marker="x", ms=10, mew=2, color="k")
    ax.set_xlabel("error rate")
    ax.set_ylabel("Brier score")
    ax.set_ylim(bottom=0)
    ax.legend(fontsize="small")


def _residuals(calibration: Calibration, ax: Axes) -> None:
    assert calibration.fitted is not None
    residual = calibration.fell - calibration.fitted.predicted
    order = np.array([k if t.order is None else t.order for k, t in enumerate(calibration.tests)])
    pieces = np.array_split(np.argsort(order, kind="stable"), max(1, residual.size // AT_ONCE))
    for k, piece in enumerate(pieces, 1):
        spread = residual[piece].std(ddof=1) / math.sqrt(piece.size) if piece.size > 1 else 0.0
        mean = residual[piece].mean()
        ax.errorbar(k, mean, yerr=2 * spread, fmt="o", color="tab:red", capsize=3)
    ax.axhline(0, color="0.6", lw=1)
    ax.xaxis.set_major_locator(MaxNLocator(integer=True))
    ax.set_xlabel(f"tests in their order, some {AT_ONCE} at a time")
    ax.set_ylabel("fell minus predicted, mean ± 2 standard errors")


def _one_run(calibration: Calibration, rivals: Mapping[str, NDArray[np.float64]], ax: Axes) -> None:
    assert calibration.fitted is not None
    ways = {"this ensemble": calibration.fitted.predicted, **rivals}
    found = {name: scores(p, calibration.fell) for name, p in ways.items()}
    places = np.arange(len(found))[::-1]
    colours = ["0.7" if name == AFTERWARDS else "tab:blue" for name in found]
    ax.barh(places, [s.brier for s in found.values()], color=colours, alpha=0.5)
    for place, s in zip(places, found.values(), strict=True):
        ax.text(
            s.brier + 0.004,
            place,
            f"{100 * s.share_right:.1f} % right",
            va="center",
            fontsize="small",
        )
    ax.set_yticks(places, [textwrap.fill(name, 24) for name in found], fontsize="small")
    ax.set_xlabel("Brier score (0 is perfect)")
    ax.set_xlim(0, 1.4 * max(s.brier for s in found.values()))


def _posterior(calibration: Calibration, ax: Axes) -> None:
    ensemble, weights = calibration.ensemble, calibration.weights
    x, y = ensemble.of("slenderness"), ensemble.of("restitution_factor")
    ax.scatter(x, y, s=2, color="0.85")
    order = np.argsort(weights)
    drawn = ax.scatter(
        x[order],
        y[order],
        s=2000 * weights[order],
        c=ensemble.of("half_diagonal")[order],
        cmap="viridis",
        alpha=0.6,
        lw=0,
    )
    ax.figure.colorbar(drawn, ax=ax, label="half diagonal [m]")
    for name, line in (("slenderness", ax.axvline), ("restitution_factor", ax.axhline)):
        for quantile, style in zip(calibration.quantiles(name), (":", "-", ":"), strict=True):
            line(quantile, color="k", lw=0.8, ls=style)
    _in_logarithms(ax.xaxis, ax.set_xscale)
    ax.set_xlabel(f"slenderness [{PARAMETERS['slenderness'].unit}]")
    ax.set_ylabel("restitution factor")
