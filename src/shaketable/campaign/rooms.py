"""The assessment of many rooms, one in each block."""

from __future__ import annotations

import json
import time
import zlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any, ClassVar

from shaketable.assess import CastorFriction
from shaketable.campaign.as_json import KINDS, from_json, to_json
from shaketable.campaign.fingerprint import environment, motion_hash, thing_hash
from shaketable.campaign.motions import StoredMotions
from shaketable.campaign.notes import whole_notes
from shaketable.campaign.objects import Objects
from shaketable.campaign.work import RESULTS, BlockResult
from shaketable.errors import InputError, SimulationError
from shaketable.language import Language, speaking
from shaketable.lazy_motions import heads_of
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.rooms import results
from shaketable.rooms.assessment import assess_room
from shaketable.rooms.grid import Grid
from shaketable.rooms.room import Door, Hinge, Place, PlaceKind, Room, Swing, Thing
from shaketable.simulate.kinds import CPU

ROOM = 500_000  # bytes of the results of a room before compression, rather more

#: Everything that the store of rooms keeps as JSON.
ROOM_KINDS: dict[str, type] = KINDS | {
    kind.__name__: kind
    for kind in (
        CastorFriction, Door, Grid, Hinge, Place, PlaceKind, Room, Swing, Thing,
        results.PlaceResult, results.RoomAssessment, results.ThingResult, results.WayResult,
        results.WorstShaking,
    )
}  # fmt: skip


@dataclass(frozen=True, kw_only=True, eq=False)
class Rooms:
    """A `Work` that assesses rooms.

    Attributes:
        rooms: each with a name of its own.
        motions: with both components, those of all floors one after another.
        parts: which of them shake each room: the first, and the one behind the last.
        scale, model, castors, frictions, turns: as for `assess_room`.
        language: in which it is told why a room cannot be shaken.
    """

    rooms: Sequence[Room]
    motions: Sequence[Motion]
    parts: Sequence[tuple[int, int]]
    scale: float
    model: Model
    castors: CastorFriction
    frictions: Sequence[float]
    turns: int
    language: Language = "en"

    kind: ClassVar[str] = "rooms"
    counted: ClassVar[str] = "rooms"
    chunks: ClassVar[int] = 1
    device: ClassVar[str] = CPU

    @property
    def blocks(self) -> int:
        return len(self.rooms)

    @property
    def size(self) -> int:
        return ROOM * len(self.rooms)

    @property
    def named(self) -> Mapping[str, Sequence[Any]]:
        return {"rooms": self.rooms, "motions": heads_of(self.motions)}

    @property
    def total(self) -> int:
        return len(self.rooms)

    def count(self, number: int) -> int:
        return 1

    def longest_first(self) -> list[int]:
        return sorted(range(self.blocks), key=lambda k: -len(self.rooms[k].things))

    @staticmethod
    def environment() -> dict[str, str]:
        """The code and the versions here, on which the results depend."""
        return environment("**/*.py") | {name: version(name) for name in ("scipy", "shapely")}

    def fingerprint(self) -> dict[str, Any]:
        return {
            "environment": self.environment(),
            "rooms": [thing_hash(room) for room in self.rooms],
            "motions": [motion_hash(motion) for motion in self.motions],
            "azimuths": [head.origin and head.origin.azimuth for head in heads_of(self.motions)],
            "parts": [list(part) for part in self.parts],
            "scale": self.scale,
            "model": repr(self.model),
            "castors": repr(self.castors),
            "frictions": list(self.frictions),
            "turns": self.turns,
        }

    def parts_of(self, number: int, made: Mapping[str, Any]) -> dict[str, Any]:
        first, end = made["parts"][number]
        return {
            "rooms": made["rooms"][number],
            "motions": made["motions"][first:end],
            "azimuths": made["azimuths"][first:end],
            "parts": number,
        }

    def told(self) -> dict[str, Any]:
        return {
            "rooms": [to_json(room) for room in self.rooms],
            "parts": [list(part) for part in self.parts],
            "scale": self.scale,
            "model": to_json(self.model),
            "castors": to_json(self.castors),
            "frictions": list(self.frictions),
            "turns": self.turns,
            "language": self.language,
        }

    @classmethod
    def load(cls, told: Mapping[str, Any], motions: StoredMotions, check: bool) -> Rooms:
        """Rebuild the work from what `told` said and the stored motions.

        Raises:
            KeyError, TypeError, ValueError, AttributeError: something of it is damaged.
        """
        rooms = [from_json(one, ROOM_KINDS) for one in told["rooms"]]
        if check and [thing_hash(room) for room in rooms] != told["fingerprint"]["rooms"]:
            raise ValueError("its rooms are not those that it was begun with")
        return cls(
            rooms=rooms,
            motions=motions,
            parts=[(first, end) for first, end in told["parts"]],
            scale=told["scale"],
            model=from_json(told["model"]),
            castors=from_json(told["castors"], ROOM_KINDS),
            frictions=told["frictions"],
            turns=told["turns"],
            language=told["language"],
        )

    def create(self, objects: Objects) -> None:
        """Nothing must be there before."""

    def is_there(self, objects: Objects) -> bool:
        return True

    def opened(self, objects: Objects) -> None:
        """Nothing is held open."""

    def assessed(self, number: int) -> results.RoomAssessment | str:
        """What becomes of a room, or why it cannot be shaken: the others are told nevertheless."""
        with speaking(self.language):
            try:
                return assess_room(
                    self.rooms[number], self.motions[slice(*self.parts[number])],
                    scale=self.scale, model=self.model, castors=self.castors,
                    frictions=self.frictions, turns=self.turns, progress=False,
                )  # fmt: skip
            except InputError as error:
                return str(error)

    def do(self, number: int, progress: Progress) -> BlockResult:
        found = self.assessed(number)
        if callable(progress):
            progress(1)
        return BlockResult(to_json(found), 1, {})

    def write(self, number: int, values: Any, kept: None, objects: Objects) -> dict[str, list[int]]:
        content = zlib.compress(json.dumps(values).encode())
        objects.put(_name(number), content)
        return {_name(number): [len(content), zlib.crc32(content)]}

    def warn(self, notes: Iterable[Mapping[str, Any]]) -> None:
        """What is odd about a room is in its result."""

    def sample(self) -> tuple[int, float]:
        """The first room is assessed, after it was assessed once to compile."""
        self.assessed(0)
        start = time.perf_counter()
        self.assessed(0)
        return 1, time.perf_counter() - start


def read_rooms(work: Rooms, objects: Objects) -> list[results.RoomAssessment | str]:
    """What becomes of each room, as of `Rooms.assessed`.

    Why a room cannot be shaken is found again, so that it is told in the language that is spoken.

    Raises:
        InputError: it is not done.
        SimulationError: something is damaged.
    """
    whole_notes(work, objects)
    found = []
    for number in range(work.blocks):
        content = objects.get(_name(number))
        if content is None:
            raise SimulationError(f"{objects.place}: {_name(number)} is gone")
        told = from_json(json.loads(zlib.decompress(content)), ROOM_KINDS)
        found.append(work.assessed(number) if isinstance(told, str) else told)
    return found


def _name(number: int) -> str:
    return f"{RESULTS}/rooms/{number:08d}.json.z"
