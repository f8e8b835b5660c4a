"""What only slides, along one direction: exact, as forces are linear between samples.

Newmark (1965) for any history, and for a normal force that changes with the vertical motion: while
it slides, the slip is a cubic in each interval, and its turning points are roots of a quadratic.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def slip_of(
    push: NDArray[np.float64], normal: NDArray[np.float64], friction: float, step: float
) -> float:
    """The slip at the end [m].

    Args:
        push: apparent acceleration along the support [m/s²], (sample,).
        normal: apparent gravity against the support [m/s²], (sample,), positive.
        friction: static and kinetic.
        step: between samples [s].
    """
    place, speed = 0.0, 0.0
    for k in range(len(push) - 1):
        at, end = 0.0, step
        slope, press = (push[k + 1] - push[k]) / step, (normal[k + 1] - normal[k]) / step
        while at < end:
            now, weight = push[k] + slope * at, normal[k] + press * at
            side = np.sign(speed)
            if side == 0.0:
                side = _begins(now, weight, slope, press, friction)
                if side == 0.0:  # it stays until the bound is met, if it is met at all
                    at = _met(push[k], normal[k], slope, press, friction, at, end)
                    continue
            # relative acceleration: push - side · friction · normal
            a, b = now - side * friction * weight, slope - side * friction * press
            left = end - at
            turning = [
                root.real
                for root in np.roots([b / 2.0, a, speed] if b else [a, speed] if a else [1.0])
                if abs(root.imag) < 1e-14 and 1e-15 < root.real < left
            ]
            length = min(turning, default=left)
            place += speed * length + a * length**2 / 2.0 + b * length**3 / 6.0
            speed = 0.0 if turning else speed + a * left + b * left**2 / 2.0
            at = at + length if turning else end
    return abs(place)


def _begins(push: float, normal: float, slope: float, press: float, friction: float) -> float:
    """The side to which it begins to slide now, 0 where it stays."""
    for side in (1.0, -1.0):
        beyond = side * push - friction * normal
        if beyond > 1e-12 or (abs(beyond) <= 1e-12 and side * slope - friction * press > 0.0):
            return side
    return 0.0


def _met(
    push: float, normal: float, slope: float, press: float, friction: float, at: float, end: float
) -> float:
    """When the friction's bound is met next, or the end."""
    times = [end]
    for side in (1.0, -1.0):
        rate = side * slope - friction * press
        if rate > 0.0:
            time = (friction * normal - side * push) / rate
            if at < time < end:
                times.append(time)
    return min(times)
