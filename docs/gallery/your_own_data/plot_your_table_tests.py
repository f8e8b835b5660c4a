"""
Your own shake-table tests
==========================

Tests of a body weigh an ensemble of bodies by how well each predicts them. Here the "tests" are
simulations of a block that is a little more slender than its drawing says; the calibration has to
find that out from falls alone.
"""

import matplotlib.pyplot as plt
import numpy as np

from shaketable import Body, Prior, ShakeTest, calibrate, simulate, suite

true = Body.rectangle(0.115, 0.70)
motions = suite("fema-p695-far-field")[:24:2]
tests = [
    ShakeTest(
        name=f"{motion.name} × {scale}",
        motion=motion,
        scale=scale,
        fell=bool(simulate(true, motion.scaled(scale)).outcome),
    )
    for motion in motions
    for scale in (0.4, 0.7, 1.0)
]
found = calibrate(Prior(), tests, members=512, folds=4, progress=False)
slenderness = found.ensemble.of("slenderness")
figure, ax = plt.subplots()
bins = np.linspace(slenderness.min(), slenderness.max(), 25)
ax.hist(slenderness, bins, density=True, alpha=0.5, label="before the tests")
ax.hist(slenderness, bins, weights=found.weights, density=True, alpha=0.5, label="after them")
ax.axvline(true.slenderness_left, color="black", label="the block that was tested")
ax.set(xlabel="slenderness [rad]", ylabel="probability density")
ax.legend()
print(f"{len(tests)} tests, {sum(test.fell for test in tests)} falls")
