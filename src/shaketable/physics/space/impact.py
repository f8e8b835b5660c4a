"""Impacts: all touches of the list, struck together.

Newton's law at the touches that close, complementary to their impulse, and Coulomb's disc. As with
forces, an impact where what is struck sticks is tried first. Newton's law with friction can add
energy (Kane & Levinson 1985); the restitution is then lowered to the largest share of it that adds
none.
"""

from __future__ import annotations

from shaketable.compiled import kernel, routine
from shaketable.physics.space.complementarity import CONVERGED, balance, sweeps_left
from shaketable.physics.space.constraints import measured
from shaketable.physics.space.contacts import arm, axes_at, velocity
from shaketable.physics.space.touches import look_at_touches, touch_gap, touch_velocity
from shaketable.physics.space.vectors import (
    ZERO,
    Axes,
    add,
    applied,
    cross,
    dot,
    on_body,
    on_support,
    subtract,
    times,
)
from shaketable.physics.space.walled import (
    LIKE_LEAST,
    PRESSURE,
    impelled,
    judge_touches,
    write_mode,
    write_row,
)
from shaketable.physics.space.workspace import (
    PRESSES,
    PULLS,
    STATE,
    Floats,
    SolidParameters,
    V,
    W,
    Workspace,
    put,
    vec,
)

ROUND_OFF = 1e-12  # of the largest speed
ENERGY_SLACK = 1e-12  # of the energy
HALVINGS = 40
CREEP_SWEEPS = 30  # in each step of the time stepping
MOST_STICKING = 12  # tries, to find which touches bear a part of an impact that stick
SLIPS, STAYS, BOUNCES = range(3)  # what touches do in an impact
HOLDS, PULLED, SINKS, SLIDES = range(4)  # how an impact in which all sticks turns out


@kernel
def kinetic_energy(shape: SolidParameters, y: Floats) -> float:
    """Per unit mass [m²/s²]."""
    v, spin = vec(y, V), vec(y, W)
    return 0.5 * (dot(v, v) + dot(spin, applied(shape.inertia, spin)))


@routine
def strike(shape: SolidParameters, work: Workspace, share: float, within: float) -> int:
    """Change the state's velocities by the impact of all touches; those before are in `trial`.

    Args:
        share: of each plane's restitution.
        within: time in which what has a gap may close it [s]; 0 where all are closed.

    Returns: SLIPS, STAYS or BOUNCES, what the touches do.
    """
    before, y, fastest = work.trial, work.state, 0.0
    for j in range(STATE):
        y[j] = before[j]
    q = axes_at(before)
    look_at_touches(shape, work, q, before)
    for place in range(work.mode.touches):
        touch, u = work.touches[place], touch_velocity(work, q, before, place)
        fastest = max(fastest, abs(u.x), abs(u.y), abs(u.z))
        put(touch.free, 0, u)
        put(touch.share, 0, ZERO)
        touch.moves = 0
        restitution = share * work.planes[touch.plane].restitution
        touch.goal = -restitution * u.z if u.z < -shape.limits.bounce else 0.0
        if within > 0.0:
            touch.goal = -max(touch_gap(shape, work, q, before, place), 0.0) / within
    if within == 0.0 and try_sticking(shape, work, q, ROUND_OFF * fastest):
        return BOUNCES if bounces_any(work) else STAYS
    sweeps = sweeps_left(work) if within == 0.0 else CREEP_SWEEPS
    if not balance(shape, work, work.mode.touches, False, ZERO, sweeps):
        work.tally.fallbacks += 1
    put(y, V, add(vec(y, V), on_support(q, vec(work.change, 0))))
    put(y, W, add(vec(y, W), vec(work.change, 3)))
    return SLIPS


@routine
def try_sticking(shape: SolidParameters, work: Workspace, q: Axes, slack: float) -> bool:
    """Try an impact in which all that is struck sticks; the state is struck if it is one.

    Struck is first what approaches, then also what would sink, and not what would be pulled; where
    that would slip, each touch alone.

    Args:
        slack: a speed that is none [m/s].
    """
    before, y, how = work.trial, work.state, SINKS
    for place in range(work.mode.touches):
        touch = work.touches[place]
        touch.carries = PRESSES if touch.free[2] < touch.goal - slack else PULLS
    for _ in range(MOST_STICKING):
        how = judge_sticking(shape, work, q, slack)
        if how == PULLED:
            drop_pulled(work)
        elif how == SINKS:
            add_sinking(work, q, slack)
        else:
            break
    for only in range(work.mode.touches):
        if how == HOLDS:
            return True
        if work.touches[only].free[2] < work.touches[only].goal - slack:
            for place in range(work.mode.touches):
                work.touches[place].carries = PRESSES if place == only else PULLS
            how = judge_sticking(shape, work, q, slack)
    if how != HOLDS:
        put(y, V, vec(before, V))
        put(y, W, vec(before, W))
        for place in range(work.mode.touches):
            put(work.touches[place].share, 0, ZERO)
    return how == HOLDS


@routine
def judge_sticking(shape: SolidParameters, work: Workspace, q: Axes, slack: float) -> int:
    """Strike what carries so that it sticks, and judge that: HOLDS, PULLED, SINKS or SLIDES."""
    y, close = work.state, CONVERGED / ROUND_OFF * slack
    write_mode(shape, work, q)
    impel(shape, work, q)
    judge_touches(shape, work)
    if work.judged.press < -slack:
        return PULLED
    how = HOLDS if work.judged.cone >= 0.0 else SLIDES
    for place in range(work.mode.touches):
        touch, u = work.touches[place], touch_velocity(work, q, y, place)
        if touch.carries != PRESSES and u.z < touch.goal - slack:
            return SINKS
        if touch.carries == PRESSES and max(abs(u.x), abs(u.y), touch.goal - u.z) > close:
            how = SLIDES
    return how


@routine
def add_sinking(work: Workspace, q: Axes, slack: float) -> None:
    """Let those touches carry, too, that sink in the state that is struck."""
    for place in range(work.mode.touches):
        if touch_velocity(work, q, work.state, place).z < work.touches[place].goal - slack:
            work.touches[place].carries = PRESSES


@routine
def impel(shape: SolidParameters, work: Workspace, q: Axes) -> None:
    """Strike the state as the rows that are kept say: their touches get their goals, and stick."""
    before, y, k = work.trial, work.state, work.mode.rows
    linear, spin = on_body(q, vec(before, V)), vec(before, W)
    for i in range(k):
        place, component = work.kept[i, 0], work.kept[i, 1]
        write_row(work, i, place, component)
        goal = work.touches[place].goal if component == PRESSURE else 0.0
        work.system[i, k] = goal - measured(work.rows[i], linear, spin)
    change, turn = impelled(shape, work)
    put(y, V, add(vec(before, V), on_support(q, change)))
    put(y, W, add(spin, turn))


@kernel
def drop_pulled(work: Workspace) -> None:
    """Let those touches carry nothing that are pulled most."""
    least = 0.0
    for place in range(work.mode.touches):
        least = min(least, work.touches[place].share[2])
    for place in range(work.mode.touches):
        if work.touches[place].share[2] < LIKE_LEAST * least:
            work.touches[place].carries = PULLS


@routine
def lose_spin(shape: SolidParameters, work: Workspace) -> None:
    """Multiply the spin that a rocking impact in the plane leaves by the restitution factor.

    As `plane.impact.lossy`: where some of the points on the support stay there and others leave,
    the middle of those that stay keeps its velocity u, and that of the centre of gravity follows.
    Where it slips, less spin would add energy below the share s = u·(ω × r)/(|ω × r|² + ω·I ω) of
    it: the factor is then raised to 2 s - 1.
    """
    if shape.factor == 1.0:
        return
    q, y, stay, middle = axes_at(work.state), work.state, 0, ZERO
    for place in range(work.mode.near):
        point = work.touches[place].point
        if velocity(shape, work, q, y, point).z <= shape.limits.leaving:
            middle, stay = add(middle, arm(shape, work, point)), stay + 1
    if stay == 0 or stay == work.mode.near:
        return
    spin, r = vec(y, W), times(1.0 / stay, middle)
    turning = cross(spin, r)
    u = add(on_body(q, vec(y, V)), turning)
    size = dot(turning, turning) + dot(spin, applied(shape.inertia, spin))
    if size == 0.0:
        return
    factor = min(1.0, max(shape.factor, 2.0 * dot(u, turning) / size - 1.0))
    put(y, W, times(factor, spin))
    put(y, V, on_support(q, subtract(u, times(factor, turning))))


@kernel
def bounces_any(work: Workspace) -> bool:
    """Whether a touch is to rise after the impact."""
    found = False
    for place in range(work.mode.touches):
        found = found or work.touches[place].goal > 0.0
    return found


@routine
def collide(shape: SolidParameters, work: Workspace) -> None:
    """The impact of all touches, with the share of the restitutions that its energy allows."""
    before = work.trial
    for j in range(STATE):
        before[j] = work.state[j]
    how = strike(shape, work, 1.0, 0.0)
    if how == STAYS and shape.factor < 1.0 and not shape.planar:
        # the velocities that are left keep the contact
        put(work.state, V, times(shape.factor, vec(work.state, V)))
        put(work.state, W, times(shape.factor, vec(work.state, W)))
    allowed = kinetic_energy(shape, before) * (1.0 + ENERGY_SLACK)
    if not bounces_any(work) or kinetic_energy(shape, work.state) <= allowed:
        return
    work.tally.energy_cuts += 1
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        strike(shape, work, middle, 0.0)
        if kinetic_energy(shape, work.state) <= allowed:
            low = middle
        else:
            high = middle
    strike(shape, work, low, 0.0)
