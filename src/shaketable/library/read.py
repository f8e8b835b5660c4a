"""A library as a TOML file describes it.

[library]
title = "Unanchored things"
edition = "1.0"
measures = ["PGV", "PGA", "floor PGV"]     # a leading "floor": of the floor's motion
limit_states = ["uplift", "slides 0.1 m", "overturns", "reaches 0.8 m"]
seed = 1

[motions]
of = ["fema-p695-both-directions"]

[[places]]
name = "ground"

[[places]]
name = "floor 4 of 6"
storeys = 6                                # of a linear shear building
first_period_s = 0.65
floor = 4

[[held]]
name = "free"

[[held]]
name = "strap"
wall_gap_mm = 10
strap_strength = 1.0                       # in weights of the thing
slack_mm = 5
draws = 2                                  # how many things, as they may be, meet each motion

[[things]]
kinds = ["bookcase", "server rack"]        # of the catalogue of common things
sizes = ["slender", "middle"]
places = ["ground", "floor 4 of 6"]        # all by default
held = ["free", "strap"]                   # likewise
tilts_deg = [0]
friction = [[0.4, 0.6]]                    # ranges

[[things]]
kinds = ["bookcase"]
label = "5 shelves"                        # of sizes of its own
lengths_m = [0.32, 0.91, 1.80]             # depth, width and height
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeVar

from shaketable.errors import InputError, named, quoted
from shaketable.fragility.limit_states import OVERTURNS, LimitState
from shaketable.library.case import Case, Held, Stand
from shaketable.library.library import Library
from shaketable.library.measures import FLOOR, require_measure
from shaketable.library.states import state_of_library
from shaketable.library.thing import LibraryThing, Size
from shaketable.spelled_surroundings import metres
from shaketable.synthesis import ShearBuilding
from shaketable.toml_file import TomlFile, TomlTable, is_number
from shaketable.units import radians

SECTION = "library"
SCHEMA: Mapping[str, Any] = {
    SECTION: ("title", "edition", "measures", "limit_states", "seed"),
    "motions": ("of",),
    "places": list,
    "held": list,
    "things": list,
}
PLACE = ("name", "storeys", "first_period_s", "damping", "floor")
HELD = ("name", "wall_gap_mm", "strap_strength", "slack_mm", "edge_mm", "draws")
THINGS = (
    "kinds", "sizes", "scales", "label", "lengths_m", "places", "held", "tilts_deg", "friction"
)  # fmt: skip
MOST_NAMED = 5

T = TypeVar("T")
N = TypeVar("N", Stand, Held)


def read_library(told: TomlFile) -> Library:
    """The library that a file describes; what is wrong with it is noted as faults of the file."""
    told.accept(SCHEMA)
    stands = _named(told, "places", PLACE, _stand)
    held = _named(told, "held", HELD, _held)
    cases: dict[str, Case] = {}
    for table in told.tables("things"):
        table.accept(THINGS)
        for case in _cases(table, stands, held):
            if case.name in cases:
                table.fault("kinds", f"the case {case.name} is there twice")
            cases[case.name] = case
    if not cases and not told.faults:
        told.fault("things", "give at least one thing")
    states, measures = [], []
    for text in told.get(SECTION, "limit_states", list, ["overturns"]):
        try:
            states.append(state_of_library(str(text)))
        except InputError as error:
            told.fault(f"{SECTION}.limit_states", str(error))
    for text in told.get(SECTION, "measures", list, ["PGV"]):
        try:
            measures.append(require_measure(str(text)))
        except InputError as error:
            told.fault(f"{SECTION}.measures", str(error))
    if _has_no_row(cases.values(), measures):
        told.fault(
            f"{SECTION}.measures", "every one is of a floor, and all things stand on the ground"
        )
    of = told.get("motions", "of", (str, list), "")
    return Library(
        title=told.get(SECTION, "title", str, "Unanchored things"),
        edition=told.get(SECTION, "edition", str, "0"),
        cases=tuple(cases.values()),
        measures=tuple(measures),
        states=tuple(dict.fromkeys(states)) or (LimitState(OVERTURNS),),
        seed=told.get(SECTION, "seed", int, 0),
        motions=of if isinstance(of, str) else ", ".join(map(str, of)),
    )


def _has_no_row(cases: Iterable[Case], measures: Sequence[str]) -> bool:
    """Whether a library of these cases would have no row."""
    on_floors = any(case.stand.building is not None for case in cases)
    return bool(measures) and not on_floors and all(each.startswith(FLOOR) for each in measures)


def _named(
    told: TomlFile, section: str, keys: Sequence[str], made: Callable[[TomlTable], N]
) -> dict[str, N]:
    """What the tables of a name describe, by their names, of which none may be there twice."""
    found: dict[str, N] = {}
    for table in told.tables(section):
        table.accept(keys)
        try:
            one = made(table)
        except InputError as error:
            table.fault("name", str(error))
            continue
        if one.name in found:
            table.fault("name", f"{quoted(one.name)} is there twice")
        found[one.name] = one
    return found


def _stand(table: TomlTable) -> Stand:
    name = table.text("name", "ground")
    if "storeys" not in table.table:
        for key in ("first_period_s", "damping", "floor"):
            if key in table.table:
                table.fault(key, "is of a building: give its storeys as well")
        return Stand(name=name)
    building = ShearBuilding(
        storeys=_whole(table, "storeys", 1),
        first_period=table.number_from("first_period_s", 1.0, 0.01, 100.0) or 1.0,
        damping=table.number_from("damping", 0.05, 0.001, 0.5) or 0.05,
        name=name,
    )
    return Stand(name=name, building=building, floor=_whole(table, "floor", 1))


def _held(table: TomlTable) -> Held:
    gap = table.number_from("wall_gap_mm", None, 0.0, 10_000.0)
    edge = table.number_from("edge_mm", None, 0.0, 10_000.0)
    return Held(
        name=table.text("name", "free"),
        wall_gap=metres(gap),
        strength=table.number_from("strap_strength", None, 0.0, 1e6),
        slack=metres(table.number_from("slack_mm", 0.0, 0.0, 10_000.0)) or 0.0,
        edge=metres(edge),
        draws=_whole(table, "draws", Held.draws),
    )


def _whole(table: TomlTable, key: str, default: int) -> int:
    found = table.number_from(key, default, 0, 1000)
    if found is not None and found != int(found):
        table.fault(key, f"expected a whole number, found {found:g}")
    return default if found is None else int(found)


def _cases(
    table: TomlTable, stands: Mapping[str, Stand], held: Mapping[str, Held]
) -> Iterator[Case]:
    """All combinations of a table of things."""
    sizes = _chosen(table, "sizes", {each.value: each for each in Size}, ["middle"])
    places = _chosen(table, "places", stands, list(stands))
    holding = _chosen(table, "held", held, list(held))
    scales = _numbers(table, "scales", [1.0])
    tilts = _numbers(table, "tilts_deg", [0.0])
    ranges = table.values("friction", [[0.4, 0.6]])
    kinds = table.values("kinds", [])
    label, lengths = table.text("label", ""), None
    if "lengths_m" in table.table:
        given = _numbers(table, "lengths_m", [1.0] * 3)
        if len(given) == 3:
            lengths = given[0], given[1], given[2]
        else:
            table.fault("lengths_m", f"expected depth, width and height, found {given}")
    for kind, size, scale, stand, way, tilt, friction in itertools.product(
        kinds, sizes, scales, places, holding, tilts, ranges
    ):
        both = isinstance(friction, list) and len(friction) == 2
        if not (both and all(map(is_number, friction))):
            table.fault("friction", f"expected ranges such as [[0.4, 0.6]], found {friction!r}")
            return
        try:
            thing = LibraryThing(
                kind=str(kind), size=size, scale=scale, lengths=lengths, label=label
            )
            yield Case(
                thing=thing, stand=stand, held=way, tilt=radians(tilt),
                friction=(float(friction[0]), float(friction[1])),
            )  # fmt: skip
        except InputError as error:
            table.fault("kinds", str(error))
            return


def _chosen(table: TomlTable, key: str, known: Mapping[str, T], default: list[str]) -> list[T]:
    """The values that a list of words names."""
    words = table.values(key, default)
    for word in words:
        if word not in known:
            there = named(list(known), MOST_NAMED)
            table.fault(key, f"unknown {quoted(str(word))}; known: {there}")
    return [known[word] for word in words if word in known]


def _numbers(table: TomlTable, key: str, default: list[float]) -> list[float]:
    values = table.values(key, default)
    if not all(map(is_number, values)):
        table.fault(key, f"expected a list of numbers, found {values!r}")
        return default
    return [float(each) for each in values]
