"""Common things with the sizes that they usually have, for lists that leave sizes out.

`things.csv` is the data: a row a thing, with ranges, names in each language, and what the ranges
rest on. All are assumed, from what such things commonly measure: no published table was read for
them. A thing is added as a row; no code is needed.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources

from shaketable.inventory.item import BaseShape
from shaketable.inventory.vocabulary import heading

LANGUAGES = ("en", "es", "de", "it", "ja")
#: Endings of plurals, which a word in a list may have and the catalogue's need not.
_PLURALS = ("", "s", "es", "n", "en", "e", "er")
_COMPOUND = 5  # letters: shorter words end others by chance
_UNSPACED = "\u3000"  # letters from here on are of languages without blanks between words


@dataclass(frozen=True)
class Range:
    """From the least to the largest that is usual."""

    least: float
    most: float


@dataclass(frozen=True, kw_only=True)
class CommonThing:
    """A thing of the catalogue.

    Attributes:
        key: its name in English.
        group: furniture, home, laboratory, technical, hospital, museum or school.
        shape: of its base.
        depth, width, height: [m]; the depth of a cylinder is its diameter, and so is the width.
        cg: height of the centre of gravity, as a share of the height.
        mass: [kg].
        castors: "free" or "locked" where it commonly stands on castors, "" where not.
        friction: of its feet on usual floors.
        names: that it has in lists, by language.
    """

    key: str
    group: str
    shape: BaseShape
    depth: Range
    width: Range
    height: Range
    cg: Range
    mass: Range
    castors: str
    friction: Range
    names: Mapping[str, tuple[str, ...]]


@cache
def catalogue() -> Mapping[str, CommonThing]:
    """All common things, by their keys."""
    text = resources.files(__package__).joinpath("things.csv").read_text(encoding="utf-8")
    return {row["key"]: _thing(row) for row in csv.DictReader(text.splitlines())}


def _thing(row: Mapping[str, str]) -> CommonThing:
    depth = _range(row["depth_cm"], 0.01)
    return CommonThing(
        key=row["key"],
        group=row["group"],
        shape=BaseShape(row["shape"]),
        depth=depth,
        width=_range(row["width_cm"], 0.01) if row["width_cm"] else depth,
        height=_range(row["height_cm"], 0.01),
        cg=_range(row["cg"]),
        mass=_range(row["mass_kg"]),
        castors=row["castors"],
        friction=_range(row["friction"]),
        names={each: tuple(row[each].split("|")) for each in LANGUAGES},
    )


def _range(text: str, unit: float = 1.0) -> Range:
    least, _, most = text.partition("-")
    return Range(round(float(least) * unit, 6), round(float(most) * unit, 6))


def common_thing(name: str) -> CommonThing | None:
    """The thing of the catalogue that a name speaks of, by the longest of its words; None if none.

    Singular or plural; a German word may end a compound ("Wandregal").
    """
    told = heading(name)
    found = [
        (len(word), key)
        for (word, language), key in _words().items()
        if _speaks_of(told, word, language)
    ]
    return catalogue()[max(found)[1]] if found else None


@cache
def _words() -> Mapping[tuple[str, str], str]:
    """Keys of things by their words and the languages of these."""
    return {
        (heading(word), language): thing.key
        for thing in catalogue().values()
        for language, words in thing.names.items()
        for word in words
    }


def _speaks_of(told: str, word: str, language: str) -> bool:
    if word[0] >= _UNSPACED:
        return word in told
    before = "" if language == "de" and len(word) >= _COMPOUND else " "
    return any(f"{before}{word}{ending} " in f" {told} " for ending in _PLURALS)
