"""The forces, or impulses, that all closed contacts admit together (theory, section 12).

Every contact presses or not, sticks inside its friction cone or slips against its friction: N >= 0,
b |T| <= a N, and T = -σ μ N where it slips in the direction σ. With three degrees of freedom at
most three numbers of forces are independent, and what more contacts share is not unique. So the
forces of all are looked for among those of few: subsets of contacts, each of which sticks (N and T)
or slips (one number), with three numbers at most (Carathéodory). A subset fits if its forces are
admissible, and the motion that they cause is admissible at every closed contact.

Subsets are tried from those that hold most to those that hold nothing, and the first that fits is
taken. The order matters only where several do: friction at rest and as it slips, or Painlevé's
paradox. A slip whose friction jams it (a minor of its matrix is not positive) is never taken.
"""

from __future__ import annotations

from shaketable.compiled import kernel, routine
from shaketable.physics.surrounded.scene import (
    A_SLIP,
    A_STICK,
    B_SLIP,
    B_STICK,
    BEARS,
    BEND_T,
    HOLDS,
    N_X,
    N_Y,
    Q_X,
    Q_Y,
    STICK,
    U_T,
    WHICH,
    Floats,
    Scene,
    Workspace,
)

NONE_FITS = -1
SLIP_SPEED = 3e-10  # m/s: what slips more slowly does not
JAMMED = 1e-3  # of the sizes of its terms: where the matrix of a slip is smaller, it jams
ROUND_OFF = 1e-12  # m/s², m/s: what others are driven in by less is not
SINGULAR = 1e-10  # of the largest number of a matrix
STEADY = 1e-8  # m/s², m/s: how much what does not slip may


@kernel
def row_of(touch: Floats, along_n: float, along_t: float) -> tuple[float, float, float]:
    """A direction at a contact as a row on (x', y', ω): so much of n, so much of t."""
    d_x = along_n * touch[N_X] + along_t * touch[N_Y]
    d_y = along_n * touch[N_Y] - along_t * touch[N_X]
    return d_x, d_y, touch[Q_Y] * d_x - touch[Q_X] * d_y


@kernel
def along_row(w: Floats, row: tuple[float, float, float]) -> float:
    return float(w[0] * row[0] + w[1] * row[1] + w[2] * row[2])


@kernel
def acts_on(
    scene: Scene, row: tuple[float, float, float], force: tuple[float, float, float]
) -> float:
    """What a unit of a force changes along a row."""
    return row[0] * force[0] + row[1] * force[1] + row[2] * force[2] / scene.i2


@kernel
def entry_force(touch: Floats, sigma: int) -> tuple[float, float, float]:
    """Force of a unit of an entry with one number: b along n and a against its slip."""
    if sigma == BEARS:
        return row_of(touch, 1.0, 0.0)
    if abs(sigma) == HOLDS:
        return row_of(touch, touch[B_STICK], -(sigma // HOLDS) * touch[A_STICK])
    return row_of(touch, touch[B_SLIP], -sigma * touch[A_SLIP])


@kernel
def unknowns(work: Workspace, count: int) -> int:
    """How many numbers of forces a subset has."""
    total = 0
    for e in range(count):
        total += 2 if work.entries[e, 1] == STICK else 1
    return total


@routine
def unknown(work: Workspace, count: int, k: int) -> tuple[int, int]:
    """The entry of the k-th number of a subset, and 1 if it is the T of one that sticks."""
    for e in range(count):
        width = 2 if work.entries[e, 1] == STICK else 1
        if k < width:
            return e, k
        k -= width
    return 0, 0


@routine
def force_row(work: Workspace, count: int, k: int) -> tuple[float, float, float]:
    """The force of a unit of the k-th number of a subset."""
    e, tangential = unknown(work, count, k)
    touch = work.touch[work.entries[e, 0]]
    if work.entries[e, 1] == STICK:
        return row_of(touch, 1.0 - tangential, float(tangential))
    return entry_force(touch, work.entries[e, 1])


@routine
def eliminate(work: Workspace, n: int, least: float) -> bool:
    """Solve `work.system`, (n, n + 1), into `work.force`; False if a pivot is below `least`."""
    system = work.system
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if abs(system[i, k]) > abs(system[best, k]):
                best = i
        if not abs(system[best, k]) > least:
            return False
        for j in range(k, n + 1):
            system[k, j], system[best, j] = system[best, j], system[k, j]
        for i in range(k + 1, n):
            ratio = system[i, k] / system[k, k]
            for j in range(k, n + 1):
                system[i, j] -= ratio * system[k, j]
    for k in range(n - 1, -1, -1):
        total = system[k, n]
        for j in range(k + 1, n):
            total -= system[k, j] * work.force[j]
        work.force[k] = total / system[k, k]
    return True


@routine
def solve(scene: Scene, work: Workspace, count: int, forces: bool) -> bool:
    """Write the numbers of a subset, and the motion with them; False if they are not unique."""
    n, system, w = unknowns(work, count), work.system, work.free
    largest = 0.0
    for i in range(n):
        e, tangential = unknown(work, count, i)
        touch = work.touch[work.entries[e, 0]]
        row = row_of(touch, 1.0 - tangential, float(tangential))
        aim = work.goal[work.entries[e, 0]]
        if tangential == 1:
            aim = -touch[BEND_T] if forces else 0.0
        for j in range(n):
            system[i, j] = acts_on(scene, row, force_row(work, count, j))
            largest = max(largest, abs(system[i, j]))
        system[i, n] = aim - along_row(w, row)
    if not eliminate(work, n, SINGULAR * largest):
        return False
    for j in range(3):
        work.after[j] = w[j]
    for k in range(n):
        force = force_row(work, count, k)
        work.after[0] += force[0] * work.force[k]
        work.after[1] += force[1] * work.force[k]
        work.after[2] += force[2] * work.force[k] / scene.i2
    return True


@routine
def presses(work: Workspace, count: int, slack: float) -> bool:
    """Whether the forces of a subset lie in their cones."""
    k = 0
    for e in range(count):
        touch = work.touch[work.entries[e, 0]]
        if work.force[k] < -slack:
            return False
        if work.entries[e, 1] == STICK:
            n, t = work.force[k], work.force[k + 1]
            if touch[A_STICK] * n + slack < touch[B_STICK] * abs(t):
                return False
            k += 1
        k += 1
    return True


@routine
def moves_well(work: Workspace, touches: int, count: int, forces: bool, slack: float) -> bool:
    """Whether a motion is admissible at every contact."""
    for k in range(touches):
        chosen = False  # those of the subset do just what they are asked for, but for round-off
        for e in range(count):
            chosen = chosen or work.entries[e, 0] == k
        rate = along_row(work.after, row_of(work.touch[k], 1.0, 0.0))
        if not chosen and rate < work.goal[k] - max(slack, ROUND_OFF):
            return False
    for e in range(count):
        kind = work.entries[e, 1]
        touch = work.touch[work.entries[e, 0]]
        if kind == STICK or (forces and abs(touch[U_T]) > SLIP_SPEED):
            continue
        slip = along_row(work.after, row_of(touch, 0.0, 1.0))
        if forces:
            slip += touch[BEND_T]
        if abs(kind) > 1:
            if touch[A_STICK] > 0.0 and abs(slip) > STEADY:
                return False
        elif kind * slip < -slack:
            return False
    return True


@routine
def is_jammed(scene: Scene, work: Workspace, count: int) -> bool:
    """Whether the slips of a subset have a minor that is not positive."""
    for e in range(count):
        touch = work.touch[work.entries[e, 0]]
        row, force = row_of(touch, 1.0, 0.0), entry_force(touch, work.entries[e, 1])
        size = abs(row[0] * force[0]) + abs(row[1] * force[1]) + abs(row[2] * force[2]) / scene.i2
        if acts_on(scene, row, force) <= JAMMED * size:
            return True
    if count == 2:
        first, second = work.touch[work.entries[0, 0]], work.touch[work.entries[1, 0]]
        row_1, row_2 = row_of(first, 1.0, 0.0), row_of(second, 1.0, 0.0)
        force_1 = entry_force(first, work.entries[0, 1])
        force_2 = entry_force(second, work.entries[1, 1])
        along = acts_on(scene, row_1, force_1) * acts_on(scene, row_2, force_2)
        across = acts_on(scene, row_1, force_2) * acts_on(scene, row_2, force_1)
        return along - across <= 0.0
    return False


@routine
def has_ended(work: Workspace, count: int) -> bool:
    """Whether a subset is the mode that a guard has ended."""
    if work.ended[0, 0] != count:
        return False
    for e in range(count):
        number = int(work.touch[work.entries[e, 0], WHICH])
        if work.ended[1 + e, 0] != number or work.ended[1 + e, 1] != work.entries[e, 1]:
            return False
    return True


@routine
def fits(
    scene: Scene, work: Workspace, touches: int, count: int, forces: bool, slack: float, ended: bool
) -> bool:
    """Whether the subset that `entries` holds is admissible."""
    for e in range(count):
        touch, kind = work.touch[work.entries[e, 0]], work.entries[e, 1]
        if forces and abs(touch[U_T]) > SLIP_SPEED and kind * touch[U_T] <= 0.0:
            return False  # it moves another way, or moves where it should stick
    if ended and has_ended(work, count):
        return False
    all_slip = unknowns(work, count) == count
    if all_slip and count < 3 and is_jammed(scene, work, count):
        return False
    if not solve(scene, work, count, forces):
        return False
    return presses(work, count, slack) and moves_well(work, touches, count, forces, slack)


@kernel
def enter(work: Workspace, e: int, place: int, kind: int) -> None:
    work.entries[e, 0] = place
    work.entries[e, 1] = kind


@routine
def first_that_fits(
    scene: Scene, work: Workspace, touches: int, forces: bool, slack: float, ended: bool, first: int
) -> int:
    """Write the first admissible subset of the closed contacts to `entries`.

    Returns its size, or NONE_FITS.

    Args:
        touches: how many are closed; `work.goal` and `work.free` tell what they ask for and meet.
        forces: whether they bring accelerations; else velocities, by impulses.
        slack: by how much forces and motions may miss their signs.
        ended: whether the mode in `work.ended` is left out.
        first: the direction of slip that is tried first.
    """
    for j in range(touches):
        for i in range(touches):
            for kind in (BEARS, HOLDS * first, -HOLDS * first, first, -first):
                if i != j and not (forces and abs(kind) == 1):
                    enter(work, 0, j, STICK)
                    enter(work, 1, i, kind)
                    if fits(scene, work, touches, 2, forces, slack, ended):
                        return 2
    for i in range(touches):
        for j in range(i + 1, touches):
            for k in range(j + 1, touches):
                for signs in range(8):
                    does = HOLDS * first if forces else first
                    enter(work, 0, i, does if signs % 2 == 0 else -does)
                    enter(work, 1, j, does if signs // 2 % 2 == 0 else -does)
                    enter(work, 2, k, does if signs // 4 == 0 else -does)
                    if fits(scene, work, touches, 3, forces, slack, ended):
                        return 3
    for j in range(touches):
        enter(work, 0, j, STICK)
        if fits(scene, work, touches, 1, forces, slack, ended):
            return 1
    for i in range(touches):
        for j in range(i + 1, touches):
            for signs in range(4):
                enter(work, 0, i, first if signs % 2 == 0 else -first)
                enter(work, 1, j, first if signs // 2 == 0 else -first)
                if fits(scene, work, touches, 2, forces, slack, ended):
                    return 2
    for sigma in (first, -first):
        for j in range(touches):
            enter(work, 0, j, sigma)
            if fits(scene, work, touches, 1, forces, slack, ended):
                return 1
    if fits(scene, work, touches, 0, forces, slack, ended):
        return 0
    return NONE_FITS
