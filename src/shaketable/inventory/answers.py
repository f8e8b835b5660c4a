"""Words in cells that answer yes or no, and what an object stands on."""

from __future__ import annotations

from shaketable.inventory.item import Castors
from shaketable.inventory.shapes import SHAPES
from shaketable.inventory.vocabulary import words_of

YES_OR_NO = {word: meaning == "yes" for word, meaning in words_of("answers").items()}
CASTORS = {word: Castors(meaning) for word, meaning in words_of("castors").items()}
#: Words that answer whether something stands on castors, is anchored, or what its base is like.
#: Not those that stand in columns of any kind.
ANSWERING = frozenset({*YES_OR_NO, *CASTORS, *SHAPES, "oui", "non", "sim", "não"}) - {
    "", "-", "1", "0", "y", "n", "s", "j", "free", "libre", "libero", "libera", "loose", "frei",
    "lose", "box", "form", "円", "丸", "未", "済",
}  # fmt: skip
