"""Contact, slip and guards of a `phases.Phase`, for compiled code."""

from __future__ import annotations

from shaketable.compiled import kernel
from shaketable.physics.plane.phases import TABLE, Guard, Phase

NO_CONTACT, BOTH, RIGHT, LEFT = range(4)
FLIGHT, REST = int(Phase.FLIGHT), int(Phase.REST)
SLIP, GAP_RIGHT = int(Guard.SLIP), int(Guard.GAP_RIGHT)  # landings are from GAP_RIGHT on

# The rows of phases.TABLE: how many guards a phase has, and which one stands at each place.
MOST_GUARDS = max(len(row) for row in TABLE.values())
GUARD_COUNT = tuple(len(TABLE[phase]) for phase in Phase)
GUARD_AT = tuple(
    tuple(int(guard) for guard in TABLE[phase]) + (-1,) * (MOST_GUARDS - len(TABLE[phase]))
    for phase in Phase
)


@kernel
def contact_of(phase: int) -> int:
    """NO_CONTACT, BOTH, RIGHT or LEFT."""
    return (phase + 2) // 3


@kernel
def slip_of(phase: int) -> float:
    """Direction σ of the slip: +1 toward +x, -1 toward -x, 0 where no contact slips."""
    if phase == FLIGHT:
        return 0.0
    kind = (phase - 1) % 3
    return 1.0 if kind == 1 else -1.0 if kind == 2 else 0.0


@kernel
def side_sign(contact: int) -> float:
    """s: +1 for the right corner, -1 for the left one, 0 for both or none."""
    return 1.0 if contact == RIGHT else -1.0 if contact == LEFT else 0.0


@kernel
def phase_of(contact: int, slip: float) -> int:
    if contact == NO_CONTACT:
        return FLIGHT
    return 3 * contact - 2 + (1 if slip > 0.0 else 2 if slip < 0.0 else 0)


@kernel
def guard_at(phase: int, place: int) -> int:
    """The `phases.Guard` at a place of a phase's row."""
    return GUARD_AT[phase][place]


@kernel
def is_landing(phase: int, place: int) -> bool:
    """Whether the guard at a place of a phase's row is that of a landing corner."""
    return guard_at(phase, place) >= GAP_RIGHT
