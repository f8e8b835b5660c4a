"""
One history is luck
===================

A hundred bookcases whose bases differ by about a centimetre, under the same motion. Their
histories part after a few impacts, so that a single simulation near the border says little. The
share of falls over many motions does not have this problem.
"""

import matplotlib.pyplot as plt
import numpy as np

from shaketable import Body, Outcome, simulate, simulate_each, suite

bases = np.random.default_rng(0).normal(0.32, 0.01, 100)
bodies = [Body.rectangle(base, 1.80) for base in bases]
motion = suite("fema-p695-far-field")[4]
found = simulate_each(bodies, motion, progress=False)
fell = found.outcome.values != Outcome.STANDING
print(f"{fell.sum()} of {fell.size} fall")

figure, (above, below) = plt.subplots(2, 1, layout="constrained")
for body in bodies[:12]:
    run = simulate(body, motion)
    above.plot(run.time, np.degrees(run.rotation), lw=0.8)
above.set(xlabel="time [s]", ylabel="rotation [°]", ylim=(-15, 15), xlim=(0, 25))
bins = np.linspace(bases.min(), bases.max(), 15)
below.hist([bases[~fell], bases[fell]], bins, stacked=True, label=["stands", "falls"])
below.set(xlabel="base [m]", ylabel="bookcases")
below.legend()
