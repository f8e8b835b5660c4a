"""The phases of the general model: what ends each of them, and what may follow.

`TABLE` is the hybrid system of physics.md section 3 (A eqs. 3-10, after Ishiyama 1982). A phase
ends where the first of its guards falls through zero. What follows is found by complementarity
(`complementarity` for forces, `impact` for impulses), never guessed; a test holds every
transition of thousands of runs against the successors named here.

The codes let compiled code do without a table: see `contact_of`, `slip_of` and `phase_of`.
"""

from __future__ import annotations

from enum import IntEnum

from shaketable.kernels.compiled import kernel


class Phase(IntEnum):
    """Corners in contact (none, both, right, left) times slip (none, uphill, downhill)."""

    FLIGHT = 0
    REST = 1
    SLIDE_UPHILL = 2
    SLIDE_DOWNHILL = 3
    ROCK_RIGHT = 4
    SLIDE_ROCK_RIGHT_UPHILL = 5
    SLIDE_ROCK_RIGHT_DOWNHILL = 6
    ROCK_LEFT = 7
    SLIDE_ROCK_LEFT_UPHILL = 8
    SLIDE_ROCK_LEFT_DOWNHILL = 9


class Guard(IntEnum):
    """Quantities that end a phase when they fall through zero (symbols: `contact`)."""

    CONE_UPHILL = 0  # a N + b T: friction no longer keeps the contact from slipping uphill
    CONE_DOWNHILL = 1  # a N - b T: from slipping downhill
    PRESSURE_RIGHT = 2  # N_R: the right corner lifts
    PRESSURE_LEFT = 3  # N_L: the left one does
    PRESSURE = 4  # N (1 + X A / i²): the only corner in contact lifts
    SLIP = 5  # σ v: the slip ends
    JAM = 6  # the denominator of A eq. 9: a slipping corner jams (Painlevé)
    GAP_RIGHT = 7  # height of the right corner: it lands
    GAP_LEFT = 8
    LANDING = 9  # s θ: the other corner lands


NO_CONTACT, BOTH, RIGHT, LEFT = range(4)
FLIGHT, REST = int(Phase.FLIGHT), int(Phase.REST)


@kernel
def contact_of(phase: int) -> int:
    """NO_CONTACT, BOTH, RIGHT or LEFT."""
    return (phase + 2) // 3


@kernel
def slip_of(phase: int) -> float:
    """Direction σ of the slip: +1 uphill, -1 downhill, 0 for a contact that sticks or none."""
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


_ANY = frozenset(Phase)
_ON_RIGHT = {Phase.ROCK_RIGHT, Phase.SLIDE_ROCK_RIGHT_UPHILL, Phase.SLIDE_ROCK_RIGHT_DOWNHILL}
_ON_LEFT = {Phase.ROCK_LEFT, Phase.SLIDE_ROCK_LEFT_UPHILL, Phase.SLIDE_ROCK_LEFT_DOWNHILL}
_UPHILL = {Phase.SLIDE_UPHILL, Phase.SLIDE_ROCK_RIGHT_UPHILL, Phase.SLIDE_ROCK_LEFT_UPHILL}
_DOWNHILL = {Phase.SLIDE_DOWNHILL, Phase.SLIDE_ROCK_RIGHT_DOWNHILL, Phase.SLIDE_ROCK_LEFT_DOWNHILL}

Row = dict[Guard, frozenset[Phase]]


def _slide(forwards: set[Phase]) -> Row:
    """A sliding body stops or turns; tips, slipping on or jammed to a halt; or takes off."""
    return {
        Guard.SLIP: _ANY - forwards,
        Guard.PRESSURE_RIGHT: frozenset(_ON_LEFT | {Phase.FLIGHT}),
        Guard.PRESSURE_LEFT: frozenset(_ON_RIGHT | {Phase.FLIGHT}),
    }


def _rock(on: set[Phase]) -> Row:
    """A rocking body slips, takes off, or lands on its other corner: then an impact decides."""
    return {
        Guard.CONE_UPHILL: frozenset(on & _UPHILL | {Phase.FLIGHT}),
        Guard.CONE_DOWNHILL: frozenset(on & _DOWNHILL | {Phase.FLIGHT}),
        Guard.LANDING: _ANY,
    }


def _slide_rock(on: set[Phase], forwards: set[Phase]) -> Row:
    """A slipping corner sticks or turns, jams to a halt, takes off, or the other corner lands."""
    return {
        Guard.SLIP: frozenset(on - forwards | {Phase.FLIGHT}),
        Guard.PRESSURE: frozenset({Phase.FLIGHT}),
        Guard.JAM: frozenset(on - forwards | {Phase.FLIGHT}),
        Guard.LANDING: _ANY,
    }


TABLE: dict[Phase, Row] = {
    Phase.FLIGHT: {Guard.GAP_RIGHT: _ANY, Guard.GAP_LEFT: _ANY},
    Phase.REST: {
        Guard.CONE_UPHILL: frozenset(_UPHILL | {Phase.FLIGHT}),
        Guard.CONE_DOWNHILL: frozenset(_DOWNHILL | {Phase.FLIGHT}),
        Guard.PRESSURE_RIGHT: frozenset(_ON_LEFT | {Phase.FLIGHT}),
        Guard.PRESSURE_LEFT: frozenset(_ON_RIGHT | {Phase.FLIGHT}),
    },
    Phase.SLIDE_UPHILL: _slide(_UPHILL),
    Phase.SLIDE_DOWNHILL: _slide(_DOWNHILL),
    Phase.ROCK_RIGHT: _rock(_ON_RIGHT),
    Phase.ROCK_LEFT: _rock(_ON_LEFT),
    Phase.SLIDE_ROCK_RIGHT_UPHILL: _slide_rock(_ON_RIGHT, _UPHILL),
    Phase.SLIDE_ROCK_RIGHT_DOWNHILL: _slide_rock(_ON_RIGHT, _DOWNHILL),
    Phase.SLIDE_ROCK_LEFT_UPHILL: _slide_rock(_ON_LEFT, _UPHILL),
    Phase.SLIDE_ROCK_LEFT_DOWNHILL: _slide_rock(_ON_LEFT, _DOWNHILL),
}
