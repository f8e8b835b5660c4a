"""What falls where in a room, whom it hits, and whether the ways out stay free."""

from __future__ import annotations

from collections.abc import Sequence

from shaketable.assess import CastorFriction
from shaketable.assess.frictions import FRICTIONS
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.rooms.frictions import leading, with_other_frictions
from shaketable.rooms.grid import CELL
from shaketable.rooms.prepared import prepare
from shaketable.rooms.results import RoomAssessment
from shaketable.rooms.room import Room
from shaketable.tilting import TURNS


def assess_room(
    room: Room,
    motions: Sequence[Motion] | None = None,
    *,
    scale: float = 1.0,
    model: Model | str | None = None,
    castors: CastorFriction | None = None,
    frictions: Sequence[float] = FRICTIONS,
    turns: int = TURNS,
    cell: float = CELL,
    progress: Progress = True,
) -> RoomAssessment:
    """Shake a room: all its things together, by both horizontal components at once.

    Args:
        room: such as `read_room(path)` gives.
        motions: with both components; the default suite if None. Those of a floor are those of
            `Building.floors`.
        scale: factor on all motions.
        model, castors, progress: as for `assess`.
        frictions: others that are tried, with each motion in one of the ways; of each thing, place
            and way the worst is told.
        turns: in how many directions each motion shakes the room, where north or a motion's azimuth
            is not known.
        cell: side of the cells of the plan [m].

    Raises:
        InputError: a plan with faults, nothing to shake, or motions without their second
            components.
    """
    prepared = prepare(
        room, motions, scale=scale, model=model, castors=castors, turns=turns, cell=cell,
        progress=progress,
    )  # fmt: skip
    return leading(with_other_frictions(prepared, frictions, progress))
