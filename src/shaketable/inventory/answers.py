"""Words in cells that answer yes or no, and what an object stands on."""

from __future__ import annotations

from shaketable.inventory.item import Castors
from shaketable.inventory.shapes import SHAPES

YES_OR_NO = {
    **dict.fromkeys(
        ("yes", "y", "true", "1", "x", "bolted", "screwed", "fixed", "anchored",
         "sí", "si", "s", "verdadero", "anclado", "anclada", "fijo", "fija", "atornillado",
         "atornillada", "amarrado", "amarrada", "con cadena", "fijo al muro",
         "ja", "j", "wahr", "verankert", "verschraubt", "befestigt", "fixiert", "mit kette"),
        True,
    ),
    **dict.fromkeys(
        ("", "no", "n", "false", "0", "-", "free", "loose",
         "falso", "sin cadena", "sin anclaje", "sin anclar", "suelto", "suelta", "libre",
         "nein", "falsch", "lose", "ohne kette", "nicht verankert", "nicht befestigt"),
        False,
    ),
}  # fmt: skip
CASTORS = {
    **dict.fromkeys(
        ("none", "no", "-", "ninguna", "ninguno", "sin ruedas", "no tiene",
         "keine", "ohne", "ohne rollen", "nein"),
        Castors.NONE,
    ),
    **dict.fromkeys(
        ("free", "unlocked", "libre", "libres", "sin freno", "sin frenos", "sueltas",
         "frei", "frei rollend", "ohne bremse", "ungebremst"),
        Castors.FREE,
    ),
    **dict.fromkeys(
        ("locked", "braked", "con freno", "con frenos", "frenada", "frenadas", "frenado",
         "bloqueada", "bloqueadas", "trabadas",
         "gebremst", "mit bremse", "mit bremsen", "blockiert", "gesperrt", "festgestellt"),
        Castors.LOCKED,
    ),
}  # fmt: skip
#: Words that answer whether something stands on castors, is anchored, or what its base is like.
#: Not those that stand in columns of any kind.
ANSWERING = frozenset({*YES_OR_NO, *CASTORS, *SHAPES, "oui", "non", "sim", "não"}) - {
    "", "-", "1", "0", "y", "n", "s", "j", "free", "libre", "loose", "frei", "lose", "box", "form",
}  # fmt: skip
