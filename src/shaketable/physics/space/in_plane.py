"""What a deep body that moves in the plane of x and z alone keeps, and notes, as a planar one does.

Its corners on the support stand for the corners of a planar body; how far they slip is told along
x, from where they stood upright.
"""

from __future__ import annotations

from shaketable.compiled import kernel, routine
from shaketable.physics.space.contacts import arm, axes_at, normalise
from shaketable.physics.space.edge import support_gap
from shaketable.physics.space.vectors import on_support
from shaketable.physics.space.workspace import Floats, P, Q, SolidParameters, V, W, Workspace


@routine
def keep_in_plane(y: Floats) -> None:
    """Take out of a state what rounding, or reactions that did not converge, moved sideways."""
    y[P + 1] = y[V + 1] = y[W] = y[W + 2] = y[Q + 1] = y[Q + 3] = 0.0
    normalise(y)


@kernel
def slip_of(shape: SolidParameters, work: Workspace, point: int) -> float:
    """How far a corner is along x from where it stood [m]."""
    at = on_support(axes_at(work.state), arm(shape, work, point))
    return float(work.state[P] + at.x - work.points[point].x)


@routine
def note_slips_in_plane(shape: SolidParameters, work: Workspace) -> None:
    """Note how far the corners on the support have slipped."""
    q, y, tally = axes_at(work.state), work.state, work.tally
    for point in range(shape.contacts):
        if support_gap(shape, work, q, y, point) <= shape.limits.landing:
            slip = slip_of(shape, work, point)
            tally.slip_back = min(tally.slip_back, slip)
            tally.slip_front = max(tally.slip_front, slip)
