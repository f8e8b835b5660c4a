"""The cubic between two points with their slopes (Hermite)."""

from __future__ import annotations

import math

from shaketable.compiled import kernel


@kernel
def top_of(a: float, b: float, da: float, db: float) -> float:
    """The largest value of the cubic from a to b on [0, 1], whose slopes there are da and db."""
    top = max(a, b)
    if da > 0.0 > db:  # it has a stationary point inside
        c3, c2 = 2.0 * (a - b) + da + db, 3.0 * (b - a) - 2.0 * da - db
        inside = c2 * c2 - 3.0 * c3 * da
        if inside >= 0.0:
            root = math.sqrt(inside)
            u = da / (root - c2) if root - c2 != 0.0 else 0.0
            if 0.0 < u < 1.0:
                top = max(top, a + u * (da + u * (c2 + u * c3)))
    return top
