"""Measures in words: what is done, what it leaves, with what, and who may do it."""

from __future__ import annotations

import math

from shaketable.assess import (
    ItemResult,
    Mitigation,
    MitigationKind,
    Premises,
    is_worse,
)
from shaketable.inventory import BaseShape, Item
from shaketable.language import number, tell, translated
from shaketable.report.words import straps
from shaketable.report.words.numbers import in_hundred, limits_in_hundred

STRAP, TETHER, LOCK, BASE, PAD, LOWER, WALL, TURN, MOVE, TILT = MitigationKind

#: In a few words, as they stand in a list of what to do first.
SHORT = {
    STRAP: "strap it to the wall",
    TETHER: "tether it",
    LOCK: "lock its castors",
    BASE: "give it a larger base",
    PAD: "put it on adhesive pads",
    LOWER: "take weight down",
    WALL: "push it back to a wall",
    TURN: "turn it by 90°",
    MOVE: "move it to the lowest floor",
    TILT: "tilt it toward a wall",
}
#: Where other words are used.
SHORT_THERE = {
    ("museum", STRAP): "tether it with a thin line",
    ("museum", PAD): "fix it with wax or gel",
    ("museum", LOWER): "weigh it down inside",
    ("museum", BASE): "mount it on a larger plate",
}
ANYBODY, CRAFTSMAN, ENGINEER = "anybody", "a craftsman", "an engineer"
WHO = {
    STRAP: CRAFTSMAN,
    TETHER: CRAFTSMAN,
    LOCK: ANYBODY,
    BASE: CRAFTSMAN,
    PAD: ANYBODY,
    LOWER: ANYBODY,
    WALL: ANYBODY,
    TURN: ANYBODY,
    MOVE: ANYBODY,
    TILT: ENGINEER,
}
#: In a museum nobody else touches what is shown.
CONSERVATOR = "a conservator"


def short(measure: Mitigation, item: Item, premises: Premises) -> str:
    """A measure in a few words."""
    if measure.kind is STRAP and item.shape is BaseShape.CYLINDER and premises.name != "museum":
        return tell("chain it to the wall")
    return translated(SHORT_THERE.get((premises.name, measure.kind), SHORT[measure.kind]))


def who(measure: Mitigation, result: ItemResult, premises: Premises) -> str:
    """Who may do it."""
    if premises.itself:
        return translated(CONSERVATOR)
    asked = straps.to_hold(measure.kind, result)
    if asked and straps.newtons_of(result.item, asked.high) > straps.FIXING:
        return translated(ENGINEER)
    return translated(WHO[measure.kind])


def by_anybody(measure: Mitigation) -> bool:
    """Whether it needs no craftsman."""
    return WHO[measure.kind] == ANYBODY


def with_what(measure: Mitigation, result: ItemResult) -> str:
    """What it takes, with its size, and what straps have to hold."""
    about, item = measure.about, result.item
    asked = straps.to_hold(measure.kind, result)
    if asked:
        strong = straps.strong(item, asked)
        if item.shape is BaseShape.CYLINDER:
            return tell("a chain for each, whose anchors hold {strong}", strong=strong)
        return tell("a strap for each, whose hooks and anchors hold {strong}", strong=strong)
    if measure.kind is BASE and item.shape is BaseShape.CYLINDER:
        return tell("a stand of {size:.2f} m in diameter", size=about["depth_m"])
    if measure.kind is BASE:
        return tell(
            "a plate or feet, {depth:.2f} m deep and {width:.2f} m wide",
            depth=about["depth_m"],
            width=about["width_m"],
        )
    if measure.kind is PAD:
        holds = about["holds_weights"]
        newtons = straps.in_newtons(item, holds) or tell("{share:g} of its weight", share=holds)
        return tell("four pads that hold {newtons} each", newtons=newtons)
    if measure.kind is LOWER:
        height = about["cg_height_m"]
        return tell("its centre of gravity at {height:.2f} m", height=height)
    if measure.kind in (WALL, TILT):
        gap = tell("{gap:.0f} mm from the wall", gap=1e3 * about["wall_gap_m"])
        if measure.kind is WALL:
            return gap
        return tell("{tilt:.1f}°, {gap}", tilt=about["tilt_deg"], gap=gap)
    return "–"


def outcome(measure: Mitigation, result: ItemResult) -> str:
    """What it leaves, as "from 45 to 3 of 100 (0–12)"."""
    left = measure.left
    low, high = limits_in_hundred(left)
    said = tell(
        "from {before} to {after} of 100 ({low}–{high})",
        before=in_hundred(result.before.value),
        after=in_hundred(left.value),
        low=low,
        high=high,
    )
    falls, now = measure.fall.value, result.overturns.value
    if result.item.rolls and (falls or now):
        said = tell(
            "{said}; it falls in {falls} instead of {now}",
            said=said,
            now=in_hundred(now),
            falls=in_hundred(falls),
        )
    if not measure.held_up.value:
        return said
    held = in_hundred(measure.held_up.value)
    if result.item.rolls:
        return tell(
            "{said}; in {often} of 100 only its wall or strap holds it up", said=said, often=held
        )
    return tell(
        "{said}; it falls in {falls}, and only its wall or strap holds it up in {often}",
        said=said,
        falls=in_hundred(falls),
        often=held,
    )


def sentence(measure: Mitigation, result: ItemResult, premises: Premises) -> str:
    """A measure with what it takes, and what it leaves."""
    item = result.item
    done = short(measure, item, premises)
    takes = with_what(measure, result)
    done = done[:1].upper() + done[1:]
    if takes != "–":
        done = tell("{done} ({takes})", done=done, takes=takes)
    said = tell("{done}: {outcome}.", done=done, outcome=outcome(measure, result))
    if measure.force is None:
        return said
    return f"{said} {straps.borne(measure.kind, result)}"


def of_no_help(result: ItemResult, premises: Premises) -> str:
    """What was tried and does not help clearly, with what it leaves."""
    tried = [each for each in result.tried if each not in result.helpful]
    worse = [_named(each, result, premises) for each in tried if _is_worse(each, result)]
    same = [_named(each, result, premises) for each in tried if not _is_worse(each, result)]
    said = []
    if same:
        said.append(tell("Tried without clear benefit: {names}.", names="; ".join(same)))
    if worse:
        said.append(
            tell("With this it falls, or goes far, more often: {names}.", names="; ".join(worse))
        )
    return " ".join(said)


def _is_worse(measure: Mitigation, result: ItemResult) -> bool:
    """Whether more is left after a measure, or falls, by more than chance."""
    more_left = is_worse(measure.left, result.before)
    return more_left or is_worse(measure.fall, result.overturns)


def _named(measure: Mitigation, result: ItemResult, premises: Premises) -> str:
    return tell(
        "{measure} ({outcome})",
        measure=short(measure, result.item, premises),
        outcome=outcome(measure, result),
    )


def metres(length: float) -> str:
    """A length to centimetres, a dash where there is none."""
    return "–" if math.isnan(length) else number(length, ".2f")
