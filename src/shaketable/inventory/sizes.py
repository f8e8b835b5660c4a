"""Several sizes in one cell: "180x90x32", "H. 60 x W. 36 x D. 18 in", "φ232×H1450".

Their order stands in the heading ("Size H x W x D (cm)"), or each has its letter or word beside it.
"""

from __future__ import annotations

import re
from functools import cache
from typing import NamedTuple

from shaketable.inventory.lengths import ABOUT
from shaketable.inventory.vocabulary import heading, headings, hint, normalized, plain

SIZES = ("height", "width", "depth", "length", "diameter")
LETTERS = {"a": "", "f": "depth", "an": "width", "al": "height", "fo": "depth", "pr": "depth",
           "h": "height", "w": "width", "b": "width", "d": "depth", "t": "depth", "p": "depth",
           "l": "length", "ø": "diameter", "φ": "diameter", "⌀": "diameter", "径": "diameter",
           "dm": "diameter", "diam": "diameter", "dia": "diameter"}  # fmt: skip
#: What a user may write where the heading says no order: height, width, depth.
SPELLED = {"hwd": "h w d", "hdw": "h d w", "wdh": "w d h", "dwh": "d w h", "whd": "w h d",
           "dhw": "d h w"}  # fmt: skip
UNITS = ("mm", "cm", "m", "inches", "inch", "in", "ft", "feet", "ミリ", "センチ")
_BETWEEN = r"\.?\s*[x×*✕✖/]\s*"
_NUMBER = r"\d+(?:[.,]\d+)*(?:\s+\d+/\d+)?"
_QUOTES = "\"”″'’′"
#: The same in another unit.
_DATE = re.compile(r"\d{1,4}/\d{1,2}(/\d{1,4})?")
_AFTER_NUMBERS = re.compile(
    r"\s*(?:[(\[][\d.,\s/x×*✕\"'”″-]+(?:mm|cm|m|in|inch(?:es)?|ft|feet)?\.?[)\]]\s*)?[.;]?\s*"
)


class Part(NamedTuple):
    """One of several sizes in a cell.

    Attributes:
        meaning: of SIZES, "" where nothing beside it tells.
        text: its number.
        unit: beside it, or beside the last one; "" without any.
    """

    meaning: str
    text: str
    unit: str


#: Of a heading: what is no size of the object itself, such as that of its packing.
OTHER_SIZES = hint("other_sizes")


@cache
def _words() -> dict[str, str]:
    """Letters and words that say which size is meant."""
    found = {word: meaning for word, meaning in headings().items() if meaning in SIZES}
    return {**LETTERS, **found, **{letter: each for letter, each in LETTERS.items() if each}}


@cache
def _word() -> str:
    """A pattern of them, the longest first."""
    return "|".join(re.escape(each) for each in sorted(_words(), key=len, reverse=True))


@cache
def _order() -> re.Pattern[str]:
    one = f"({_word()})"
    return re.compile(
        rf"(?<![^\W\d_]){one}{_BETWEEN}{one}(?:{_BETWEEN}{one})?(?![^\W\d_])", re.IGNORECASE
    )


@cache
def _part() -> re.Pattern[str]:
    units = "|".join([*UNITS, "''", *_QUOTES])
    return re.compile(
        rf"\s*(?:(?P<before>{_word()})\s*[.:=]?\s*)?(?P<number>{_NUMBER})\s*"
        rf"(?P<unit>(?:{units})(?![^\W\d_]|['\"]))?\.?\s*"
        rf"(?(before)|(?:\(?(?P<after>{_word()})\.?\)?(?![^\W\d_]))?)"
        rf"\s*(?P<behind>(?:{units})(?![^\W\d_]|['\"]))?"
        rf"\s*(?P<between>[x×*✕✖·;/]|,(?!\d)|by\b|(?=(?:{_word()})[\s.:=]*\d))?",
        re.IGNORECASE,
    )


def order_in(text: str) -> tuple[str, ...]:
    """Meanings of the sizes that a heading names one after another; () if it names none so.

    One of them is the height. A length is the side of the base that is not named.
    """
    spelled = SPELLED.get(heading(text).removeprefix("size ").partition(" ")[0])
    if spelled and heading(text).startswith("size "):
        return tuple(LETTERS[each] for each in spelled.split())
    found = _order().search(plain(text))
    if not found or OTHER_SIZES.search(_order().sub(" ", plain(text))):
        return ()
    order = _with_sides(_with_a([_words()[each] for each in found.groups() if each]))
    return tuple(order) if "height" in order and len(set(order)) == len(order) else ()


def _with_a(meanings: list[str]) -> list[str]:
    """Meanings with an A, of alto or altezza and of ancho, as the one that is not named."""
    return [each or ("height" if "height" not in meanings else "width") for each in meanings]


def letters_of(order: tuple[str, ...]) -> str:
    """An order as it is spelled in a name: "hwd"; "" for one that has no such name."""
    letters = "".join(each[0] for each in order)
    return letters if letters in SPELLED else ""


def unit_beside_order(text: str) -> str:
    """The unit that a heading names beside an order, "" if it names none."""
    rest = _order().sub(" ", plain(text)) if _order().search(plain(text)) else plain(text)
    words = [each for each in re.split(r"[\s_()\[\],;:/（）、]+", rest.replace(".", " ")) if each]
    known = [each for each in words if each in UNITS]
    # "in" is a word before a unit, and a unit where no other one stands
    return next((each for each in known if each != "in"), known[-1] if known else "")


def parts_of(text: str) -> list[Part]:
    """The sizes in a cell, in their order; [] if it is not several sizes.

    What stands in brackets behind all of them is the same in another unit.
    """
    rest = ABOUT.sub("", normalized(text)).replace("''", '"')
    if _DATE.fullmatch(rest.strip()):
        return []
    found: list[re.Match[str]] = []
    at = 0
    while match := _part().match(rest, at):
        found.append(match)
        at = match.end()
        if match["between"] is None:
            break
    if len(found) < 2:
        return []
    order = order_in(rest[at:])
    units = [each["unit"] or each["behind"] or "" for each in found]
    unit = next((each for each in reversed(units) if each), "")
    words = _words()
    meanings = [words.get((each["before"] or each["after"] or "").lower(), "") for each in found]
    if sorted(map(bool, meanings)) == [False, True] and "diameter" in meanings:
        meanings = [each or "height" for each in meanings]
    if not _AFTER_NUMBERS.fullmatch(rest[at:]) and not order:
        return []
    if not any(meanings) and len(order) == len(found):
        meanings = list(order)
    return [
        Part(meaning, each["number"], (own or unit).lower())
        for meaning, each, own in zip(_with_sides(meanings), found, units, strict=True)
    ]


def _with_sides(meanings: list[str]) -> list[str]:
    """Meanings with a length as the side of the base that is not named; as it is if neither is."""
    sides = {"depth": "width", "width": "depth"}
    side = next((sides[each] for each in meanings if each in sides), "length")
    return [side if each == "length" else each for each in meanings]
