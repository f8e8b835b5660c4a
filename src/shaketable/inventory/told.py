"""What a list's user should look at: hints in names and notes, columns that are not used."""

from __future__ import annotations

import logging
import re
from collections.abc import Sequence
from pathlib import Path

from shaketable.errors import Fault, named, quoted, remark
from shaketable.inventory.carriers import may_be_fastened
from shaketable.inventory.columns import Column
from shaketable.inventory.hints import (
    may_say_what_it_stands_on,
    mentions_anchors,
    must_be_kept,
)
from shaketable.inventory.item import Castors, Item
from shaketable.language import tell, translated
from shaketable.tables import Cell

log = logging.getLogger(__name__)

#: Numbers of pieces in a name: "2 x shelf", "chair (12 pcs)", "locker x4".
_SEVERAL = re.compile(
    r"^\d+\s*[x×]\s|[(\[]\d+\s*(pcs?|pieces|x|stk|stück|uds?|unidades|pz|pezzi|個|台|本)\.?[)\]]|"
    r"\s[x×]\s?\d+$|\(\d{1,2}\)$",
    re.IGNORECASE,
)
MOST_NAMED = 20  # objects or columns in a warning


def warn_of_missing(path: Path, without: Sequence[tuple[str, tuple[Fault, ...]]]) -> None:
    """Warn of objects that are not assessed, as the list does not give their sizes."""
    if not without:
        return
    told = named([f"{quoted(name)} ({missing[0].where})" for name, missing in without], MOST_NAMED)
    text = tell(
        "{count} not assessed, as the list does not give their sizes: {names}",
        count=len(without),
        names=told,
    )
    mend = next((each.mend for _, missing in without for each in missing if each.mend), "")
    log.warning(remark(path, text)._replace(mend=mend))


def warn_of_assumed(path: Path, items: Sequence[Item]) -> None:
    """Warn of sizes that were taken from the catalogue."""
    told = list(
        dict.fromkeys(
            tell("{name} as {thing}", name=quoted(item.name), thing=quoted(item.assumed_as))
            for item in items
            if item.assumed
        )
    )
    if told:
        text = tell(
            "sizes that the list leaves out are assumed, as those of the catalogue: {things}",
            things=named(told, MOST_NAMED),
        )
        log.warning(remark(path, text))


def warn_of_hints(path: Path, items: Sequence[Item]) -> None:
    """Warn of names and notes that say what a column should say."""
    hints = {
        "may be several: each row is counted once. Say how many in a column 'quantity'": [
            item.name for item in items if item.quantity == 1 and _SEVERAL.search(item.name)
        ],
        "may stand on castors. Say none, free or locked in a column 'castors'; until then they are "
        "simulated as if they had none, and get no class": [
            item.name for item in items if item.castors is Castors.UNKNOWN
        ],
        "may hang, or be fixed to the building: they are not simulated, and get no class. Say yes "
        "or no in a column 'anchored'": [item.name for item in items if item.hangs],
        "may be anchored, though the column 'anchored' says no: they are simulated as if they were "
        "not": [
            item.name
            for item in items
            if item.loose
            and not (item.surroundings and item.surroundings.straps)
            and mentions_anchors(item.name, item.note)
        ],
        "stand on castors of which it is not known whether they are locked: the worse of both is "
        "told, and in a room they are taken as locked. Say free or locked in a column 'castors'": [
            item.name for item in items if item.castors is Castors.SOME
        ],
        "are anchored, and not simulated: their walls, straps, pads and edges are not used": [
            item.name for item in items if item.anchored and item.surroundings
        ],
        "may be round, and what is round falls more often. Say box, cylinder or feet in a column "
        "'shape'; until then they are simulated as boxes, and get no class": [
            item.name for item in items if item.may_be_round
        ],
        "stand on something else, or are stacked. What they stand on is not simulated: they may "
        "fall with it, and it shakes them more strongly. They get no class. Assess what stands on "
        "the floor, and hold what stands on it": [
            item.name for item in items if item.stands_on and item.loose
        ],
        "stand on a bench, a plinth or a shelf, which is taken as fastened to the building. Name "
        "what moves in a column 'stands on', such as shelf or trolley": [
            item.name
            for item in items
            if item.loose
            and not (item.stands_on or item.rolls)
            and may_be_fastened(item.name, item.note, item.location)
        ],
        "may have to be kept from falling. Say yes or no in a column 'must_not_fall'": [
            item.name
            for item in items
            if not item.must_not_fall and must_be_kept(item.name, item.note)
        ],
    }
    for hint, names in hints.items():
        if names:
            told = named([quoted(name) for name in dict.fromkeys(names)], MOST_NAMED)
            text = tell(
                "by name, note or location, {names} {hint}", names=told, hint=translated(hint)
            )
            log.warning(remark(path, text))


def warn_of_unused(
    path: Path,
    header: list[Cell],
    columns: list[Column | None],
    unread: tuple[str, ...],
    rows: Sequence[Sequence[Cell]],
) -> None:
    """Warn of columns that are not used, first of those that decide what can be said."""
    if unread:
        told = named([quoted(each) for each in unread], MOST_NAMED)
        text = tell(
            "{columns} may say what stands on castors, what is anchored or what is round, and is "
            "not understood: nothing gets a class. Call it castors, anchored, strap or shape, or "
            "put # before its name if it says none of these",
            columns=told,
        )
        log.warning(remark(path, text))
    unused = [
        cell.text
        for cell, column in zip(header, columns, strict=True)
        if column is None and cell.text and cell.text not in unread
    ]
    stands = [text for text in unused if may_say_what_it_stands_on(text)]
    if stands:
        text = tell(
            "{columns} may say what objects stand on, which is not simulated: what stands on "
            "furniture may fall with it, and is shaken more strongly. Assess what stands on the "
            "floor, and hold what stands on it",
            columns=named([quoted(each) for each in stands], MOST_NAMED),
        )
        log.warning(remark(path, text))
    known = {column.meaning for column in columns if column}
    for meaning, may_be, text in (
        ("quantity", _may_count, _ONCE_EACH),
        ("mass", _may_weigh, _NO_MASS),
    ):
        some = [
            cell.text
            for k, (cell, column) in enumerate(zip(header, columns, strict=True))
            if column is None and cell.text in unused
            and may_be(cell.text, [row[k].text for row in rows if k < len(row) and row[k].text])
        ]  # fmt: skip
        if meaning not in known and some:
            told = named([quoted(each) for each in some], MOST_NAMED)
            log.warning(remark(path, tell(text, columns=told)))
    if unused:
        told = named([quoted(each) for each in unused], MOST_NAMED)
        log.warning(remark(path, tell("columns that are not used: {columns}", columns=told)))


_ONCE_EACH = (
    "each row is counted once, as no column says how many there are: is it {columns}? Then call it "
    "quantity"
)
_NO_MASS = "no column says the mass: is it {columns}? Then call it mass_kg"
MOST_PIECES = 500


def _may_count(_: str, texts: Sequence[str]) -> bool:
    """Whether an unknown column may say how many there are: small whole numbers, some again."""
    whole = [int(text) for text in texts if text.isdecimal()]
    return (
        len(whole) == len(texts) > 1 and max(whole) <= MOST_PIECES and len(set(whole)) < len(whole)
    )


def _may_weigh(heading: str, texts: Sequence[str]) -> bool:
    """Whether the heading of an unknown column names a unit of mass."""
    return bool(texts) and re.search(r"(?<![a-z])(kg|lbs?)(?![a-z])", heading.lower()) is not None
