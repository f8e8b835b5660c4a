"""A whole assessment in a few sentences: what, how sure, how it was looked at."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence

from shaketable.assess import (
    ACCEPTED_FALLS,
    ENOUGH_RECORDINGS,
    FEWEST_RECORDINGS,
    Assessment,
    FloorAssessment,
    ItemResult,
    Share,
    Walls,
    fate_of,
)
from shaketable.assess.uncertainty import KINDS
from shaketable.errors import named, quoted
from shaketable.inventory import Castors, Item
from shaketable.language import tell, translated
from shaketable.models import General
from shaketable.report.words import space
from shaketable.report.words.assumed import how_many_are_assumed
from shaketable.report.words.numbers import (
    between,
    counted,
    distance,
    expected_count,
    in_hundred,
    limits_in_hundred,
    of_pieces,
)
from shaketable.resampling import wilson_interval
from shaketable.tilting import SLIDES
from shaketable.units import STANDARD_GRAVITY, degrees

MOST_NAMED = 10  # objects in a sentence
LEAST_TOLD = 0.05  # pieces: fewer are told as 0.0


def headline(assessment: Assessment) -> list[str]:
    """What happens, in a few sentences; what decides nothing says so first."""
    return [*not_as_it_stands(assessment), *what_falls(assessment), *assumed(assessment)]


def assumed_in_short(assessment: Assessment) -> list[str]:
    """The same in a few words, for the first line."""
    walls = {
        Walls.YES: tell("at a wall"),
        Walls.EACH: tell("walls as listed"),
        Walls.NO: tell("free of walls"),
        Walls.UNKNOWN: tell("free of walls"),
    }
    found = [walls[assessment.walls]] if assessment.solids else []
    return [*found, tell("shallow crustal earthquakes")] if assessment.crustal else found


def assumed(assessment: Assessment) -> list[str]:
    """What was taken for granted of walls and of earthquakes, and how to say otherwise."""
    walls = {
        Walls.YES: tell(
            "As was said, most things stand against a wall: one is taken 10 mm behind each that is "
            "not on castors, on furniture or near an edge."
        ),
        Walls.NO: tell("As was said, most things stand free of walls."),
        Walls.EACH: tell("Walls stand where the list says so, and nowhere else."),
        Walls.UNKNOWN: tell(
            "Do most things stand against a wall? Nobody said so: the numbers are of things that "
            "stand free, and where a wall was tried the number against a wall is told beside."
        ),
    }
    found = [walls[assessment.walls]] if assessment.solids else []
    if assessment.crustal:
        found.append(
            tell(
                "All these recordings are of shallow crustal earthquakes. Are large subduction "
                "earthquakes expected (Chile, Japan, Cascadia)? They last longer: give a folder of "
                "their records (--motions)."
            )
        )
    return found


def what_falls(assessment: Assessment) -> list[str]:
    """How many kinds and pieces fall, and how many more are held up or slide."""
    results = assessment.results
    pieces = counted(sum(each.item.quantity for each in results), "piece")
    sentences = [] if _nothing_decided(assessment) else [_who_overturns(results, pieces)]
    fate = fate_of(results)
    if fate.falls.value > 0.0:
        where = _worst_floor(assessment.floors)
        untold = sum(each.item.quantity for each in results if not each.item.depth_known)
        unsure = ""
        if untold:
            unsure = tell("; the depth of {pieces} is not known", pieces=counted(untold, "piece"))
        sentences.append(
            tell(
                "On average over the shakings, {falls} of {pieces} would fall{where}{unsure}.",
                falls=of_pieces(fate.falls, fate.pieces),
                pieces=pieces,
                where=where,
                unsure=unsure,
            )
        )
    return [*sentences, *_held_up(results), *_sliding(results)]


def in_three_sentences(assessment: Assessment) -> tuple[list[str], list[str]]:
    """How sure it is in three sentences, and what else there is to say of that."""
    every = how_sure(assessment)
    return every[:3], every[3:]


def _held_up(results: Sequence[ItemResult]) -> list[str]:
    """How many end held up by what surrounds them alone, which is no fall and nothing good."""
    pieces = 0.0
    for each in results:
        held = each.as_it_stands and each.as_it_stands.surrounded
        pieces += each.item.quantity * held.held_up.value if held else 0.0
    if pieces < LEAST_TOLD:
        return []
    return [
        tell(
            "On average only a wall or a strap would hold up {pieces} more in the end: nobody "
            "should stand under them, and class and order count them as fallen.",
            pieces=expected_count(pieces),
        )
    ]


def not_as_it_stands(assessment: Assessment) -> list[str]:
    """What makes all that follows look safer than it is: first of all that is said."""
    results = assessment.results
    sentences = _nothing_decided(assessment)
    unread = list(dict.fromkeys(name for each in results for name in each.item.unread))
    if unread and any(not each.item.unread for each in results):
        sentences.append(_unread_cells(results, unread))
    elif unread:
        sentences.append(
            tell(
                "Nothing is classed: {columns} may say what stands on castors, what is anchored or "
                "what is round, and was not understood. Give it a known name (castors, anchored, "
                "strap or shape), or put # before its name if it says none of these.",
                columns=named([quoted(each) for each in unread], MOST_NAMED),
            )
        )
    sentences += _hanging(assessment.hanging)
    if not assessment.in_building and any(each.item.floor for each in results):
        sentences.append(
            tell(
                "The list names floors, and everything was simulated on the ground, as no building "
                "was given: on upper floors shaking is stronger, and more falls than is said here."
            )
        )
    alone = [each.item.name for each in results if each.left_alone]
    if alone:
        sentences.append(
            tell(
                "Not all was simulated that the list says of walls, straps, pads, edges and lips: "
                "{names}. None of these is called a low risk.",
                names=named(list(dict.fromkeys(alone)), MOST_NAMED),
            )
        )
    flat = [each.item.name for each in results if each.plane_says_too_little]
    if flat:
        sentences.append(
            tell(
                "Simulated in a plane alone, and round, nearly square or on feet, which falls far "
                "more often when it is shaken in both directions at once: {names}. These have no "
                "class but the worst, and their shares are too low.",
                names=named(list(dict.fromkeys(flat)), MOST_NAMED),
            )
        )
    return sentences


def _unread_cells(results: Sequence[ItemResult], headers: Sequence[str]) -> str:
    """How many kinds have no class because a cell was not read, and where these cells stand."""
    rows = {
        header: [f"{each.item.row}" for each in results if header in each.item.unread]
        for header in headers
    }
    where = [
        tell("{column}, row {rows}", column=quoted(header), rows=named(numbers, MOST_NAMED))
        for header, numbers in rows.items()
    ]
    return tell(
        "{some} of {kinds} have no class, because a cell could not be read: {where}.",
        some=sum(bool(each.item.unread) for each in results),
        kinds=counted(len(results), "kind of object"),
        where="; ".join(where),
    )


def _hanging(items: Sequence[Item]) -> list[str]:
    """What hangs or is fixed as names and notes say, which is asked about."""
    if not items:
        return []
    return [
        tell(
            "Not simulated, as names or notes say that they hang or are fixed: {names}. Are they? "
            "Say yes or no in a column “anchored”; what is not fixed is then simulated.",
            names=named(list(dict.fromkeys(each.name for each in items)), MOST_NAMED),
        )
    ]


def _who_overturns(results: Sequence[ItemResult], pieces: str) -> str:
    """How many kinds of object fall often; of whose size is not known nothing good is said."""
    often = [each for each in results if each.overturns.value > ACCEPTED_FALLS]
    seldom = [each for each in results if each.overturns.value <= ACCEPTED_FALLS]
    untold = sum(not each.item.depth_known for each in seldom)
    kinds, limit = counted(len(results), "kind of object"), in_hundred(ACCEPTED_FALLS)
    unsure = ""
    if untold:
        unsure = tell(
            "Of {kinds} nothing can be said, as the inventory gives no depth.",
            kinds=counted(untold, "kind of object"),
        )
    if untold == len(results):
        return unsure
    if often:
        said = tell(
            "{often:,} of {kinds} ({falling:,} of {pieces}) {overturn} in more than {limit} of 100 "
            "of these shakings.",
            often=len(often),
            kinds=kinds,
            falling=sum(each.item.quantity for each in often),
            pieces=pieces,
            overturn=translated("overturns" if len(often) == 1 else "overturn"),
            limit=limit,
        )
    else:
        worst = max(results, key=lambda each: each.overturns.high)
        said = tell(
            "Of {kinds} ({pieces}) none {overturn} in more than {limit} of 100 of these shakings; "
            "from {recordings} independent recordings up to {high} in 100 cannot be excluded.",
            kinds=kinds,
            pieces=pieces,
            overturn=translated("overturns" if len(results) == 1 else "overturn"),
            limit=limit,
            recordings=worst.by,
            high=limits_in_hundred(worst.overturns)[1],
        )
    return f"{said} {unsure}".strip()


def how_sure(assessment: Assessment) -> list[str]:
    """What the numbers stand on, and what the inventory does not tell."""
    sources = assessment.sources
    n, results = assessment.recordings, assessment.results
    kinds = [each.item for each in results]
    untold = [item.name for item in kinds if not item.depth_known]
    one_way = sum(item.depth_known and item.sideways is None for item in kinds)
    castors = sum(item.castors is Castors.UNKNOWN for item in kinds)
    sentences = []
    if n >= FEWEST_RECORDINGS:
        sentences.append(
            tell(
                "The shakings come from {recordings} independent {sources}, on which the intervals "
                "in brackets rest: about 95 of 100 such intervals hold what endlessly many "
                "recordings would show. They do not tell how likely such shaking is here.",
                recordings=n,
                sources=translated(sources),
            )
        )
        none = Share(0.0, *map(float, wilson_interval(0.0, n)))
        if n < ENOUGH_RECORDINGS:
            said = tell(
                "What fell in none of them may still fall in up to {limit} of 100, so that nothing "
                "is called a low risk here, as that takes {enough} {sources}{more}.",
                limit=limits_in_hundred(none)[1],
                enough=ENOUGH_RECORDINGS,
                sources=translated(sources),
                more=tell(
                    "; --motions takes a folder of more records, such as those of your region"
                )
                if sources == "recordings"
                else "",
            )
            sentences.append(said)
    sentences += space.how_sure(assessment)
    sentences += how_many_are_assumed(kinds)
    if assessment.tried:
        sentences.append(
            tell(
                "The first period of the building is not known: {periods} were tried, and of each "
                "object the one counts in which it falls most often. The building may have "
                "another one.",
                periods=", ".join(assessment.tried),
            )
        )
    if untold:
        sentences.append(
            tell(
                "For {kinds} the inventory gives no depth: the width was taken for it, and none of "
                "them is called a low risk. Where the width is the longer side of the base, the "
                "object falls more often than is said here. Fill in depth_m (front to back) and "
                "width_m (side to side).",
                kinds=counted(len(untold), "kind of object"),
            )
        )
    model = assessment.model
    if isinstance(model, General) and math.isfinite(model.static_friction):
        sentences.append(
            tell(
                "Everything may slide, with the friction of {friction:g} that was given. Where "
                "more friction makes an object fall more often, its card says so.",
                friction=model.static_friction,
            )
        )
    sentences += space.limits(assessment)
    if one_way:
        sentences.append(
            tell(
                "For {kinds} the inventory gives no width: side to side nothing was simulated.",
                kinds=counted(one_way, "kind of object"),
            )
        )
    if castors:
        sentences.append(
            tell(
                "By name or note, {kinds} may stand on castors. What was simulated stood on none, "
                "and nothing is classed there until a column castors tells.",
                kinds=counted(castors, "kind of object"),
            )
        )
    if assessment.anchored:
        names = [item.name for item in assessment.anchored]
        sentences.append(
            tell(
                "Not simulated, as anchored by the inventory: {names}. Whether anchors hold was "
                "not looked at.",
                names=named(names, MOST_NAMED),
            )
        )
    return sentences


def peaks(floors: Sequence[FloorAssessment]) -> str:
    """The range of the peak accelerations of the motions on some floors."""
    low = min(floor.smallest_pga for floor in floors) / STANDARD_GRAVITY
    high = max(floor.largest_pga for floor in floors) / STANDARD_GRAVITY
    return between(low, high, "g")


def _nothing_decided(assessment: Assessment) -> list[str]:
    n = assessment.recordings
    if n >= FEWEST_RECORDINGS:
        return []
    return [
        tell(
            "This decides nothing: the motions come from {recordings}, and objects are classed "
            "from {fewest} on. Zero falls in so few shakings say next to nothing about the next "
            "earthquake.",
            recordings=counted(n, "independent recording"),
            fewest=FEWEST_RECORDINGS,
        )
    ]


def _worst_floor(floors: Sequence[FloorAssessment]) -> str:
    if len(floors) == 1:
        return ""
    worst = max(floors, key=lambda floor: fate_of(floor.results).falls.value)
    fate = fate_of(worst.results)
    return tell(
        ", most of all on {floor}: {falls} of {pieces} pieces there",
        floor=floor_name(worst.floor),
        falls=expected_count(fate.pieces * fate.falls.value),
        pieces=f"{fate.pieces:,}",
    )


def floor_name(label: str) -> str:
    """ "floor 3"; "the ground floor", "the roof": what is a word needs no "floor" before it."""
    word = label.strip()
    if word.lower() in ("ground", "first", "second", "third", "top"):
        return translated(f"the {word.lower()} floor")
    if word.lower() in ("roof", "basement", "attic", "mezzanine", "penthouse"):
        return translated(f"the {word.lower()}")
    if "floor" in word.lower() or "level" in word.lower():
        return word
    return tell("floor {label}", label=word)


def _sliding(results: Sequence[ItemResult]) -> list[str]:
    known = [
        (each.sliding.slip.upper, each)
        for each in results
        if each.sliding and not each.solid and not math.isnan(each.sliding.slip.upper)
    ]
    sentences = []
    if known and (worst := max(known, key=lambda pair: pair[0]))[0] > SLIDES:
        sentences.append(
            tell(
                "What {goes} farthest is {name!r}: by {far} or more in a quarter of the shakings "
                "that leave it upright.",
                goes=translated("rolls" if worst[1].item.castors is Castors.FREE else "slides"),
                name=worst[1].item.name,
                far=distance(worst[0]),
            )
        )
    off = [
        (each.along_support.sliding.walks_off, each.item.name)
        for each in results
        if each.along_support.sliding and each.along_support.sliding.walks_off > 0.0
    ]
    if off:
        often, name = max(off)
        sentences.append(
            tell(
                "{kinds} {walk} off the support in some shakings, {name!r} in {often} of 100.",
                kinds=counted(len(off), "kind of object"),
                walk=translated("walks" if len(off) == 1 else "walk"),
                name=name,
                often=in_hundred(often),
            )
        )
    return sentences


def uncertainty(assessment: Assessment) -> list[str]:
    """What becomes of the falls where the objects are uncertain too; nothing if not asked for."""
    found = assessment.uncertain
    if not found:
        return []
    exact = sum(result.overturns.value * result.item.quantity for result in found)
    now = sum(each.fall.value * r.item.quantity for r in found if (each := r.uncertain))
    told = Counter(each.matters_more for r in found if (each := r.uncertain))
    words = {"motion": "which motion comes", "object": "what the object is like",
             "neither": "neither, as nearly none or all of them fall"}  # fmt: skip
    sides = [
        tell(
            "{what}, for {kinds}",
            what=translated(said),
            kinds=counted(told[word], "kind of object"),
        )
        for word, said in words.items()
        if told[word]
    ]
    rolling = [result for result in assessment.results if result.item.rolls]
    sentences = [
        tell(
            "With the objects uncertain too, {now} of those that do not roll fall on average, "
            "instead of {exact}.",
            now=expected_count(now),
            exact=expected_count(exact),
        ),
        tell("What makes the larger difference: {sides}.", sides="; ".join(sides)),
    ]
    if rolling:
        sentences.append(
            tell(
                "What stands on castors is not in it ({kinds}): how far it goes hangs on its "
                "brakes and the floor, for which no deviation is assumed; the share of the sizes "
                "as given stands in its place.",
                kinds=counted(len(rolling), "kind of object"),
            )
        )
    return sentences


def assumed_uncertainty() -> str:
    """The standard deviations that are assumed of objects."""
    kinds = "; ".join(
        tell(
            "{kind}: base ±{base:.0f} %, foot of the centre of gravity ±{foot:.0f} % of the base",
            kind=translated(kind.name),
            base=100 * kind.uncertainty.slenderness,
            foot=100 * kind.uncertainty.cg_offset,
        )
        for kind in KINDS
    )
    usual = KINDS[-1].uncertainty
    return tell(
        "Assumed standard deviations, none of them measured, by what its name says an object is: "
        "{kinds}; of all, size ±{size:.0f} %, support ±{tilt:.1f}°. The loss at impacts is taken "
        "as it is.",
        kinds=kinds,
        size=100 * usual.size,
        tilt=degrees(usual.tilt),
    )
