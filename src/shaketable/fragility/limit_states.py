"""What a simulation may do to a body, as states of which each is reached or not."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shaketable.body import Body
from shaketable.errors import InputError, quoted
from shaketable.simulate import fell

if TYPE_CHECKING:
    import xarray as xr

OVERTURNS, UPLIFT, ROCKS, SLIDES = "overturns", "uplift", "rocks", "slides"
WALKS_OFF, REACHES = "walks off", "reaches"
HELD_UP = "overturns or held up"
LEANS = "overturns or leans"  # of edition 1.0 of the published library, read and not computed
#: What planar bodies are not asked.
OF_LIBRARIES = (WALKS_OFF, REACHES, HELD_UP, LEANS)
_NUMBERED = re.compile(r"(rocks|slides|reaches)\s+([0-9.eE+-]+)\s*(α|alpha|m)")
_UNITS = {"rocks": ("α", "alpha"), "slides": ("m",), "reaches": ("m",)}
#: What each means; {least} is its number.
MEANINGS = {
    OVERTURNS: "It falls over.",
    UPLIFT: "A point of its base lifts off: it rocks, or falls.",
    ROCKS: "It rocks to {least} of its slenderness.",
    SLIDES: "It slides by {least} m, or falls.",
    WALKS_OFF: "It goes over the edge of its table.",
    HELD_UP: "It falls over, or would at the end without its wall and strap.",
    LEANS: "It falls over, or ends leaning on its wall or held up by its strap, at any angle.",
    REACHES: "Once it stands or lies again, it covers ground {least} m or farther from the wall "
    "behind it, or from the line of its back where there is no wall.",
}


@dataclass(frozen=True)
class LimitState:
    """A state of a body; a body that overturned has passed all others.

    Attributes:
        kind: overturns, uplift (it rocks at all), rocks (to a share of its slenderness), slides,
            walks off (its table), reaches (so far from the wall behind it), or overturns or held up
            (by its wall or strap alone).
        least: that share, the slip or the distance [m]; 0 for the others.
    """

    kind: str
    least: float = 0.0

    @property
    def name(self) -> str:
        """As a user writes it."""
        if self.kind == ROCKS:
            return f"rocks {self.least:g} α"
        return f"{self.kind} {self.least:g} m" if self.least else self.kind

    @property
    def meaning(self) -> str:
        """In a sentence."""
        return MEANINGS[self.kind].format(least=f"{self.least:g}")

    def reached(self, runs: xr.Dataset, bodies: Sequence[Body]) -> xr.DataArray:
        """Whether each simulation brought its body there.

        Args:
            runs: of `simulate_many`.
            bodies: those of the runs.

        Raises:
            InputError: the runs tell nothing of it, as slip of a model that does not slide.
        """
        fallen = fell(runs)
        if self.kind == OVERTURNS:
            return fallen
        if self.kind in OF_LIBRARIES:
            raise InputError(f"limit state {self.name!r} is of the things of a library alone")
        if self.kind in (UPLIFT, ROCKS) and "peak_rotation" not in runs:
            raise InputError(f"limit state {self.name!r}: the runs hold no peak_rotation")
        if self.kind == UPLIFT:
            return fallen | (runs["peak_rotation"] > 0.0)
        if self.kind == ROCKS:
            slender = [min(body.slenderness_left, body.slenderness_right) for body in bodies]
            return fallen | (runs["peak_rotation"] >= self.least * _along_bodies(slender, runs))
        if "slip_downhill" not in runs:
            raise InputError(
                f"limit state {self.name!r}: the rocking model knows no slip; give "
                "model=General(static_friction=...)"
            )
        return fallen | (np.maximum(runs["slip_downhill"], runs["slip_uphill"]) >= self.least)


def _along_bodies(values: Sequence[float], runs: xr.Dataset) -> xr.DataArray:
    import xarray as xr

    return xr.DataArray(np.array(values), dims="body", coords={"body": runs["body"]})


def limit_state(text: str) -> LimitState:
    """The state that a user names.

    Raises:
        InputError: none of this name.
    """
    word = text.strip()
    if word in (OVERTURNS, UPLIFT, WALKS_OFF, HELD_UP, LEANS):
        return LimitState(word)
    match = _NUMBERED.fullmatch(word)
    try:
        least = float(match[2]) if match and match[3] in _UNITS[match[1]] else 0.0
    except ValueError:
        least = 0.0
    if match is not None and match[1] == ROCKS and least >= 1.0:
        raise InputError(
            f"limit state {quoted(text)}: a body that rocks to its slenderness falls over; write "
            "'overturns', or a share below 1"
        )
    if match is None or not (np.isfinite(least) and least > 0.0):
        raise InputError(
            f"unknown limit state {quoted(text)}; accepted: overturns, uplift, 'rocks 0.5 α' "
            "(or alpha), 'slides 0.1 m', and in a library 'overturns or held up', 'walks off' and "
            "'reaches 0.8 m'"
        )
    return LimitState(match[1], least)


def limit_states(texts: str | Sequence[str]) -> list[LimitState]:
    """Several states, none twice.

    Raises:
        InputError: an unknown one, the same twice, or none.
    """
    states = [limit_state(text) for text in ([texts] if isinstance(texts, str) else texts)]
    if not states:
        raise InputError("limit_states= is empty; at least one is needed, such as 'overturns'")
    if len(set(states)) < len(states):
        raise InputError(f"limit_states=: one is there twice: {', '.join(s.name for s in states)}")
    return states
