"""Draws the pictures of docs/how_to/motions.md: python docs/motions_figures.py [RECORDS]

RECORDS is a folder with the records of the Imperial County Services Building, 1979
(imperial_county_services_1979/chan_4_accel/chan_4_accel.txt ...); without it floors.png stays as
it is.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from shaketable import Motion, read_motion, suite
from shaketable.plot import plot_spectra
from shaketable.signal import (
    baseline_corrected,
    displacement,
    response_spectrum,
    velocity,
)
from shaketable.synthesis import (
    ShearBuilding,
    eurocode_8,
    floor_motions,
    spectrum_compatible,
)

DOCS = Path(__file__).parent
PICTURES = DOCS / "pictures"
G, OURS, THEIRS = 9.80665, "#c0392b", "#2a6fae"


def compatible() -> None:
    """Twenty motions with the spectrum of Eurocode 8, and one of them."""
    target = eurocode_8(0.3 * G, "B")
    motions = spectrum_compatible(target, 20, duration=25.0, seed=1)
    periods = np.geomspace(0.03, 3.9, 400)
    spectra = [response_spectrum(motion, periods) for motion in motions]
    figure = Figure(figsize=(10.0, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(1.0, 1.3))
    plot_spectra(spectra, left, color="0.7", lw=0.5)
    mean = np.mean([spectrum.acceleration for spectrum in spectra], axis=0) / G
    wanted = target.at(periods) / G
    left.plot(periods, mean, color=THEIRS, lw=1.6, label="mean of 20")
    left.plot(periods, wanted, color=OURS, lw=1.2, label="Eurocode 8, ground B, 0.3 g")
    left.plot(periods, 0.9 * wanted, color=OURS, lw=0.8, ls="--", label="±10 %")
    left.plot(periods, 1.1 * wanted, color=OURS, lw=0.8, ls="--")
    left.axvspan(0.05, 3.0, color="0.95", zorder=0)
    left.set_xlim(0.03, 3.9)
    left.legend(fontsize="small", loc="lower left")
    for row, motion in enumerate(motions[:4]):
        right.plot(motion.time, motion.horizontal / G + 0.9 * (3 - row), color=THEIRS, lw=0.6)
    right.set_yticks(0.9 * np.arange(4), ["no. 4", "no. 3", "no. 2", "no. 1"])
    right.plot([24.0, 24.0], [3.0, 3.5], color="black", lw=2)
    right.text(23.8, 3.25, "0.5 g", ha="right", va="center", fontsize="small")
    right.set_xlabel("time [s]")
    right.set_xlim(0.0, 25.0)
    figure.savefig(PICTURES / "compatible.png", dpi=110)


def baseline() -> None:
    """A record with a known offset on an instrument whose zero shifts, before and after."""
    record = suite("fema-p695-far-field")[6]
    h = record.time_step
    a = np.concatenate([np.zeros(round(5 / h)), record.horizontal, np.zeros(round(15 / h))])
    t = np.arange(a.size) * h
    x = np.clip((t - 11.0) / 3.0, 0.0, 1.0)
    clean = a + 0.9 * 2 * np.pi / 9.0 * np.sin(2 * np.pi * x)
    zero = np.where((t > 12.0) & (t <= 17.0), 0.02, 0.0) + np.where(t > 17.0, -0.004, 0.0)
    seen = Motion(clean + zero, h)
    shown = {
        "the ground": (clean, "black", 2.0),
        "the instrument": (clean + zero, "0.6", 1.2),
        "corrected, t1 and t2 searched": (baseline_corrected(seen).horizontal, OURS, 1.2),
        "corrected, t1 and t2 known": (
            baseline_corrected(seen, t1=12.0, t2=17.0).horizontal,
            THEIRS,
            1.2,
        ),
    }
    figure = Figure(figsize=(8.0, 4.6), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True)
    for label, (series, colour, width) in shown.items():
        above.plot(t, 100 * velocity(series, h), color=colour, lw=width, label=label)
        below.plot(t, 100 * displacement(series, h), color=colour, lw=width)
    above.set_ylabel("velocity [cm/s]")
    below.set_ylabel("displacement [cm]")
    below.set_xlabel("time [s]")
    below.set_ylim(-60, 160)
    below.set_xlim(0.0, t[-1])
    above.legend(fontsize="small", loc="upper right")
    figure.savefig(PICTURES / "baseline.png", dpi=110)


def floors(records: Path) -> None:
    """Recorded and computed roof of the Imperial County Services Building, 15 October 1979."""
    figure = Figure(figsize=(10.0, 5.6), layout="constrained")
    axes = figure.subplots(2, 2, width_ratios=(1.5, 1.0))
    cases = {
        "across, channels 10 and 2": (10, 2, 0.49, 0.65),
        "along, channels 13 and 4": (13, 4, 0.89, 1.3),
    }
    for (label, (ground, roof, early, fitted)), (left, right) in zip(
        cases.items(), axes, strict=True
    ):
        below, above = (channel(records, number) for number in (ground, roof))
        late = floor_motions(ShearBuilding(storeys=6, first_period=fitted, damping=0.1), below)[-1]
        soon = floor_motions(ShearBuilding(storeys=6, first_period=early, damping=0.05), below)[-1]
        left.plot(above.time, above.horizontal / G, color="black", lw=0.9, label="recorded")
        left.plot(late.time, late.horizontal / G, color=OURS, lw=0.8, label="computed")
        left.set_xlim(0.0, 25.0)
        left.set_title(f"roof, {label}", fontsize="medium")
        left.set_ylabel("acceleration [g]")
        plot_spectra([response_spectrum(below)], right, color="0.6", label="ground, recorded")
        plot_spectra([response_spectrum(above)], right, color="black", label="roof, recorded")
        said = "computed, {:g} s, {:g} %"
        plot_spectra([response_spectrum(late)], right, color=OURS, label=said.format(fitted, 10))
        plot_spectra(
            [response_spectrum(soon)], right, color=OURS, ls=":", label=said.format(early, 5)
        )
        right.set_xlim(0.05, 5.0)
        right.set_ylabel("pseudo-acceleration [g]")
        right.legend(fontsize="x-small", loc="lower left")
        n = min(above.horizontal.size, late.horizontal.size)
        like = np.corrcoef(above.horizontal[:n], late.horizontal[:n])[0, 1]
        peaks = [one.peak_ground_acceleration / G for one in (above, late, soon)]
        sys.stdout.write(
            f"{label}: peak floor acceleration [g] recorded {peaks[0]:.2f}, computed with the "
            f"fitted period {peaks[1]:.2f}, with the early one {peaks[2]:.2f}; "
            f"correlation {like:.2f}\n"
        )
    axes[0, 0].legend(fontsize="small", loc="upper right")
    axes[1, 0].set_xlabel("time [s]")
    axes[0, 1].set_xlabel("")
    figure.savefig(PICTURES / "floors.png", dpi=110)


def channel(records: Path, number: int) -> Motion:
    name = f"chan_{number}_accel"
    folder = records / "imperial_county_services_1979" / name
    return read_motion(folder / f"{name}.txt", units="g")


if __name__ == "__main__":
    compatible()
    baseline()
    if len(sys.argv) > 1:
        floors(Path(sys.argv[1]))
