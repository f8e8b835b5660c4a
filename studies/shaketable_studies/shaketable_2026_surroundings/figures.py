"""Figures of the study."""

from __future__ import annotations

from collections.abc import Iterator

from matplotlib.figure import Figure

from shaketable.study import Study
from shaketable_studies.captions import caption
from shaketable_studies.shaketable_2026_surroundings.cases import (
    CATCHING,
    HELD_AT,
    RESTITUTIONS,
    STIFFNESSES,
    of_scale,
)
from shaketable_studies.shaketable_2026_surroundings.claims import CODE
from shaketable_studies.shaketable_2026_surroundings.lips import FRICTIONS, THINGS
from shaketable_studies.shaketable_2026_surroundings.setting import SCALES

BARS = "Bars: 95 % interval over events and their recordings."


def figures(study: Study) -> Iterator[tuple[str, Figure]]:
    """Each figure with its name; matplotlib keeps none of them."""
    for name, (title, draw) in FIGURES.items():
        figure = draw(study)
        caption(figure, f"{title} {study.records}.")
        yield name, figure


def _walls(study: Study) -> Figure:
    figure = Figure(figsize=(9, 4.4), layout="constrained")
    axes = figure.subplots(1, len(SCALES), sharey=True)
    for ax, scale in zip(axes, SCALES, strict=True):
        here = of_scale(study.tables["walls"], scale)
        free = here[here["gap_mm"].isna()].iloc[0]
        ax.axhspan(100 * free["low"], 100 * free["high"], color="0.93")
        ax.axhline(100 * free["fall_share"], color="0.4", ls="--", label="no wall")
        for k, restitution in enumerate(RESTITUTIONS):
            mine = here[here["restitution"] == restitution]
            share, low, high = (
                100 * mine[name].to_numpy() for name in ("fall_share", "low", "high")
            )
            ax.errorbar(
                mine["gap_mm"] + 1.5 * (k - 1), share, [share - low, high - share], marker="os^"[k],
                ms=4, lw=1, elinewidth=0.7, label=f"restitution {restitution:g}",
            )  # fmt: skip
        ax.set_title(f"motions × {scale:g}")
        ax.set_xlabel("gap to the wall [mm]")
        ax.set_ylim(-2, 102)
    axes[0].set_ylabel("overturn [%]")
    axes[0].legend(fontsize="small")
    return figure


def _straps(study: Study) -> Figure:
    figure = Figure(figsize=(9, 4.4), layout="constrained")
    axes = figure.subplots(1, len(SCALES), sharey=True)
    table = study.tables["straps"]
    for ax, scale in zip(axes, SCALES, strict=True):
        for n, stiffness in enumerate(STIFFNESSES):
            for k, gap in enumerate((None, *HELD_AT)):
                here = of_scale(table[table["stiffness_per_mass"] == stiffness], scale)
                here = here[here["gap_mm"].isna() if gap is None else here["gap_mm"] == 1e3 * gap]
                where = "no wall" if gap is None else f"wall at {1e3 * gap:g} mm"
                ax.plot(
                    here["slack_mm"], here["force_90"], marker="os^"[k], ms=4, color=f"C{k}",
                    ls=("-", "--")[n], label=f"{where}, k/m {stiffness:g} 1/s²",
                )  # fmt: skip
        ax.axhline(CODE, color="tab:red", lw=1, label="ASCE 7-22, least: 0.06")
        ax.set_title(f"motions × {scale:g}")
        ax.set_xlabel("slack [mm]")
    axes[0].set_ylim(bottom=0.0)
    axes[0].set_ylabel("force in 90 of 100 shakings\n[of the weight]")
    figure.legend(
        *axes[0].get_legend_handles_labels(), fontsize="small", loc="outside lower center", ncols=4
    )
    return figure


def _tilts(study: Study) -> Figure:
    figure = Figure(figsize=(9, 4.4), layout="constrained")
    axes = figure.subplots(1, len(SCALES), sharey=True)
    table = study.tables["tilts"]
    for ax, scale in zip(axes, SCALES, strict=True):
        here = of_scale(table, scale)
        free = here[here["wall"] == "none"]
        ax.plot(free["tilt_deg"], 100 * free["fall_share"], "k--", lw=1, label="no wall")
        for k, gap in enumerate(CATCHING):
            mine = here[(here["wall"] == "vertical") & (here["gap_mm"] == 1e3 * gap)]
            share, low, high = (
                100 * mine[name].to_numpy() for name in ("fall_share", "low", "high")
            )
            ax.errorbar(
                mine["tilt_deg"] + 0.06 * (k - 1.5), share, [share - low, high - share], marker="o",
                ms=3, lw=1, elinewidth=0.7, label=f"wall at {1e3 * gap:g} mm",
            )  # fmt: skip
        ax.set_title(f"motions × {scale:g}")
        ax.set_xlabel("tilt toward the wall [°]")
        ax.set_ylim(-2, 102)
    axes[0].set_ylabel("overturn [%]")
    axes[0].legend(fontsize="small")
    return figure


def _lips(study: Study) -> Figure:
    figure = Figure(figsize=(9, 4.4), layout="constrained")
    axes = figure.subplots(1, len(FRICTIONS), sharey=True)
    table = of_scale(study.tables["lips"], SCALES[-1])
    for ax, friction in zip(axes, FRICTIONS, strict=True):
        for k, thing in enumerate(THINGS):
            here = table[(table["thing"] == thing) & (table["friction"] == friction)]
            at = range(len(here))
            for fall, style in (("fall", "-"), ("off", ":")):
                names = (
                    ("fall_share", "low", "high")
                    if fall == "fall"
                    else ("off_share", "off_low", "off_high")
                )
                share, low, high = (100 * here[name].to_numpy() for name in names)
                ax.errorbar(
                    at, share, [share - low, high - share], marker="os"[k], ms=4, color=f"C{k}",
                    ls=style, lw=1, elinewidth=0.7,
                    label=f"{thing}: {'falls' if fall == 'fall' else 'of these off the shelf'}",
                )  # fmt: skip
        ax.set_xticks(list(at), [f"{lip:g}" for lip in here["lip_mm"]])
        ax.set_title(f"friction {friction:g}, motions × {SCALES[-1]:g}")
        ax.set_xlabel("height of the lip [mm]")
    axes[0].set_ylabel("fall [%]")
    axes[0].set_ylim(bottom=0.0)
    axes[0].legend(fontsize="small")
    return figure


FIGURES = {
    "walls": (
        "Share of the shakings that overturn a bookcase of 0.32 × 0.90 × 1.80 m beside a wall, by "
        f"the gap and the wall's restitution. {BARS}",
        _walls,
    ),
    "straps": (
        "Largest force of a strap from the bookcase's top to the wall, or to an anchor 50 mm "
        "behind it: what is not exceeded in 90 of 100 shakings, by slack and stiffness.",
        _straps,
    ),
    "tilts": (
        "Share of the shakings that overturn the bookcase when its support is tilted toward a "
        f"vertical wall. {BARS}",
        _tilts,
    ),
    "lips": (
        "Share of the shakings, of double size, in which a thing of 0.25 × 0.30 m (squat) or "
        "0.12 × 0.30 m (slender) falls that stands 50 mm from the edge of a shelf, by the lip "
        f"there: off the shelf, or on it. {BARS}",
        _lips,
    ),
}
