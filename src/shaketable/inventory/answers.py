"""Words in cells that answer yes or no, and what an object stands on."""

from __future__ import annotations

import re

from shaketable.inventory import hints
from shaketable.inventory.item import Castors
from shaketable.inventory.shapes import SHAPES
from shaketable.inventory.vocabulary import plain, words_of

YES_OR_NO = {word: meaning == "yes" for word, meaning in words_of("answers").items()}
CASTORS = {word: Castors(meaning) for word, meaning in words_of("castors").items()}
#: Words that answer whether something stands on castors, is anchored, or what its base is like.
#: Not those that stand in columns of any kind.
ANSWERING = frozenset({*YES_OR_NO, *CASTORS, *SHAPES, "oui", "non", "sim", "não"}) - {
    "", "-", "1", "0", "y", "n", "s", "j", "free", "libre", "libero", "libera", "loose", "frei",
    "lose", "box", "form", "円", "丸", "未", "済",
}  # fmt: skip
_FIRST = re.compile(r"([^,;:(\[/–-]+?)\s*[,;:(\[/–-]")


def answer_in(text: str) -> bool | None:
    """Yes or no, as a cell says it: "yes (4 bolts)", "no, planned"; None for what is neither."""
    word = plain(text)
    if word in YES_OR_NO:
        return YES_OR_NO[word]
    first = _FIRST.match(word)
    return YES_OR_NO.get(first[1]) if first else None


def anchored_in(text: str) -> bool | None:
    """The same of what is anchored, where what fixes it is an answer, too: "chain", "4 screws"."""
    answer, word = answer_in(text), plain(text)
    if answer is not None:
        return answer
    fixed = hints.fixed_by(word)
    return None if fixed and hints.doubts(word) else fixed


def castors_in(text: str) -> Castors | None:
    """What a cell says of castors: "yes" and "5, lockable" leave open whether they are locked.

    None for what cannot be understood.
    """
    word = plain(text)
    if word in CASTORS:
        return CASTORS[word]
    answer, rolls, locks = answer_in(text), hints.rolls_on(word), hints.locks_of(word)
    if answer is False or (rolls is False and not locks):
        return Castors.NONE
    if (answer, rolls, locks) == (None, None, None):
        return None
    if locks is False or _has(word, Castors.FREE):
        return Castors.FREE
    locked = _has(word, Castors.LOCKED) and not hints.doubts(word)
    return Castors.LOCKED if locked else Castors.SOME


def _has(text: str, castors: Castors) -> bool:
    """Whether one of the words for free or locked castors stands in a text."""
    words = "|".join(re.escape(word) for word, meaning in CASTORS.items() if meaning is castors)
    return re.search(rf"(?<![a-zà-ÿ])({words})(?![a-zà-ÿ])", text) is not None
