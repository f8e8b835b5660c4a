"""What a worker does with a list of objects: read it, and assess it."""

from __future__ import annotations

import math
from pathlib import Path

import pandas as pd
from pydantic import ValidationError

from shaketable.assess import Assessment, ItemResult, assess
from shaketable.atomic_files import write_csv
from shaketable.body import Body
from shaketable.building import building_of_structure
from shaketable.engine.pool import at_most
from shaketable.inventory import BaseShape, Inventory, Item
from shaketable.inventory.building_sheet import require_one_building
from shaketable.inventory.mapping import SUFFIX
from shaketable.language import LANGUAGES, Language, speaking, tell
from shaketable.report.assessment_folder import write_results
from shaketable.report.run_log import RunLog, sha256
from shaketable.report.words import advice, answer, carried, findings, headline
from shaketable.report.words.numbers import in_hundred, limits_in_hundred
from shaketable.signal.intensity import measure_named
from shaketable.signal.scaling import by_measure
from shaketable.units import degrees
from shaketable.web.answers import Assessed, Counts, Ranked
from shaketable.web.job_files import REPORT, RESULTS, Watch
from shaketable.web.list_reading import GivenList, without_level
from shaketable.web.questions import Assess, Thing, Upright
from shaketable.web.shaking import pairs_of, suite_of
from shaketable.web.work import in_hundreds

REMARKS = {"en": "list.csv", "es": "lista.csv", "de": "liste.csv"}
assert set(REMARKS) == set(LANGUAGES)
REPORTS = {each: "report.html" if each == "en" else f"report.{each}.html" for each in LANGUAGES}


def assess_list(asked: Assess, folder: str, language: Language = "en") -> None:
    """Assess a list; progress and results, in all languages, are files of the folder.

    Args:
        asked: the list, and by what it is shaken.
        folder: of this assessment.
        language: of the errors.
    """
    place = Path(folder)
    data = asked.text.encode()
    given = GivenList.written(
        place,
        asked.name,
        data,
        asked.columns,
        sizes=asked.accept_sizes,
        catalogue=asked.catalogue,
        rows=asked.rows,
    )
    motions = suite_of(asked.suite) if asked.planar else pairs_of(asked.suite)
    described = asked.building and {
        "name": Path(asked.name).stem,
        **asked.building.model_dump(),
    }
    # other workers need the other cores
    with RunLog(_command(asked), shown=given.fault) as log, at_most(1):
        with speaking(language):
            inventory, _ = _inventory(given)
        items, read = inventory.items, len(log.messages)
        house = None
        if described:
            with speaking(language):
                require_one_building(items)
            ground = suite_of(asked.suite)
            house = building_of_structure(given.file.path, described, ground)
        scale, scaling = asked.scale, ""
        if asked.level:
            scale, scaling = asked.level.value, asked.level.told()
            measure = by_measure(measure_named(asked.level.measure))
            house = house and house.scaled_to(measure)
            motions = [motion.scaled(measure.factor(motion)) for motion in motions]
        result = assess(
            items,
            house or motions,
            scale=scale,
            planar=asked.planar,
            walls=asked.wall,
            progress=Watch(place),
        )
        during = log.messages[read:]
        notes = {}
        for each in LANGUAGES:  # what reading it warns of is told again in each
            with speaking(each):
                notes[each] = [*_inventory(given)[1], *during]
        run = {
            **log.entries(),
            "messages": notes["en"],
            "inventory": {
                "path": asked.name,
                "sha256": sha256(given.file.path),
                "items": len(items),
                "not_assessed": inventory.not_assessed,
                "columns": asked.columns,
            },
            "motions": {"description": _by(len(motions), asked), "sources": []},
            "scaling": scaling,
            "building": described,
        }
    write_results(
        result, run, place / REPORT, building=house, overwrite=True, languages=LANGUAGES[1:]
    )
    for each in LANGUAGES:
        with speaking(each):
            write_csv(_with_remarks(inventory, result), place / REPORT / REMARKS[each])
            told = _assessed(result, notes[each]).model_dump_json()
        (place / RESULTS[each]).write_text(told, encoding="utf-8")


def _inventory(given: GivenList) -> tuple[Inventory, list[str]]:
    """A list, and what is said of it, in the language that is spoken."""
    with RunLog(shown=given.fault) as log:
        inventory = given.read()
    return inventory, without_level(log.messages)


def _with_remarks(inventory: Inventory, result: Assessment) -> pd.DataFrame:
    """The visitor's own rows, each with what was found beside it."""
    found = {each.number: each for each in result.results}
    header = [name for name, _ in inventory.columns]
    rows: list[list[str]] = []
    for number, row in enumerate(inventory.rows, 1):
        one = found.get(number)
        if one is None:  # it is fixed to the building
            remarks = ["", "", tell("not simulated"), ""]
        else:
            share = one.governing_share
            low, high = limits_in_hundred(share)
            alone = not one.item.stands_on
            remarks = [
                in_hundred(share.value) if alone else carried.often(one),
                tell("{low} to {high}", low=low, high=high) if alone else "",
                findings.risk_in_words(one),
                advice.first_measure(one, result.premises),
            ]
        rows.append([*row, *[""] * (len(header) - len(row)), *remarks])
    return pd.DataFrame(
        rows,
        columns=[
            *header,
            tell("falls or goes too far in 100 shakings"),
            tell("likely"),
            tell("risk"),
            tell("to do first"),
        ],
    )


def _by(count: int, asked: Assess) -> str:
    """By what a list is shaken, and how strongly where that is not as recorded."""
    told = f"{count} {'motions' if asked.planar else 'recordings'} of {asked.suite}"
    return f"{told}; {asked.level.told()}" if asked.level else told


def _command(asked: Assess) -> list[str]:
    """The command that finds the same, but for the building and the level of the site."""
    scale = [] if asked.scale == 1.0 else ["--scale", f"{asked.scale:g}"]
    planar = ["--planar"] if asked.planar else []
    sizes = ["--accept-sizes"] if asked.accept_sizes else []
    said = ["--columns", f"{asked.name}{SUFFIX}"] if asked.columns.strip() else []
    usual = ["--catalogue"] if asked.catalogue else []
    wall = ["--wall", asked.wall] if asked.wall else []
    which = ["--motions", asked.suite, *scale, *planar, *wall, *sizes, *said, *usual]
    return ["shaketable", "assess", asked.name, *which]


def _assessed(result: Assessment, notes: list[str]) -> Assessed:
    return Assessed(
        notes=notes,
        headline=list(headline.headline(result)),
        how_sure=list(headline.how_sure(result)),
        objects=[_ranked(each, result) for each in result.ranked()],
    )


def _ranked(result: ItemResult, assessment: Assessment) -> Ranked:
    item = result.item
    return Ranked(
        name=item.name,
        building=item.building,
        floor=item.floor,
        where=item.location,
        quantity=item.quantity,
        risk=result.risk,
        risk_in_words=findings.risk_in_words(result),
        share=result.governing_share.value,
        counts=_counts(result),
        low=result.governing_share.low,
        high=result.governing_share.high,
        in_100=in_hundreds(result.governing_share),
        measure=advice.first_measure(result, assessment.premises),
        happens=answer.what_happens(result, assessment.sources),
        advice=advice.what_to_do(result, assessment),
        thing=_thing(item, result),
    )


def _counts(result: ItemResult) -> Counts:
    """What the share of an object is of."""
    if result.item.stands_on:
        return "on_furniture"
    falls = [result.overturns]
    if result.solid is None:
        falls.append(result.along_support.fall)
    if result.governing_share in falls:
        return "falls"
    if result.as_it_stands is not None and not result.item.rolls:
        return "falls_or_held_up"
    return "falls_or_goes_far" if result.item.rolls else "falls_or_leaves"


def _thing(item: Item, result: ItemResult) -> Thing | Upright | None:
    """The object for the page's one thing, which knows no castors and no unusual inertia.

    Nor what surrounds it: there is one wall, behind it, and one strap to that.
    """
    if item.rolls or item.surroundings or not _is_homogeneous(item, result.profile.body):
        return None
    body, cg_share = result.profile.body, item.body.cg_height / item.height
    try:
        if result.solid is None or item.sideways is None or not _is_plain(item):
            return Thing(
                base_m=body.base,
                height_m=item.height,
                cg_share=cg_share,
                eccentricity=body.left / body.base,
                tilt_deg=degrees(result.profile.tilt),
            )
        box = item.shape is BaseShape.BOX
        return Upright(
            shape="box" if box else "cylinder",
            depth_m=item.body.base if box else None,
            width_m=item.sideways.base if box else None,
            base_m=None if box else item.body.base,
            height_m=item.height,
            cg_share=cg_share,
        )
    except ValidationError:  # larger, or with its weight higher, than is shaken one at a time
        return None


def _is_homogeneous(item: Item, body: Body) -> bool:
    """Whether its radius of gyration is that of a homogeneous rectangle, to a thousandth."""
    expected = math.hypot(body.base, item.height) / math.sqrt(12.0)
    return math.isclose(body.gyration_radius, expected, rel_tol=1e-3)


def _is_plain(item: Item) -> bool:
    """Whether it is a box or a cylinder with its weight above the middle."""
    bodies = [body for body in (item.body, item.sideways) if body]
    return item.shape is not BaseShape.FEET and all(body.left == body.right for body in bodies)
