"""Numbers as people write them: about, in feet and inches, with fractions, and diameters."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import NamedTuple

from shaketable.inventory.vocabulary import vocabularies

_ABOUT = "|".join(
    sorted((each for one in vocabularies() for each in one.hints["about"]), key=len, reverse=True)
)
#: Words before or behind a number that say that it is not exact.
ABOUT = re.compile(rf"^\s*(?:{_ABOUT})\s*(?=\D*\d)|(?<=[\d\s.])(?:{_ABOUT})\s*$", re.IGNORECASE)
_ROUND = re.compile(r"^\s*(?:ø|φ|⌀|径|直径|diam\.?|dia\.?|dm\.?)\s*(?=\d)", re.IGNORECASE)
#: Between groups of three digits: 1'850 and 1 850.
_GROUPS = re.compile(r"(?<=\d)['’\u00a0\u2009 ](?=\d{3}(?!\d))")
_QUARTERS = {"½": " 1/2", "¼": " 1/4", "¾": " 3/4"}
_FRACTION = re.compile(r"(?:(\d+)[\s-]+)?(\d+)/(\d+)")
_FEET = re.compile(
    r"(\d+)\s*(?:'|’|′|ft\.?|feet)\s*-?\s*(?:([\d./ ]+)\s*(?:\"|”|″|''|in\.?|inches)?)?"
)
_INCHES = re.compile(r"([\d./ ]+?)\s*(?:\"|”|″|''|-?inch(?:es)?\.?|in\.)")


class Written(NamedTuple):
    """A number without what is written around it.

    Attributes:
        text: the number, and its unit if one stands there.
        about: whether it was said not to be exact.
        across: whether it was said to be a diameter.
    """

    text: str
    about: bool = False
    across: bool = False


def written(text: str, *, imperial: bool = True) -> Written:
    """A number as it is written, without words; inches and feet in inches.

    Args:
        text: of a cell.
        imperial: whether it may be in feet, inches and fractions, as lengths are.
    """
    bare = ABOUT.sub("", text).strip()
    across = _ROUND.sub("", bare)
    number = _GROUPS.sub("", across)
    if not imperial:
        return Written(number.strip(), bare != text.strip(), across != bare)
    for sign, fraction in _QUARTERS.items():
        number = number.replace(sign, fraction)
    number = _in_inches(number.strip())
    return Written(number, bare != text.strip(), across != bare)


def _in_inches(text: str) -> str:
    """Feet and inches as inches, fractions as decimals; any other text as it is."""
    feet = _FEET.fullmatch(text)
    if feet:
        inches = _decimal(feet[2].strip()) if feet[2] and feet[2].strip() else Fraction(0)
        return text if inches is None else f"{_told(12 * int(feet[1]) + inches)} in"
    inch = _INCHES.fullmatch(text)
    value = _decimal(inch[1].strip()) if inch else None
    if value is not None:
        return f"{_told(value)} in"
    begin, _, unit = text.rpartition(" ")
    for number, behind in ((text, ""), (begin, unit)):
        if _FRACTION.fullmatch(number.strip()) and (value := _decimal(number.strip())) is not None:
            return f"{_told(value)} {behind}".strip()
    return text


def _decimal(text: str) -> Fraction | None:
    """A whole number, a decimal one or one with a fraction, None for anything else."""
    found = _FRACTION.fullmatch(text)
    try:
        if found:
            return Fraction(int(found[1] or 0)) + Fraction(int(found[2]), int(found[3]))
        return Fraction(text)
    except (ValueError, ZeroDivisionError):
        return None


def _told(value: Fraction) -> str:
    return f"{float(value):.10g}"
