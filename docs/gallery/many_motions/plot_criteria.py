"""
What simple criteria miss
=========================

Two peaks of a motion give a verdict at once. Here each criterion judges 44 motions, and the
simulation says which of its verdicts were right. A score above 1 means that the body may
overturn. Housner's velocity is the one at which half of such bodies fall, so that his score misses
many falls.
"""

import matplotlib.pyplot as plt
import numpy as np

from shaketable import Body, Outcome, simulate_many, suite
from shaketable.criteria import scores
from shaketable.signal import peaks

shelf = Body.rectangle(0.40, 1.80, eccentricity=0.35)
motions = suite("fema-p695-far-field")
found = [peaks(motion) for motion in motions]
pga = np.array([each.acceleration for each in found])
pgv = np.array([each.velocity for each in found])
runs = simulate_many([shelf], motions, progress=False)
falls = (runs.outcome != Outcome.STANDING).any("polarity").values.ravel()

says = scores(shelf.base, 0.35, shelf.cg_height, shelf.gyration_radius, pga, pgv)
names = list(says)
missed = [int((falls & (score <= 1)).sum()) for score in says.values()]
alarms = [int((~falls & (score > 1)).sum()) for score in says.values()]
for name, miss, alarm in zip(names, missed, alarms, strict=True):
    print(f"{name}: misses {miss} of {falls.sum()} falls, {alarm} false alarms of {(~falls).sum()}")

figure, ax = plt.subplots(layout="constrained")
place = np.arange(len(names))
ax.barh(place + 0.2, missed, 0.4, label=f"missed, of {falls.sum()} motions that overturn")
ax.barh(place - 0.2, alarms, 0.4, label=f"false alarms, of {(~falls).sum()} that do not")
ax.set_yticks(place, names)
ax.set_xlabel("motions")
ax.legend()
