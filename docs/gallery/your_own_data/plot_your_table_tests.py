"""
Your own shake-table tests
==========================

Tests of a body weigh an ensemble of bodies by how well each predicts them. Here the "tests" are
simulations of a block of known size. Its slenderness is taken as unknown within 20 %, and is
narrowed by the falls alone.
"""

import matplotlib.pyplot as plt
import numpy as np

from shaketable import Body, Prior, ShakeTest, calibrate, simulate, suite
from shaketable.calibration import Range

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
    for scale in (0.3, 0.5, 0.7, 1.0)
]
alpha = true.slenderness_left
prior = Prior(
    slenderness=Range(0.8 * alpha, 1.2 * alpha),
    half_diagonal=Range(0.34, 0.37),
    cg_offset=Range(0.0, 0.0),
    restitution_factor=Range(1.0, 1.0),
)
found = calibrate(prior, tests, members=2048, folds=4, progress=False)
slenderness = found.ensemble.of("slenderness")
figure, ax = plt.subplots()
bins = np.linspace(slenderness.min(), slenderness.max(), 25)
ax.hist(slenderness, bins, density=True, alpha=0.5, label="before the tests")
ax.hist(slenderness, bins, weights=found.weights, density=True, alpha=0.5, label="after them")
ax.axvline(alpha, color="black", label="the block that was tested")
ax.set(xlabel="slenderness [rad]", ylabel="probability density")
ax.legend()
low, high = np.quantile(
    np.random.default_rng(0).choice(slenderness, 100_000, p=found.weights), [0.025, 0.975]
)
print(f"{len(tests)} tests, {sum(test.fell for test in tests)} falls")
print(f"slenderness {low:.3f} to {high:.3f} rad (95 %), the tested block has {alpha:.3f}")
