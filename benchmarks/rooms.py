"""How long a room takes, and how that grows with its things.

python -m benchmarks.rooms             the example room, and rooms of two and six of it in a row
python -m benchmarks.rooms 1 3         so many of it

Each room is assessed under the default suite, and every single change of it is tried.
"""

from __future__ import annotations

import sys
import time
from dataclasses import replace
from pathlib import Path

from shaketable.records import DEFAULT_SUITE, suite
from shaketable.rooms import Room, assess_room, design_room, read_room

EXAMPLE = Path(__file__).parents[1] / "examples" / "hospital_room.toml"
COUNTS = (1, 2, 6)
ON_THE_PAGE = (0.5,)  # the other frictions that the page tries


def in_a_row(room: Room, count: int) -> Room:
    """A rectangular room, so many times beside itself, without walls between."""
    length, height = (max(axis) for axis in zip(*room.outline, strict=True))

    def at(place: tuple[float, float], k: int) -> tuple[float, float]:
        return place[0] + k * length, place[1]

    things, places, doors = [], [], []
    for k in range(count):
        for thing in room.things:
            body = replace(thing.item.body, name=f"{thing.name} {k + 1}")
            item = replace(thing.item, body=body)
            things.append(replace(thing, item=item, at=at(thing.at, k)))
        places += [replace(p, name=f"{p.name} {k + 1}", at=at(p.at, k)) for p in room.places]
        doors += [replace(d, name=f"{d.name} {k + 1}", at=at(d.at, k)) for d in room.doors]
    far = count * length
    return replace(
        room, outline=((0.0, 0.0), (far, 0.0), (far, height), (0.0, height)),
        things=tuple(things), places=tuple(places), doors=tuple(doors),
    )  # fmt: skip


def main() -> None:
    """Print a line for each room."""
    motions = [m for m in suite(DEFAULT_SUITE, pairs=True) if m.transverse is not None]
    example = read_room(EXAMPLE)
    assess_room(example, motions[:2], progress=False)  # compiled, or read from the cache
    for count in map(int, sys.argv[1:] or COUNTS):
        room = in_a_row(example, count)
        begin = time.perf_counter()
        found = assess_room(room, motions, progress=False)
        assessed = time.perf_counter() - begin
        begin = time.perf_counter()
        assess_room(room, motions, turns=1, frictions=ON_THE_PAGE, progress=False)
        on_page = time.perf_counter() - begin
        begin = time.perf_counter()
        design = design_room(room, motions, progress=False)
        designed = time.perf_counter() - begin
        changes = len(design.singles)
        print(
            f"{len(room.things)} things, {found.runs} runs each: assessed in {assessed:.1f} s, "
            f"as on the page in {on_page:.1f} s; "
            f"{changes} changes tried in {designed:.1f} s, {1e3 * designed / changes:.0f} ms each",
            flush=True,
        )


if __name__ == "__main__":
    main()
