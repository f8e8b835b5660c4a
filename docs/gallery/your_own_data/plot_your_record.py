"""
Your own record
===============

A record is a file in any known format, or columns of numbers. Its units are read from the header
or given, never guessed.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from shaketable import Body, intensity_measures, read_motion, response_spectrum, simulate
from shaketable.plot import plot_spectra

# A file as a data logger writes it; replace it by your own.
time = np.arange(0, 12, 0.01)
values = 0.35 * np.sin(2 * np.pi * 1.2 * time) * np.exp(-(((time - 4) / 1.5) ** 2))
file = Path(tempfile.mkdtemp()) / "logger.csv"
np.savetxt(
    file,
    np.c_[time, values],
    delimiter=",",
    header="time_s,acceleration_g",
    comments="",
    fmt="%.5f",
)

motion = read_motion(file)
measures = intensity_measures(motion)
print(f"PGA {measures['PGA']:.2f} m/s², PGV {measures['PGV']:.2f} m/s")

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
plot_spectra([response_spectrum(motion)], left)
run = simulate(Body.rectangle(0.32, 1.8), motion)
right.plot(run.time, np.degrees(run.rotation))
right.set(xlabel="time [s]", ylabel="rotation of a bookcase [°]", title=run.outcome.name.lower())
