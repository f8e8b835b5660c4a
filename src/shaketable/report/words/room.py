"""A shaken room in words: its things, places and ways, and what can be changed in it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from shaketable.assess.results import MitigationKind
from shaketable.errors import named
from shaketable.language import listed, number, tell
from shaketable.report.words.numbers import (
    counted,
    in_hundred,
    in_hundred_short,
    likely,
    limits_in_hundred,
    with_interval,
)

if TYPE_CHECKING:
    from shaketable.assess import Share
    from shaketable.rooms import (
        RoomAssessment,
        RoomDesign,
        RoomSurvey,
        Thing,
        Tried,
        WayResult,
    )
    from shaketable.rooms.changes import Change

MOST_TOLD = 12  # changes on the terminal
MOST_NAMED = 3  # of what closes a way, or falls on a place


def summary(found: RoomAssessment) -> list[str]:
    """What matters most, in a few sentences: ways, places, things, and what is not known."""
    said = [
        tell(
            "{runs:,} shakings by {recordings} independent recordings.",
            runs=found.runs,
            recordings=found.recordings,
        )
    ]
    closed = [way for way in found.ways if not way.open_before]
    said += [
        tell(
            "The way from {place} to {to} is too narrow before anything is shaken.",
            place=way.place,
            to=exit_of(way),
        )
        for way in closed
    ]
    ways = [way for way in found.ways if way.open_before]
    if ways:
        worst = max(ways, key=lambda way: (way.closed.high, way.closed.value))
        said.append(
            tell(
                "The way from {place} to {to} is closed in {share} of 100 shakings, {likely}{by}.",
                place=worst.place,
                to=exit_of(worst),
                share=in_hundred(worst.closed.value),
                likely=likely(worst.closed) + at_friction(worst.friction, found),
                by=_mostly(worst.by),
            )
        )
    said += no_ways(found)
    for place in sorted(found.places, key=lambda each: -each.hit.high)[:1]:
        said.append(
            tell(
                "Something falls on {place} in {share} of 100, {likely}{by}.",
                place=place.place.name,
                share=in_hundred(place.hit.value),
                likely=likely(place.hit) + at_friction(place.friction, found),
                by=_mostly(place.by),
            )
        )
    for thing in sorted(found.things, key=lambda each: -each.falls.high)[:1]:
        said.append(
            tell(
                "What falls most often is {thing}: in {share} of 100, {likely}.",
                thing=thing.name,
                share=in_hundred(thing.falls.value),
                likely=likely(thing.falls) + at_friction(thing.friction, found),
            )
        )
    kept = {thing.name for thing in found.room.things if thing.item.must_not_fall}
    said += [
        tell(
            "{thing} must not fall: it falls in {share} of 100, {likely}.",
            thing=thing.name,
            share=in_hundred(thing.falls.value),
            likely=likely(thing.falls) + at_friction(thing.friction, found),
        )
        for thing in found.things
        if thing.name in kept
    ]
    return said + not_known(found)


def no_ways(found: RoomAssessment) -> list[str]:
    """That no way was looked at, if none was."""
    if found.ways:
        return []
    return [tell("No ways were looked at: the room has no beds or desks.")]


def not_known(found: RoomAssessment) -> list[str]:
    """The things that were not simulated, and why."""
    return [
        tell(
            "{name}: {reason}. It is drawn and not simulated: nobody knows that it is safe.",
            name=thing.name,
            reason=why_not(thing),
        )
        for thing in found.left_out
    ]


def why_not(thing: Thing) -> str:
    """Why a thing is not simulated."""
    if thing.on or thing.item.stands_on:
        other = thing.on or thing.item.stands_on
        return tell("stands on {other}, which may itself rock", other=other)
    if thing.item.anchored:
        return tell("is anchored")
    if thing.item.hangs:
        return tell("hangs or is fixed, as its name or note says")
    return tell("its depth or width is not known")


def at_friction(friction: float, found: RoomAssessment) -> str:
    """With which friction something was found, where it is not the room's own."""
    if friction == found.friction:
        return ""
    return tell(", with friction {friction:g}", friction=friction)


def often(share: Share, friction: float, found: RoomAssessment) -> str:
    """A share in a table: "25 (12–47), with friction 0.5"."""
    return with_interval(share) + at_friction(friction, found)


def frictions(rooms: Sequence[RoomAssessment]) -> str:
    """Which frictions were tried, in all rooms the same, and which are told."""
    found = rooms[0]
    own = tell("Nothing on feet can slide here.")
    if math.isfinite(found.friction):
        own = tell("The friction is {friction:g}.", friction=found.friction)
    if not found.tried:
        return own
    tried = tell(
        "Beside that frictions of {tried} were tried, with one shaking of each recording.",
        tried=listed([number(each, "g") for each in found.tried]),
    )
    if all(room.frictions == {found.friction} for room in rooms):
        return f"{own} {tried} " + tell("With none of them does more happen.")
    told = tell("Where more happens with one of them, that is told, and the friction named.")
    return f"{own} {tried} {told}"


def not_considered(found: RoomAssessment) -> list[str]:
    """What a shaken room leaves out."""
    slides = tell("Frictions that differ from thing to thing, and others than those named.")
    if not found.tried:
        slides = tell("Other frictions: with more or less a thing may fall more often.")
    return [
        slides,
        tell("Things that push or hit each other: each moves as if the others were not there."),
        tell("Doors as openings: a thing meets a closed door like a wall."),
        tell("Uncertain sizes and contents."),
        tell("Damage of walls, ceilings, pipes and windows, and what falls from them."),
        tell("People who are hit by what slides or rolls without falling."),
        tell("People who move away, or who move things away."),
    ]


def exit_of(way: WayResult) -> str:
    """The door to which a way goes."""
    return way.exit or tell("any exit")


def shares(found: RoomAssessment) -> list[str]:
    """Every share, in lines for the terminal."""
    said = [
        tell(
            "{room}: {runs:,} shakings by {recordings} independent recordings; of 100, with 95 % "
            "intervals:",
            room=found.room.name,
            runs=found.runs,
            recordings=found.recordings,
        )
    ]
    said += [
        tell(
            "  {thing} falls in {share}",
            thing=each.name,
            share=often(each.falls, each.friction, found),
        )
        for each in found.things
    ]
    said += [
        tell(
            "  something falls on {place} in {share}",
            place=each.place.name,
            share=often(each.hit, each.friction, found),
        )
        for each in found.places
    ]
    said += [
        tell(
            "  the way from {place} to {to} is closed in {share}",
            place=way.place,
            to=exit_of(way),
            share=closed(way, found),
        )
        for way in found.ways
    ]
    return said + [f"  {line}" for line in (*no_ways(found), *not_known(found), frictions([found]))]


def savings(name: str, design: RoomDesign) -> list[str]:
    """What the best changes save, in lines for the terminal."""
    now = design.now
    said = [
        tell(
            "{room}: {runs:,} shakings by {recordings} independent recordings; of 100, something "
            "falls on a place in {hit}, and somebody is shut in in {shut}; on an average "
            "{people:.2f} people are hit or shut in",
            room=name,
            runs=design.runs,
            recordings=design.recordings,
            hit=with_interval(now.hit),
            shut=with_interval(now.shut_in),
            people=now.people,
        ),
        tell("What each of {count} changes saves, alone:", count=len(design.singles)),
    ]
    said += [_saving(each, design) for each in design.singles[:MOST_TOLD]]
    more = len(design.singles) - MOST_TOLD
    if more > 0:
        said.append(tell("  ... and {more} more in changes.csv", more=more))
    if design.pairs:
        said += [tell("The best pair:"), _saving(design.pairs[0], design)]
    return [*said, *not_known(design.as_it_is), tried_with(design)]


def tried_with(design: RoomDesign) -> str:
    """With which friction changes were tried."""
    said = tell("Changes were tried with friction {friction:g}.", friction=design.friction)
    if math.isinf(design.friction):
        said = tell("Changes were tried on a floor on which nothing on feet can slide.")
    if not design.as_it_is.tried:
        return said
    return tell("{said} This counts the least favourable floor.", said=said)


def _saving(one: Tried, design: RoomDesign) -> str:
    return tell(
        "  {saves:+.2f} people, {left}  {does}",
        saves=one.saves,
        left=left_after(one, design),
        does=tried(one),
    )


def closing(found: RoomSurvey, limit: float) -> list[str]:
    """The rooms of which a way out closes too often, the worst first, in lines."""
    from shaketable.rooms.survey import worst_way  # Shapely is an extra

    rooms = found.closing(limit)
    said = [
        tell(
            "In {count:,} of {of:,} rooms a way out closes in more than {limit:g} of 100 shakings.",
            count=len(rooms),
            of=len(found.rooms),
            limit=100 * limit,
        )
    ]
    for room in rooms:
        way = worst_way(room)
        assert way is not None
        said.append(
            tell(
                "  {room}: from {place} in {share}",
                room=room.room.name,
                place=way.place,
                share=closed(way, room),
            )
        )
    unsure = [
        room
        for room in found.rooms
        if room not in rooms and (way := worst_way(room)) and way.closed.high > limit
    ]
    if unsure:
        said.append(
            tell(
                "In {count:,} more that cannot be excluded with so few recordings.",
                count=len(unsure),
            )
        )
    none = [room.room.name for room in found.rooms if worst_way(room) is None]
    if none:
        said.append(
            tell(
                "Without a bed or desk, so that no way begins there: {rooms}.",
                rooms=named(none, MOST_TOLD),
            )
        )
    for refused, reason in found.refused:
        said.append(tell("{room}: not shaken: {reason}", room=refused.name, reason=reason))
    left = sum(len(room.left_out) for room in found.rooms)
    if left:
        said.append(
            tell(
                "Not simulated in these rooms: {things}. Nobody knows that they are safe.",
                things=counted(left, "thing"),
            )
        )
    return said


def closed(way: WayResult, found: RoomAssessment) -> str:
    """How often a way is closed, in a table."""
    said = often(way.closed, way.friction, found)
    if way.open_before:
        return said
    return tell("{said}; closed before anything is shaken", said=said)


def total_hits(found: RoomAssessment) -> str:
    """How many people are hit in the whole room."""
    return tell(
        "People are hit where they are when they do not move away: {hits:.2f} of the {people:g} "
        "who are there on an average.",
        hits=found.hits,
        people=sum(each.place.people for each in found.places),
    )


def about_changes(design: RoomDesign | None) -> str:
    """What the list of what to do first is of."""
    if design is None:
        return tell(
            "Nothing was tried yet: `shaketable room design` tries each thing held, lowered, "
            "turned and moved."
        )
    told = tell(
        "{count} changes were tried under the same shakings, each by itself. How often anybody is "
        "hit or shut in is told before and after it, with its 95 % interval.",
        count=len(design.singles),
    )
    told = f"{told} {tried_with(design)}"
    if not any(each.saves > 0.0 for each in design.singles):
        none = tell("None of them saves anybody in these shakings.")
        return f"{told} {none}"
    if not design.pairs:
        return told
    last = tell("The last line is the best pair.")
    return f"{told} {last}"


def by_what(by: Sequence[tuple[str, float]]) -> str:
    """What closes a way or falls on a place, with its share in a hundred; a dash for nothing."""
    told = [f"{name} ({in_hundred_short(share)})" for name, share in by[:MOST_NAMED]]
    more = len(by) - MOST_NAMED
    if more > 0:
        told.append(tell("{more} more", more=more))
    return listed(told) if told else "–"


def _mostly(by: Sequence[tuple[str, float]]) -> str:
    return tell("; most often by {thing}", thing=by[0][0]) if by else ""


def change(made: Change) -> str:
    """What is done to a thing, without its name."""
    about, kind = made.about, made.kind
    if kind in (MitigationKind.STRAP, MitigationKind.TETHER):
        gap, slack = about["wall_gap_m"], 1000 * about["slack_m"]
        where = tell("a point beside it")
        if not math.isnan(gap):
            where = tell("the wall {gap:.2f} m away", gap=gap)
        return tell(
            "tether it at {height:.2f} m to {where}, with at most {slack:.0f} mm of slack"
            if kind is MitigationKind.TETHER
            else "strap it at {height:.2f} m to {where}, with at most {slack:.0f} mm of slack",
            height=about["height_m"],
            where=where,
            slack=slack,
        )
    if kind is MitigationKind.LOCK:
        return tell("lock its castors (friction {friction:g})", friction=about["friction"])
    if kind is MitigationKind.PAD:
        return tell(
            "put adhesive pads below it, each holding {share:g} of its weight",
            share=about["holds_weights"],
        )
    if kind is MitigationKind.LOWER:
        height = about["cg_height_m"]
        return tell("put heavy things low: its centre of gravity at {height:.2f} m", height=height)
    if "clockwise_deg" in about:
        by = about["clockwise_deg"]
        if abs(by) == 180.0:
            return tell("turn it around")
        if by > 0.0:
            return tell("turn it by {by:g}° clockwise", by=by)
        return tell("turn it by {by:g}° anticlockwise", by=-by)
    far = math.hypot(about["x_m"], about["y_m"])
    way = round(math.atan2(about["y_m"], about["x_m"]) / (math.pi / 2)) % 4
    sides = (tell("to the right"), tell("upward"), tell("to the left"), tell("downward"))
    return tell("move it by {far:g} m {side} on the plan", far=far, side=sides[way])


def tried(one: Tried) -> str:
    """One change or two, with the names of the things."""
    return "; ".join(f"{each.thing}: {change(each)}" for each in one.changes)


def left_after(one: Tried, design: RoomDesign) -> str:
    """What a change leaves: "from 35 to 12 of 100 (4–27)"."""
    low, high = limits_in_hundred(one.left.any)
    return tell(
        "from {before} to {after} of 100 ({low}–{high})",
        before=in_hundred(design.now.any.value),
        after=in_hundred(one.left.any.value),
        low=low,
        high=high,
    )
