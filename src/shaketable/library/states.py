"""Which limit states each simulation of a case reached."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, quoted
from shaketable.fragility.limit_states import (
    HELD_UP,
    LEANS,
    OVERTURNS,
    REACHES,
    ROCKS,
    SLIDES,
    UPLIFT,
    WALKS_OFF,
    LimitState,
    limit_state,
)
from shaketable.library.case import Case
from shaketable.library.draws import BASE_DIFFERS
from shaketable.library.reach import wall_behind
from shaketable.library.shaken import CaseRuns


def state_of_library(text: str) -> LimitState:
    """The limit state that a library's file names.

    Raises:
        InputError: none of this name, or one that is of planar bodies alone.
    """
    found = limit_state(text)
    if found.kind == ROCKS:
        raise InputError(f"limit state {quoted(text)} is of planar bodies; write 'uplift'")
    if found.kind == LEANS:
        raise InputError(
            f"limit state {quoted(text)} is of edition 1.0 of the published library; write "
            f"{quoted(HELD_UP)}"
        )
    return found


def has_state(case: Case, state: LimitState) -> bool:
    """Whether a case can come to a state.

    What stands on a table walks off it; other things reach, and are held up by a wall. A thing
    that covers the ground so far from the wall before it is shaken has no such state.
    """
    if state.kind == WALKS_OFF:
        return case.held.edge is not None
    if state.kind == HELD_UP:
        return case.held.wall_gap is not None
    if state.kind == REACHES:
        at_rest = wall_behind(case) + case.thing.depth * (1.0 + BASE_DIFFERS)
        return case.held.edge is None and at_rest < state.least
    return True


def reached(state: LimitState, runs: CaseRuns) -> NDArray[np.bool_]:
    """Whether each simulation reached a state, (run,).

    What fell has lifted off and slid, too.
    """
    return {
        UPLIFT: runs.fell | (runs.rotation > 0.0),
        SLIDES: runs.fell | (runs.farthest >= state.least),
        WALKS_OFF: runs.off,
        OVERTURNS: runs.fell,
        HELD_UP: runs.fell | runs.held_up,
        REACHES: runs.reach >= state.least,
    }[state.kind]
