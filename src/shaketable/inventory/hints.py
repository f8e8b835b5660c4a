"""Words in a name or a note that say what a column should say."""

from __future__ import annotations

import re

_CASTORS = re.compile(
    r"(?<!no )(?<!not on )(?<!without )\b(castors?|casters?|wheel(s|ed)?|wheelchairs?|rolls"
    r"|rollers?|rolling|roll ?containers?|rollators?|rollwagen|doll(y|ies)|trolleys?|carts?"
    r"|gurneys?|stretchers?|hospital beds?|mobile|ventilators?"
    r"|ana?esthesia (machine|workstation)|(iv|drip|infusion) (pole|stand))\b",
    re.IGNORECASE,
)
_ANCHORED = re.compile(
    r"(?<!not )(?<!un)\b(anchored|bolted|screwed|strapped|fastened|chained)\b", re.IGNORECASE
)
_KEPT = re.compile(
    r"\bmust (not|never) fall\b"
    r"|\b(gas|oxygen|nitrogen|acetylene|hydrogen|co2) (cylinder|bottle)s?\b",
    re.IGNORECASE,
)
_ROUND = re.compile(r"\b(cylinders?|bottles?|drums?|barrels?|vases?|urns?|bins?)\b", re.IGNORECASE)


def mentions_castors(*texts: str) -> bool:
    """Whether a text has a word that goes with castors."""
    return any(_CASTORS.search(text) for text in texts)


def mentions_anchors(*texts: str) -> bool:
    """Whether a text says that something is anchored."""
    return any(_ANCHORED.search(text) for text in texts)


def mentions_round(name: str) -> bool:
    """Whether a name is that of something round."""
    return _ROUND.search(name) is not None


def must_be_kept(*texts: str) -> bool:
    """Whether a text speaks of what must not fall, such as gas cylinders."""
    return any(_KEPT.search(text) for text in texts)
