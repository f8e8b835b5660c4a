"""
A centre of gravity off centre
==============================

A body whose centre of gravity lies nearer to one edge falls more often, and to that side. The
criterion of Ishiyama (1982) with the whole base does not see it; with B' = 2νB it does
(Boroschek and Romo 2004).
"""

import matplotlib.pyplot as plt
import numpy as np

from shaketable import Body, Outcome, simulate_many, suite

nus = np.linspace(0.2, 0.5, 7)  # distance of the centre of gravity from the left edge over the base
bodies = [Body.rectangle(0.4, 1.8, eccentricity=nu) for nu in nus]
runs = simulate_many(bodies, suite("fema-p695-far-field"), progress=False)
over = ("motion", "polarity", "tilt", "scale")
left = 100 * (runs.outcome == Outcome.DOWNHILL).mean(over)
right = 100 * (runs.outcome == Outcome.UPHILL).mean(over)

figure, ax = plt.subplots()
ax.stackplot(nus, left, right, labels=["falls to the near side", "falls to the far side"])
ax.set(xlabel="eccentricity ν", ylabel="simulations [%]", ylim=(0, 100))
ax.legend()
print(f"ν = 0.5: {float(left[-1] + right[-1]):.0f} %, ν = 0.2: {float(left[0] + right[0]):.0f} %")
