"""Common things with the sizes that they usually have, for lists that leave sizes out.

`things.csv` is the data: a row a thing, with ranges, and names in each language. All ranges are
assumed, from what such things commonly measure: no published table was read for them. A thing is
added as a row; no code is needed.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib import resources

from shaketable.inventory.item import BaseShape
from shaketable.inventory.vocabulary import heading

LANGUAGES = ("en", "es", "de", "it", "ja")
#: Endings of plurals, which a word in a list may have and the catalogue's need not.
_PLURALS = {
    "en": ("", "s", "es"), "es": ("", "s", "es"), "de": ("", "e", "n", "en", "er"), "it": ("",),
    "ja": ("",),
}  # fmt: skip
_COMPOUND = 5  # letters: shorter words end others by chance
_MORE = re.compile(r"(?<=\D)(?=\d)|[(\[,;/]")  # what comes then says which one it is
#: Of a thing that is another one's.
_JOINS = re.compile(
    r"(^|\s)(für|mit|auf|unter|neben|und|for|with|on|under|beside|and|para|con|sobre|junto|y|per|su|"
    r"sotto|e)(\s|$)|[&+]|用"
)


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


@lru_cache(maxsize=10_000)
def common_thing(name: str) -> CommonThing | None:
    """The thing of the catalogue that a name is, None if none.

    The name is one of its words, singular or plural, with what else it is called where the language
    puts that: before it in English and Japanese ("steel bookcase"), after it in Italian and Spanish
    ("armario alto"), both in German, also in one word ("Wandregal"). Numbers and what stands in
    brackets or after a comma do not count. What is for, with or on another thing is none.
    """
    told = heading(name)
    exact = [forms[told] for forms in _forms().values() if told in forms]
    if exact:
        return catalogue()[exact[0]]
    told = heading(_MORE.split(told)[0])
    if not told or _JOINS.search(told):
        return None
    found = [one for language in LANGUAGES for one in _parts(told, language)]
    return catalogue()[max(found)[1]] if found else None


@cache
def _forms() -> Mapping[str, Mapping[str, str]]:
    """Keys of things by their words, of each language, singular and plural."""
    return {
        language: {
            f"{heading(word)}{ending}": thing.key
            for ending in reversed(_PLURALS[language])  # a word itself comes before a plural
            for thing in catalogue().values()
            for word in thing.names[language]
        }
        for language in LANGUAGES
    }


def _parts(told: str, language: str) -> Iterator[tuple[int, str]]:
    """Words that a name begins or ends with: how long they are, and of what thing."""
    forms = _forms()[language]
    words = told.split()
    if language in ("en", "de"):
        ends = (" ".join(words[k:]) for k in range(len(words)))
        yield from ((len(each), forms[each]) for each in ends if each in forms)
    if language in ("de", "es", "it"):
        begins = (" ".join(words[: k + 1]) for k in range(len(words)))
        least = _COMPOUND if language == "de" else 1
        yield from (
            (len(each), forms[each]) for each in begins if each in forms and len(each) >= least
        )
    if language == "ja":
        bare = told.rstrip("abcdefghijklmnopqrstuvwxyz")
        yield from ((len(word), key) for word, key in forms.items() if bare.endswith(word))
    if language == "de":
        both = (told, told.removesuffix("n"))
        yield from (
            (len(word), key)
            for word, key in _ends_of_compounds().items()
            if any(each.endswith(word) for each in both)
        )


@cache
def _ends_of_compounds() -> Mapping[str, str]:
    """Keys of things by the German words that may end a longer one."""
    things = catalogue().values()
    words = ((heading(word), each.key) for each in things for word in each.names["de"])
    return {word: key for word, key in words if len(word) >= _COMPOUND}
