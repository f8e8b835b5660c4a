"""The phases of the general model: what ends each of them, and what may follow.

`TABLE` is the hybrid system of theory, section 3 (Boroschek and Iruretagoyena 2006,
eqs. 3-10, after Ishiyama 1982). A phase ends where the first of its guards falls through zero.
What follows is found by complementarity (`complementarity` for forces, `impact` for impulses),
never guessed; a test checks every transition of thousands of runs against the successors named
here.

Compiled code decodes a phase by arithmetic: see `codes`.
"""

from __future__ import annotations

from enum import IntEnum


class Phase(IntEnum):
    """Corners in contact (none, both, right, left) times slip (none, uphill, downhill).

    Inside the engine uphill means toward +x; `on_tilt` gives the name that holds on a tilt.
    """

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


_SLIP_REVERSED = {
    Phase.SLIDE_UPHILL: Phase.SLIDE_DOWNHILL,
    Phase.SLIDE_DOWNHILL: Phase.SLIDE_UPHILL,
    Phase.SLIDE_ROCK_RIGHT_UPHILL: Phase.SLIDE_ROCK_RIGHT_DOWNHILL,
    Phase.SLIDE_ROCK_RIGHT_DOWNHILL: Phase.SLIDE_ROCK_RIGHT_UPHILL,
    Phase.SLIDE_ROCK_LEFT_UPHILL: Phase.SLIDE_ROCK_LEFT_DOWNHILL,
    Phase.SLIDE_ROCK_LEFT_DOWNHILL: Phase.SLIDE_ROCK_LEFT_UPHILL,
}


def on_tilt(phase: Phase, tilt: float) -> Phase:
    """What a phase of the engine is called on a tilt [rad]: below zero, +x is downhill."""
    return phase if tilt >= 0.0 else _SLIP_REVERSED.get(phase, phase)


class Guard(IntEnum):
    """Quantities that end a phase when they fall through zero (symbols: `contact`)."""

    CONE_UPHILL = 0  # a N + b T: friction no longer keeps the contact from slipping uphill
    CONE_DOWNHILL = 1  # a N - b T: from slipping downhill
    PRESSURE_RIGHT = 2  # N_R: the right corner lifts
    PRESSURE_LEFT = 3  # N_L: the left one does
    PRESSURE = 4  # λ (b + X A / i²): the only corner in contact lifts
    SLIP = 5  # σ v: the slip ends
    JAM = 6  # the denominator of their eq. 9: a slipping corner jams (Painlevé)
    GAP_RIGHT = 7  # height of the right corner: it lands
    GAP_LEFT = 8
    LANDING = 9  # s θ: the other corner lands


_ANY = frozenset(Phase)
_ON_RIGHT = {Phase.ROCK_RIGHT, Phase.SLIDE_ROCK_RIGHT_UPHILL, Phase.SLIDE_ROCK_RIGHT_DOWNHILL}
_ON_LEFT = {Phase.ROCK_LEFT, Phase.SLIDE_ROCK_LEFT_UPHILL, Phase.SLIDE_ROCK_LEFT_DOWNHILL}
_UPHILL = {Phase.SLIDE_UPHILL, Phase.SLIDE_ROCK_RIGHT_UPHILL, Phase.SLIDE_ROCK_LEFT_UPHILL}
_DOWNHILL = {Phase.SLIDE_DOWNHILL, Phase.SLIDE_ROCK_RIGHT_DOWNHILL, Phase.SLIDE_ROCK_LEFT_DOWNHILL}

Row = dict[Guard, frozenset[Phase]]


def _slide(forwards: set[Phase]) -> Row:
    """A sliding body stops or turns back; tips, slipping on or jammed to a halt; or takes off."""
    return {
        Guard.SLIP: _ANY - forwards,
        Guard.PRESSURE_RIGHT: frozenset(_ON_LEFT | {Phase.FLIGHT}),
        Guard.PRESSURE_LEFT: frozenset(_ON_RIGHT | {Phase.FLIGHT}),
    }


def _rock(on: set[Phase]) -> Row:
    """A rocking body slips, takes off, or lands on its other corner, where an impact decides."""
    return {
        Guard.CONE_UPHILL: frozenset(on & _UPHILL | {Phase.FLIGHT}),
        Guard.CONE_DOWNHILL: frozenset(on & _DOWNHILL | {Phase.FLIGHT}),
        Guard.LANDING: _ANY,
    }


def _slide_rock(on: set[Phase], forwards: set[Phase]) -> Row:
    """A slipping corner sticks, turns back, jams to a halt or takes off, or the other one lands."""
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
