"""Decimal points and commas of the numbers in a table."""

from __future__ import annotations

import re

from shaketable.errors import quoted
from shaketable.language import tell, translated
from shaketable.tables.sheet import THOUSANDS, Sheet

_COMMA = re.compile(r"[-+]?\d*,\d+")
_POINTS_AND_COMMA = re.compile(r"\d{1,3}(\.\d{3})+,\d+")
_COMMAS_AND_POINT = re.compile(r"\d{1,3}(,\d{3})+\.\d+")


def with_a_point(sheet: Sheet, text: str, decimal: str = "") -> tuple[str, str]:
    """A number's text with a decimal point, or what is wrong with it.

    Args:
        sheet: where it stands.
        text: of the number.
        decimal: the sign that other numbers beside it tell: "." or ","; anything else for one of
            which they leave a doubt, "" where they say nothing.
    """
    if _POINTS_AND_COMMA.fullmatch(text):
        return text.replace(".", "").replace(",", "."), ""
    if _COMMAS_AND_POINT.fullmatch(text):
        return text.replace(",", ""), ""
    comma = bool(_COMMA.fullmatch(text))
    if THOUSANDS.fullmatch(text):
        sign = "," if comma else "."
        if decimal in (".", ","):
            return text.replace(sign, "." if sign == decimal else ""), ""
        usual = sheet.decimal_signs
        if decimal or (comma and usual != {","}) or (not comma and "," in usual):
            one, many = text.replace(sign, "."), text.replace(sign, "")
            message = tell(
                "found {found}, which may be {one:g} or {many}; write it without a {sign}, or with "
                "another number of decimals",
                found=quoted(text),
                one=float(one),
                many=many,
                sign=translated("comma" if comma else "point"),
            )
            return text, message
    return text.replace(",", ".") if comma else text, ""
