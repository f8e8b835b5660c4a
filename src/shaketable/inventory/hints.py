"""Words in a name, a note or an unknown column that say what a column should say.

In the languages of `words`. A word after "no", "without" and their likes says nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from shaketable.inventory.vocabulary import hint, plain

#: A denial, and at most three words up to what it denies.
_DENIED = hint("denied", after=r"\b(\s+\w+){0,3}\s*$")
_NONE = hint("none", before=r"\s*[:=]\s*")
_MISSING = hint("missing", before=r"\s*[:=(,]?\s*")


#: Words before what carries an object: "on the wall unit".
_CARRIED = hint("carried", after=r"\s*$")


def _said(pattern: re.Pattern[str], text: str, but: re.Pattern[str] | None = None) -> bool | None:
    """Whether a text has a pattern that is not denied; None where it has none.

    A denial stands before it, or after it ("wheels: none").

    Args:
        pattern: of words.
        text: in which they are sought.
        but: what must not stand before them.
    """
    found = [
        each for each in pattern.finditer(text) if not (but and but.search(text[: each.start()]))
    ]
    if not found:
        return None
    return any(
        not _DENIED.search(text[: each.start()])
        and not _NONE.match(text[each.end() :])
        and not _MISSING.match(text[each.end() :])
        for each in found
    )


_CASTORS = hint("castors")
_ANCHORED = hint("anchored")
_KEPT = hint("kept")
_ROUND = hint("round")
_HANGS = hint("hangs")
_FIXING = hint("fixing", after="")
_DOUBT = hint("doubt")
_LOCKS = hint("locks", before="", after="")
_ON_TOP = hint("on_top")
_ON_A_STAND = hint("on_stand")
#: What is fastened to the building, or built in, and carries things.
_FASTENED = hint("fastened")
#: Of a location: furniture on which things stand.
_FURNITURE = hint("furniture", after=r"\s*\d*\s*$")
#: Of a header: what may be about castors, anchors or shapes.
_MAY_SAY = hint("may_say", after="")
#: Words of languages without a file, for that alone: ruotă, roulettes, roue, rodízio, fixação.
_MAY_SAY_ELSEWHERE = re.compile(
    r"\b(ruot|roulett|roues?\b|rod[íi]zi|rodas\b|trava\b|ancl[éa]|ancr|form(a|e)?\b|"
    r"fix[éea]|s[ée]curis|attach|scell|preso\b|chumb|vast(gezet)?\b|verankerd|wiel|kotw|kół|zamocow|"
    r"koleč|hjul|förank|fastg|pyör|kiinni|tekerlek|sabit|rögz|kerek|закреп|колес|крепл)",
    re.IGNORECASE,
)
#: Yes and no and nothing more: below a header of something else they are about that.
YES_OR_NO = {
    "yes", "y", "true", "1", "x", "no", "n", "false", "0", "-", "ja", "j", "wahr", "nein", "falsch",
    "sí", "si", "s", "verdadero", "falso", "sì", "vero", "oui", "non", "sim", "não", "はい", "有",
    "有り", "あり", "○", "〇", "◯", "いいえ", "無", "無し", "なし", "×",
}  # fmt: skip
#: Of a header: a word, or letters of a language in which one of them may be a word.
_A_WORD = re.compile(r"[^\W\d_]{3}|[\u3000-\u9fff]")
#: Of a header: what may say on what objects stand.
_STANDS = hint("stands")
#: Headers that the patterns above would take, and that are about something else.
_ELSE = hint("else", before="", after="")


def mentions_castors(*texts: str) -> bool:
    """Whether a text has a word that goes with castors."""
    return any(_said(_CASTORS, text) for text in texts)


def rolls_on(text: str) -> bool | None:
    """Whether a cell of castors names them, or denies them; None where it does neither."""
    return _said(_CASTORS, text)


def mentions_anchors(*texts: str) -> bool:
    """Whether a text says that something is anchored."""
    return any(_said(_ANCHORED, text, but=_CARRIED) for text in texts)


def mentions_round(name: str) -> bool:
    """Whether a name is that of something round."""
    return bool(_said(_ROUND, name))


def must_be_kept(*texts: str) -> bool:
    """Whether a text speaks of what must not fall, such as gas cylinders."""
    return any(_KEPT.search(text) for text in texts)


def mentions_hanging(*texts: str) -> bool:
    """Whether a text says that something hangs, or is fixed to a wall or a ceiling."""
    return any(_said(_HANGS, text, but=_CARRIED) for text in texts)


def fixed_by(text: str) -> bool | None:
    """Whether a cell of what fixes an object names it (a chain, screws) or denies it, or None."""
    said = _said(_FIXING, text), _said(_ANCHORED, text)
    return None if said == (None, None) else any(said)


def doubts(text: str) -> bool:
    """Whether a cell says that something may not be so: planned, missing, in part, "?"."""
    return bool(_DOUBT.search(text)) or "?" in text or "？" in text


def locks_of(text: str) -> bool | None:
    """Whether a cell of castors says that they can be locked, or not; None without a word of it."""
    return _said(_LOCKS, text)


def what_it_stands_on(text: str) -> str:
    """Which words say that something stands on another thing, or is stacked; "" if none do."""
    found = _ON_TOP.search(text)
    return found[0] if found else ""


def on_a_stand(text: str) -> str:
    """Which words say that something stands on a stand; "" if none do."""
    found = _ON_A_STAND.search(text)
    return found[0] if found else ""


def is_fastened(text: str) -> bool:
    """Whether a text names something that carries things and is fastened, such as a bench."""
    return _FASTENED.search(text) is not None


def is_furniture(location: str) -> bool:
    """Whether a location is one on which things stand, as "laboratory shelf"."""
    return _FURNITURE.search(location) is not None


def may_say_what_it_stands_on(header: str) -> bool:
    """Whether the header of an unknown column speaks of what objects stand on."""
    return _STANDS.search(header) is not None


def is_about_what_decides(header: str) -> bool:
    """Whether a header has a word that goes with castors, anchors or shapes."""
    may = _MAY_SAY.search(header) or _MAY_SAY_ELSEWHERE.search(header)
    return may is not None and not _ELSE.search(header)


def may_say_what_decides(header: str, values: Iterable[str], answers: Iterable[str]) -> bool:
    """Whether an unknown column may say what decides: castors, anchors or shapes of objects.

    By its header, by the values of most rows, or as all of its values are answers. Yes and no below
    a word of something else, such as "warranty", say that.

    Args:
        header: of the column.
        values: of its cells.
        answers: words that answer castors, anchored or shape, in lower case.
    """
    known = set(answers)
    told = [plain(value) for value in values if value.strip()]
    if is_about_what_decides(header):
        return True
    like = sum(bool(_said(_CASTORS, each) or _said(_ANCHORED, each)) for each in told)
    unrelated = _A_WORD.search(plain(header)) is not None and set(told) <= YES_OR_NO
    answered = all(each in known for each in told) and not unrelated
    return bool(told) and (2 * like > len(told) or answered)
