"""
What a floor makes of a motion
==============================

A shear building of six storeys passes on the motion of the ground near its own periods, and more
strongly the higher the floor.
"""

import matplotlib.pyplot as plt
import numpy as np

from shaketable import ShearBuilding, floor_motions, response_spectrum, suite
from shaketable.plot import plot_spectra

ground = suite("fema-p695-far-field")[0]
building = ShearBuilding(storeys=6, first_period=0.65)
periods = np.geomspace(0.05, 4.0, 200)
figure, ax = plt.subplots()
chosen = [ground, *floor_motions(building, ground)[1::2]]
for motion in chosen:
    plot_spectra([response_spectrum(motion, periods)], ax, label=motion.name)
    print(f"{motion.name}: {motion.peak_ground_acceleration / 9.80665:.2f} g")
ax.legend()
