"""Words in a name or a note that speak of castors."""

from __future__ import annotations

import re

_WORDS = re.compile(
    r"\b(castors?|casters?|wheel(s|ed)?|roll(s|ers?|ing)|trolleys?|carts?|gurneys?|mobile"
    r"|ventilators?|ana?esthesia (machine|workstation)|(iv|drip|infusion) (pole|stand))\b",
    re.IGNORECASE,
)


def speaks_of_castors(*texts: str) -> str:
    """The first word in the texts that goes with castors, "" if there is none."""
    return next((found[0] for text in texts if (found := _WORDS.search(text))), "")
