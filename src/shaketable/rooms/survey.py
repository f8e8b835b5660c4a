"""Many rooms that were shaken: in which the way out closes, and where people are hit."""

from __future__ import annotations

from dataclasses import dataclass

from shaketable.rooms.results import PlaceResult, RoomAssessment, WayResult
from shaketable.rooms.room import Room


@dataclass(frozen=True, eq=False)
class RoomSurvey:
    """Rooms that were shaken.

    Attributes:
        rooms: what becomes of each, in the order in which they were given.
        refused: rooms that cannot be shaken, such as empty ones, each with the reason.
    """

    rooms: tuple[RoomAssessment, ...]
    refused: tuple[tuple[Room, str], ...] = ()

    def closing(self, limit: float) -> list[RoomAssessment]:
        """The rooms of which a way out closes in more than a share of the runs, the worst first.

        What the recordings cannot exclude is not counted here: `worst_way(...).closed.high` tells.
        """
        worst = [(worst_way(room), room) for room in self.rooms]
        found = [(way, room) for way, room in worst if way and closed_share(way) > limit]
        return [room for _, room in sorted(found, key=lambda each: -closed_share(each[0]))]


def worst_way(found: RoomAssessment) -> WayResult | None:
    """The way to any exit that is closed most often; None where no way begins.

    One that is closed before anything is shaken is always closed.
    """
    doors = {way.exit for way in found.ways}
    last = [way for way in found.ways if not way.exit or len(doors) == 1]
    return max(last, key=lambda way: (closed_share(way), way.closed.high), default=None)


def closed_share(way: WayResult) -> float:
    """In what share of the runs a way is closed."""
    return way.closed.value if way.open_before else 1.0


def worst_hit(found: RoomAssessment) -> PlaceResult | None:
    """The place on which something falls most often; None where there are no places."""
    return max(found.places, key=lambda each: (each.hit.value, each.hit.high), default=None)
