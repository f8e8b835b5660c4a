"""What a worker does with a room: read it, shake it once, and assess it."""

from __future__ import annotations

import math
import re
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from shaketable.engine.pool import at_most
from shaketable.errors import Fault, InputError
from shaketable.inventory import BaseShape
from shaketable.language import LANGUAGES, Language, speaking, tell
from shaketable.outcome import Outcome
from shaketable.report.run_log import RunLog
from shaketable.report.words import room as words
from shaketable.rooms import (
    Room,
    RoomAssessment,
    RoomDesign,
    ThingResult,
    faults_of,
    read_room,
    shake_once,
)
from shaketable.rooms.design import designed, require_places
from shaketable.rooms.frictions import leading, with_other_frictions
from shaketable.rooms.grid import CELL
from shaketable.rooms.once import ThingShaken
from shaketable.rooms.plain import plain
from shaketable.rooms.prepared import prepare
from shaketable.rooms.shapes import turned
from shaketable.toml_file import TomlFile
from shaketable.units import degrees, radians
from shaketable.web.budget import check
from shaketable.web.job_files import RESULTS, Watch
from shaketable.web.limits import MOST_ROOM_SIDE, MOST_THINGS, ROOM_CORES
from shaketable.web.room_answers import (
    AssessRoom,
    ChangeFound,
    PlaceFound,
    RoomAssessed,
    RoomFault,
    RoomFilm,
    RoomRead,
    ShakeRoom,
    ThingFound,
    ThingFrames,
    WayFound,
    WorstOfRoom,
)
from shaketable.web.shaking import ground_of, moved_ground, pair_of, pairs_of
from shaketable.web.uploads import Upload
from shaketable.web.work import in_hundreds, pictures

FULL_RATE, EVERY = 60.0, 2  # pictures a second of one thing, and every so many of them
MOST_POSES = 30_000  # of all things of a film: some 3 MB
FRICTIONS = (0.5,)  # that is tried beside none that slides: most floors
MOVES = 1e-3  # m, and of a quaternion: what never moves by more is drawn where it stands
SECTIONS = ("door", "place", "thing")


def understand(name: str, data: bytes, language: Language = "en") -> RoomRead:
    """A room as it was read, with all that is wrong with it, told in a language."""
    with speaking(language), tempfile.TemporaryDirectory(prefix="shaketable-") as folder:
        upload = Upload.written(Path(folder), name, data)
        with RunLog(shown=upload.fault) as log:
            try:
                file = TomlFile(upload.path)
                _require_small(file.table)
            except InputError as error:
                raise upload.refusal(error) from None
            room = None
            try:
                room = read_room(upload.path, check=False)
            except InputError as error:
                text = data.decode("utf-8-sig")
                faults = [_fault(upload.fault(each), text) for each in error.listed]
            else:
                _require_size(room)
                faults = [
                    RoomFault(
                        text=f"{each.where}: {each.on_page or each.text}",
                        name=each.where,
                        at_m=each.at,
                    )
                    for each in faults_of(room)
                ]
        notes = [each.removeprefix(f"WARNING: {name}: ") for each in log.messages]
        return RoomRead(room=plain(file.table, room), faults=faults, notes=notes)


def _fault(fault: Fault, text: str) -> RoomFault:
    """A fault of the file, with the table in which its line stands."""
    said = f"{fault.column}: {fault.text}" if fault.column else fault.text
    line = re.fullmatch(r"line (\d+)", fault.where)
    before = text.splitlines()[: int(line[1])] if line else []
    heads = [found[1] for each in before if (found := re.match(r"\s*\[\[\s*(\w+)\s*\]\]", each))]
    if not heads or heads[-1] not in SECTIONS:
        return RoomFault(text=said, name="")
    return RoomFault(text=said, name="", section=heads[-1], number=heads.count(heads[-1]) - 1)


def shake(asked: ShakeRoom) -> RoomFilm:
    """A room under one motion, with its film."""
    motion = pair_of(asked.shaking).scaled(asked.scale)
    if asked.reverse:
        motion = motion.reversed()
    if motion.transverse is None:  # a pulse, or a record of one component
        motion = motion.rotated(0.0)
    room, _ = _room(asked.text)
    along = None if asked.along_deg is None else radians(asked.along_deg)
    found = shake_once(room, motion, along=along, friction=asked.friction, each=check)
    end = max((float(each.response.time[-1]) for each in found.things), default=0.0)
    at = pictures(end, motion.duration)
    every = max(EVERY, math.ceil(at.size * len(found.things) / MOST_POSES))
    at = at[::every]
    ground = [moved_ground(motion, at, transverse) for transverse in (False, True)]
    in_plan = turned(np.column_stack(ground), found.along)
    shaken = {each.thing.name for each in found.things}
    return RoomFilm(
        ground=ground_of(motion),
        rate_hz=FULL_RATE / every,
        pictures=at.size,
        ground_m=_rows(in_plan),
        things=[_frames(each, at) for each in found.things],
        left_out=[each.name for each in room.things if each.name not in shaken],
    )


def _frames(shaken: ThingShaken, at: np.ndarray) -> ThingFrames:
    run, item = shaken.response, shaken.thing.item
    across = item.sideways or item.body
    step = at[1] - at[0] if at.size > 1 else 0.0
    position, quaternion = shaken.poses(at[at <= run.time[-1] + step])
    fell = run.outcome is not Outcome.STANDING
    left = np.abs(np.column_stack([position - position[-1], quaternion - quaternion[-1]]))
    moving = np.flatnonzero(left.max(axis=1) > MOVES)  # it is drawn until it stays where it is
    kept = slice(0, int(moving[-1]) + 2 if moving.size else 1)
    return ThingFrames(
        name=shaken.thing.name,
        outcome="falls" if fell else "held_up" if run.held_up else "stands",
        time_s=run.overturning_time if fell else None,
        base_m=(-item.body.left, item.body.right, -across.right, across.left),
        below_m=item.body.cg_height,
        height_m=item.height,
        round=item.shape is BaseShape.CYLINDER,
        position_m=_rows(position[kept]),
        quaternion=_rows(quaternion[kept]),
    )


def assess_room(asked: AssessRoom, folder: str, language: Language = "en") -> None:
    """Assess a room; progress and results, in all languages, are files of the folder.

    Args:
        asked: the room, and by what it is shaken.
        folder: of this assessment.
        language: of the errors.
    """
    place, watch = Path(folder), Watch(Path(folder))
    with at_most(ROOM_CORES):
        with speaking(language):
            room, notes = _room(asked.text)
            if asked.changes:
                require_places(room)
            prepared = prepare(
                room, pairs_of(asked.suite), scale=asked.scale, model=None, castors=None, turns=1,
                cell=CELL, progress=watch, each=check,
            )  # fmt: skip
        shaken = with_other_frictions(prepared, FRICTIONS, watch)
        design = designed(shaken, watch) if asked.changes else None
        found = design.as_it_is if design else leading(shaken)
    for each in LANGUAGES:
        with speaking(each):
            told = _told(found, design, notes).model_dump_json()
        (place / RESULTS[each]).write_text(told, encoding="utf-8")


def _told(found: RoomAssessment, design: RoomDesign | None, notes: list[str]) -> RoomAssessed:
    """What was found, in the language that is spoken."""
    grid = found.grid
    covered = found.covered.ravel()
    some = np.flatnonzero(covered)
    return RoomAssessed(
        notes=notes,
        summary=[
            *words.summary(found), words.frictions([found]),
            *([words.tried_with(design)] if design else []),
        ],
        not_considered=words.not_considered(found),
        runs=found.runs,
        recordings=found.recordings,
        low_m=(float(grid.x[0] - grid.cell / 2), float(grid.y[0] - grid.cell / 2)),
        cell_m=grid.cell,
        columns=grid.x.size,
        rows=grid.y.size,
        covered=list(zip(some.tolist(), np.round(covered[some], 4).tolist(), strict=True)),
        things=[
            ThingFound(
                name=each.name, falls=in_hundreds(each.falls), held_up=in_hundreds(each.held_up),
                held_up_at_friction=words.at_friction(each.friction_held_up, found),
                sides=_sides(each), share=each.falls.value, high=each.falls.high,
                at_friction=words.at_friction(each.friction, found), covers_m2=each.covers,
            )
            for each in found.things
        ],
        places=[
            PlaceFound(
                name=each.place.name, hit=in_hundreds(each.hit), high=each.hit.high,
                at_friction=words.at_friction(each.friction, found),
                by=words.by_what(each.by), people=each.place.people, people_hit=each.hits,
            )
            for each in found.places
        ],
        ways=[
            WayFound(
                place=way.place, door=way.exit, to=words.exit_of(way),
                closed=in_hundreds(way.closed), high=way.closed.high, by=words.by_what(way.by),
                open_before=way.open_before, at_friction=words.at_friction(way.friction, found),
            )
            for way in found.ways
        ],
        changes=[_change(each, design) for each in design.singles] if design else [],
        worst=WorstOfRoom(
            name=found.worst.motion, reverse=found.worst.reversed, falls=found.worst.falls,
            along_deg=degrees(found.worst.along),
            friction=None if math.isinf(found.worst.friction) else found.worst.friction,
        ),
        pairs=[_change(each, design) for each in design.pairs[:3]] if design else [],
    )  # fmt: skip


def _sides(thing: ThingResult) -> tuple[float, float, float, float]:
    forward, backward, left, right = (
        thing.falls.value * share if thing.falls.value else 0.0 for share in thing.sides
    )
    return forward, backward, left, right


def _change(one: Any, design: RoomDesign) -> ChangeFound:
    return ChangeFound(
        told=words.tried(one),
        left=words.left_after(one, design),
        saves=one.saves,
        things=[each.thing for each in one.changes],
    )


def _room(text: str) -> tuple[Room, list[str]]:
    """The room of a question, and what reading it warns of."""
    with tempfile.TemporaryDirectory(prefix="shaketable-") as folder:
        upload = Upload.written(Path(folder), "room.toml", text.encode())
        with RunLog(shown=upload.fault) as log:
            try:
                _require_small(TomlFile(upload.path).table)
                room = read_room(upload.path)
            except InputError as error:
                raise upload.refusal(error) from None
    _require_size(room)
    return room, log.messages


def _require_small(table: Mapping[str, Any]) -> None:
    """InputError where a room has more than a page takes."""
    for name in (*SECTIONS, "outline_m"):
        found = table.get(name, [])
        if isinstance(found, list) and len(found) > MOST_THINGS:
            raise InputError(
                tell(
                    "{name}: {count:,} are given; at most {most} are taken here",
                    name=name,
                    count=len(found),
                    most=MOST_THINGS,
                )
            )


def _require_size(room: Room) -> None:
    """InputError where a room is larger than a page takes."""
    side = float(np.ptp(np.array(room.outline), axis=0).max())
    if side > MOST_ROOM_SIDE:
        raise InputError(
            tell(
                "the room is {side:.0f} m long; at most {most:g} m are taken here",
                side=side,
                most=MOST_ROOM_SIDE,
            )
        )


def _rows(values: np.ndarray) -> list[tuple[float, ...]]:
    return [tuple(row) for row in np.round(values, 4).tolist()]
