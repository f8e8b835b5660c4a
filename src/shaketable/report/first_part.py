"""The two pages that are signed: what first, room by room, how sure."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from markupsafe import Markup

from shaketable.assess import (
    LEADING,
    Assessment,
    ItemResult,
    Mitigation,
    PlaceFate,
    Share,
    alike,
    fate_of,
)
from shaketable.building import Building
from shaketable.inventory import BaseShape
from shaketable.language import tell
from shaketable.report.sketches import sketch
from shaketable.report.words import advice, carried, findings, headline, mitigation, numbers

MOST_LISTED = 90  # things room by room: more are in the annex and results.csv
MOST_PLACES = 40


class Row(NamedTuple):
    """One of the things to see to first."""

    name: str
    where: str
    share: Share
    risk: str
    told: str  # what the share is, in words
    class_: str
    measure: str
    outcome: str
    takes: str
    who: str
    instead: str  # what anybody may do in its place
    holds: bool  # whether it takes something that bears a force
    sketch: Markup


class Thing(NamedTuple):
    """A thing in the list of its room."""

    name: str
    quantity: int
    share: str
    measure: str


class Place(NamedTuple):
    """A room, or a floor."""

    name: str
    told: str  # how many of its pieces fall, and roll far
    things: Sequence[Thing]


def rows(assessment: Assessment, ranked: Sequence[ItemResult]) -> list[Row]:
    """What to do first: a row for each kind of thing, where it is worst."""
    kinds: dict[object, ItemResult] = {}
    for each in ranked:
        kinds.setdefault(alike(each.item), each)
    return [_row(each, assessment) for each in list(kinds.values())[:LEADING]]


def _row(result: ItemResult, assessment: Assessment) -> Row:
    item, premises = result.item, assessment.premises
    best = result.helpful[0] if result.helpful else None
    said = advice.first_measure(result, premises)
    follows = best is not None and said == mitigation.short(best, item, premises)
    return Row(
        name=item.name,
        where=where(result, assessment),
        share=_bar_of(result),
        risk=result.risk,
        told=_told(result),
        class_=findings.risk_in_words(result),
        measure=said[:1].upper() + said[1:],
        outcome=mitigation.outcome(best, result) if best and follows else "",
        takes=mitigation.with_what(best, result) if best and follows else "",
        who=mitigation.who(best, result, premises) if best and follows else "",
        instead=_instead(best, result, assessment) if best and follows else "",
        holds=bool(best and follows and best.force),
        sketch=sketch(best.kind, item.shape is BaseShape.CYLINDER)
        if best and follows
        else Markup(),
    )


def _bar_of(result: ItemResult) -> Share:
    """What the bar of an object shows: without an interval where it stands on furniture."""
    share = result.governing_share
    return share._replace(low=share.value, high=share.value) if result.item.stands_on else share


def _instead(best: Mitigation, result: ItemResult, assessment: Assessment) -> str:
    """What anybody may do where the best measure needs a craftsman, and leaves less than half."""
    premises, item = assessment.premises, result.item
    easy = mitigation.who(best, result, premises)
    for each in result.helpful[1:]:
        easier = mitigation.who(each, result, premises) != easy and mitigation.by_anybody(each)
        if easier and result.halved_by(each):
            measure = mitigation.short(each, item, premises)
            left = mitigation.outcome(each, result)
            return tell("or {measure}: {outcome}", measure=measure, outcome=left)
    return ""


def where(result: ItemResult, assessment: Assessment) -> str:
    """How many there are, on which floor and in which room."""
    item = result.item
    floor = headline.floor_name(item.floor) if item.floor and assessment.in_building else ""
    parts = (f"{item.quantity} ×", floor, item.location)
    return " · ".join(part for part in parts if part)


def _told(result: ItemResult) -> str:
    """The share in words, and beside it that against a wall."""
    return _of_shakings(result) + _at_a_wall(result)


def _at_a_wall(result: ItemResult) -> str:
    """The number against a wall beside that of an object that stands free, where it was tried."""
    walled = result.at_a_wall
    if walled is None or result.as_it_stands:
        return ""
    return tell("; {often} against a wall", often=numbers.in_hundred_short(walled.value))


def _of_shakings(result: ItemResult) -> str:
    """Of falls, of what is held up alone too, or of going far."""
    often = carried.often(result)
    if result.item.stands_on:
        said = tell("as if it stood on the floor it falls in {often} of 100", often=often)
        return f"{carried.first_sentence()} {said}"
    if result.governing_share == result.overturns:
        return tell("falls in {often} of 100", often=often)
    if result.item.rolls:
        return tell("falls or rolls far in {often} of 100", often=often)
    if result.solid and result.solid.surrounded:
        return tell("falls, or only its wall or strap holds it up, in {often} of 100", often=often)
    return tell("falls or leaves its support in {often} of 100", often=often)


def places(assessment: Assessment, building: Building | None) -> list[Place]:
    """Rooms, the one of which most falls first; in a building its floors, from the top down."""
    found: dict[str, list[ItemResult]] = {}
    if building is not None:
        here = {floor.floor: assessment.ranked(floor) for floor in assessment.floors}
        found = {
            label: list(here[label]) for label in reversed(list(building.floors)) if label in here
        }
    else:
        for result in assessment.ranked():
            found.setdefault(result.item.location or tell("no room given"), []).append(result)
    fates = [(label, fate_of(results), results) for label, results in found.items()]
    if building is None:
        fates.sort(key=lambda each: each[1].falls.value, reverse=True)
    left = MOST_LISTED
    listed = []
    for label, fate, results in fates[:MOST_PLACES]:
        things = [_thing(each, assessment, building is not None) for each in results[:left]]
        left -= len(things)
        listed.append(
            Place(
                name=headline.floor_name(label) if building is not None else label,
                told=_of_pieces(fate),
                things=things,
            )
        )
    return listed


def _of_pieces(fate: PlaceFate) -> str:
    """How many pieces of a place fall, and roll far; "" without any."""
    if not fate.pieces:
        return ""
    falls = numbers.of_pieces(fate.falls, fate.pieces)
    if not fate.rolls_far.value > 0.0:
        return tell(
            "{falls} of {pieces} pieces fall on average",
            pieces=fate.pieces,
            falls=falls,
        )
    return tell(
        "{falls} of {pieces} pieces fall on average, and {far} roll far",
        pieces=fate.pieces,
        falls=falls,
        far=numbers.of_pieces(fate.rolls_far, fate.pieces),
    )


def _thing(result: ItemResult, assessment: Assessment, in_building: bool) -> Thing:
    item = result.item
    room = f" ({item.location})" if in_building and item.location else ""
    return Thing(
        name=f"{item.name}{room}",
        quantity=item.quantity,
        share=carried.often(result),
        measure=advice.first_measure(result, assessment.premises),
    )
