"""Which members of an ensemble fall under a motion that is not known exactly."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from shaketable.calibration.prior import BodyEnsemble
from shaketable.calibration.shake_tests import ShakeTest
from shaketable.models import Model
from shaketable.progress import Progress, meter
from shaketable.simulate import fell, simulate_each

#: Logarithms of the factors under which every motion is simulated. Their weights make them the
#: values of a normal variable, for standard deviations from 0.1 to about half of the last one.
FACTORS = np.linspace(-0.45, 0.45, 7)


def shake(
    ensemble: BodyEnsemble,
    tests: Sequence[ShakeTest],
    *,
    model: Model | str | None = None,
    progress: Progress = True,
    threads: int | None = None,
) -> NDArray[np.bool_]:
    """Whether each member falls in each test, under each factor, shape (member, test, factor)."""
    bodies, tilts = ensemble.bodies, ensemble.of("tilt")
    fallen = np.zeros((len(bodies), len(tests), FACTORS.size), np.bool_)
    factors = np.repeat(np.exp(FACTORS), len(bodies))
    with meter("simulations", fallen.size, progress) as done:
        for k, test in enumerate(tests):
            runs = simulate_each(
                bodies * FACTORS.size,
                test.motion,
                tilts=np.tile(tilts, FACTORS.size),
                scales=test.scale * factors,
                model=model,
                progress=done,
                threads=threads,
            )
            fallen[:, k] = fell(runs).values.reshape(FACTORS.size, -1).T
    return fallen


def chances(fallen: NDArray[np.bool_], noise: float) -> NDArray[np.float64]:
    """The probability that each member falls, where the motion's logarithm has this deviation.

    Args:
        fallen: as `shake` gives it.
        noise: standard deviation of the logarithm of the factor on the motion.

    Returns:
        Probabilities, shape (member, test).
    """
    return np.asarray(fallen @ weights_of(noise))


def weights_of(noise: float) -> NDArray[np.float64]:
    """Weights of FACTORS that stand for a normal variable with this standard deviation."""
    if noise == 0.0:
        return np.where(np.abs(FACTORS) < 1e-9, 1.0, 0.0)
    density = np.exp(-0.5 * (FACTORS / noise) ** 2)
    return np.asarray(density / density.sum())
