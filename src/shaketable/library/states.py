"""Which limit states each simulation of a case reached."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from shaketable.errors import InputError, quoted
from shaketable.fragility.limit_states import (
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
from shaketable.library.shaken import CaseRuns


def state_of_library(text: str) -> LimitState:
    """The limit state that a library's file names.

    Raises:
        InputError: none of this name, or one that is of planar bodies alone.
    """
    found = limit_state(text)
    if found.kind == ROCKS:
        raise InputError(f"limit state {quoted(text)} is of planar bodies; write 'uplift'")
    return found


def has_state(case: Case, state: LimitState) -> bool:
    """Whether a case can reach a state: a thing on a table walks off, another one reaches far."""
    on_table = case.held.edge is not None
    return {WALKS_OFF: on_table, REACHES: not on_table}.get(state.kind, True)


def reached(state: LimitState, runs: CaseRuns) -> NDArray[np.bool_]:
    """Whether each simulation reached a state, (run,); what fell has rocked and slid, too."""
    return {
        UPLIFT: runs.fell | (runs.rotation > 0.0),
        SLIDES: runs.fell | (runs.farthest >= state.least),
        WALKS_OFF: runs.off,
        OVERTURNS: runs.fell,
        REACHES: runs.reach >= state.least,
    }[state.kind]
