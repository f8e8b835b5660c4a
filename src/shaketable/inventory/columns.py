"""What the columns of an inventory are called, and the units in their names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches

from shaketable.errors import Fault, quoted, refused
from shaketable.language import tell
from shaketable.tables.sheet import HEADER_WITHIN, Cell, Sheet

#: Meanings, with the English words that people use for them; case, blanks and underscores do not
#: count.
WORDS = {
    "name": ("name", "item", "object", "equipment", "asset", "item name", "object name"),
    "depth": ("depth", "base depth", "d", "front to back"),
    "width": ("width", "base width", "w", "side to side"),
    "diameter": ("diameter", "base diameter", "dia"),
    "shape": ("shape", "base shape", "shape of base"),
    "height": ("height", "total height", "h"),
    "cg_height": (
        "cg height", "height of cg", "centre of gravity", "center of gravity",
        "height of centre of gravity", "height of center of gravity", "cg",
    ),
    "eccentricity": ("eccentricity",),
    "gyration_radius": ("gyration radius", "radius of gyration"),
    "support_length": ("support length", "shelf length", "length of support"),
    "rolling_friction": ("rolling friction",),
    "contour_friction": ("contour friction",),
    "drilling_friction": ("drilling friction",),
    "wall_gap": ("wall gap", "gap to wall", "distance to wall", "distance from wall"),
    "wall_side": ("wall side", "side of wall", "side of the wall"),
    "strap": ("strap", "straps"),
    "strap_strength": ("strap strength", "strength of strap", "strength of straps"),
    "pad": ("pad", "pads", "pull off of pads"),
    "edge": ("edge", "distance to edge", "distance from edge"),
    "lip": ("lip", "lip height", "height of lip"),
    "facing": ("facing", "facing deg", "front azimuth", "azimuth of front"),
    "x": ("x",),  # in a plan of its room; with its unit, as sheets have other columns of one letter
    "y": ("y",),
    "wall": ("wall", "wall number", "number of wall"),
    "castors": ("castors", "casters", "wheels", "on wheels", "on castors"),
    "mass": ("mass", "weight"),
    "quantity": ("quantity", "qty", "count", "pieces", "pcs"),
    "building": ("building",),
    "latitude": ("latitude", "lat"),
    "longitude": ("longitude", "lon", "long", "lng"),
    "floor": ("floor", "storey", "story", "level"),
    "location": ("location", "room", "place", "department", "ward"),
    "note": ("note", "notes", "remark", "remarks", "comment", "comments"),
    "critical": ("critical", "criticality"),
    "blocks_exit": ("blocks exit", "blocks way out", "exit"),
    "people_nearby": ("people nearby", "occupied", "people"),
    "must_not_fall": ("must not fall",),
    "anchored": (
        "anchored", "fixed", "bolted", "restrained", "bolted to wall", "fixed to wall",
        "anchored to wall",
    ),
}  # fmt: skip
#: The same in Spanish and German. Words that mean other things as well (asegurado: insured) and
#: second words for a place or a name are left out: they would stop a list, or be taken twice.
OTHERS = {
    "name": ("nombre", "objeto", "equipo", "bezeichnung", "gegenstand"),
    "depth": ("fondo", "profundidad", "tiefe"),
    "width": ("ancho", "anchura", "breite"),
    "diameter": ("diámetro", "diametro", "durchmesser", "ø"),
    "shape": (
        "forma", "forma de la base", "forma base", "form", "grundform", "form der grundfläche",
        "form des fußes",
    ),
    "height": ("alto", "altura", "höhe", "hoehe"),
    "cg_height": (
        "centro de gravedad", "altura del centro de gravedad", "schwerpunkt", "schwerpunkthöhe",
    ),
    "eccentricity": ("excentricidad", "exzentrizität"),
    "gyration_radius": ("radio de giro", "trägheitsradius"),
    "rolling_friction": ("fricción de rodadura", "rollreibung"),
    "contour_friction": ("fricción de contorno", "konturreibung"),
    "drilling_friction": ("fricción de giro", "bohrreibung"),
    "castors": (
        "ruedas", "con ruedas", "sobre ruedas", "rueditas", "ruedas libres o con freno", "rollen",
        "räder", "raeder", "auf rollen", "lenkrollen", "mit rollen",
    ),
    "mass": ("masa", "peso", "masse", "gewicht"),
    "quantity": ("cantidad", "anzahl", "stück", "stückzahl"),
    "building": ("edificio", "gebäude"),
    "latitude": ("latitud", "breitengrad"),
    "longitude": ("longitud", "längengrad"),
    "floor": ("piso", "planta", "stockwerk", "etage", "geschoss"),
    "location": ("ubicación", "ubicacion", "sala", "lugar", "ort", "raum", "zimmer"),
    "note": (
        "nota", "notas", "observaciones", "observación", "bemerkung", "bemerkungen", "anmerkung",
        "anmerkungen", "notiz", "notizen",
    ),
    "critical": ("crítico", "critico", "criticidad", "kritisch"),
    "blocks_exit": (
        "bloquea salida", "bloquea la salida", "blockiert fluchtweg", "blockiert ausgang",
    ),
    "people_nearby": ("personas cerca", "personen in der nähe"),
    "must_not_fall": (
        "no debe caer", "no debe volcarse", "darf nicht fallen", "darf nicht kippen",
    ),
    "anchored": (
        "anclado", "anclada", "anclaje", "fijo", "fijado", "fijo al muro", "fijado al muro",
        "anclado al muro", "fijo a la pared", "amarrado", "con cadena", "verankert",
        "verankerung", "befestigt", "befestigung", "fixiert", "an der wand befestigt",
        "wandbefestigung",
    ),
}  # fmt: skip
#: Lengths of friction against rolling and turning.
LOSSES = ("rolling_friction", "contour_friction", "drilling_friction")
LENGTHS = (
    "depth", "width", "diameter", "height", "cg_height", "gyration_radius", "support_length",
    "wall_gap", "edge", "lip", "x", "y", *LOSSES,
)  # fmt: skip
ZERO = ("wall_gap", "edge", "lip", "x", "y")  # may be none
PLAN = ("x", "y")
FORCES = ("strap_strength", "pad")
ANSWERS = ("blocks_exit", "people_nearby", "must_not_fall", "anchored")  # yes or no
METRES = {
    "m": 1.0, "metre": 1.0, "metres": 1.0, "meter": 1.0, "meters": 1.0,
    "cm": 0.01, "mm": 0.001,
    "in": 0.0254, "inch": 0.0254, "inches": 0.0254, "ft": 0.3048, "feet": 0.3048, "foot": 0.3048,
}  # fmt: skip
KILOGRAMS = {"kg": 1.0, "t": 1000.0, "g": 0.001, "lb": 0.45359237, "lbs": 0.45359237}
NEWTONS = {"n": 1.0, "kn": 1000.0, "dan": 10.0, "kgf": 9.80665, "lbf": 4.4482216}
#: Of what has units.
UNITS = {
    **dict.fromkeys(LENGTHS, METRES), "mass": KILOGRAMS, **dict.fromkeys(FORCES, NEWTONS)
}  # fmt: skip

_MEANINGS = {
    word: meaning for known in (WORDS, OTHERS) for meaning, words in known.items() for word in words
}
_ENGLISH = {word for words in WORDS.values() for word in words}
_LONG = [word for words in WORDS.values() for word in words if len(word) > 3]  # slips are seen
_UNIT = re.compile(r"[(\[]\s*([^()\[\]]*?)\s*[)\]]\s*$")
_NUMBER = re.compile(r"[-+]?\d[\d.,]*")
_GAPS = re.compile(r"[\s_.\-:]+")


@dataclass(frozen=True)
class Column:
    """A column as it was understood.

    Attributes:
        cell: its header.
        meaning: a key of WORDS.
        unit: as its name says; "m", "kg" or "n" where it says none, "" where it needs none.
        stated: whether the name says the unit.
    """

    cell: Cell
    meaning: str
    unit: str = ""
    stated: bool = False

    @property
    def factor(self) -> float:
        """One unit in metres, kilograms or newtons."""
        return UNITS[self.meaning][self.unit]


def is_header(texts: Iterable[str]) -> bool:
    """Whether a row names all that every inventory has."""
    found = {column.meaning for text in texts if (column := understood(Cell(text, "")))}
    return {"name", "height"} <= found and bool(found & {"depth", "width", "diameter"})


def understood(cell: Cell) -> Column | None:
    """What a header means, None if it says nothing known."""
    text = cell.text.lower()
    bracket = _UNIT.search(text)
    unit = ""
    if bracket:
        unit, text = bracket[1], text[: bracket.start()]
    words = _GAPS.sub(" ", text).strip()
    if words not in _MEANINGS and not unit:
        words, _, unit = words.rpartition(" ")
    meaning = _MEANINGS.get(words)
    units = UNITS.get(meaning or "", {})
    if meaning is None or (unit and unit not in units) or (meaning in PLAN and not unit):
        return None
    return Column(cell, meaning, unit or next(iter(units), ""), bool(unit))


def header_of(sheet: Sheet) -> tuple[list[Cell], list[list[Cell]]]:
    """The header and the rows with text below it: the header is the row with the most known names.

    Titles may stand above it.

    Raises:
        InputError: numbers above it, or another header below it: they belong to another table.
    """
    filled = list(sheet.filled())
    known = [sum(understood(cell) is not None for cell in row) for row in filled[:HEADER_WITHIN]]
    at = known.index(max(known)) if known and max(known) > 1 else 0
    for row in filled[:at]:
        if sum(_NUMBER.fullmatch(cell.text) is not None for cell in row) > 1:
            text = tell(
                "numbers stand above the header on {header}; begin the file with the header",
                header=filled[at][0].where,
            )
            raise refused(sheet.path, text, where=row[0].where)
    other = [row for row in filled if row is not filled[at] and is_header(c.text for c in row)]
    if other:
        text = tell(
            "a second header beside the one on {header}; put each table into a file of its own",
            header=filled[at][0].where,
        )
        raise refused(sheet.path, text, where=other[0][0].where)
    return (filled[at], filled[at + 1 :]) if filled else ([], [])


def columns_of(sheet: Sheet, header: list[Cell]) -> tuple[list[Column | None], list[Fault]]:
    """The columns, None for one that is not used, and the faults of the header."""
    if not header:
        text = tell("the file is empty; its first row must name the columns")
        return [], [Fault(sheet.path, "", "", "empty", text)]
    faults = []
    columns = [understood(cell) if cell.text else None for cell in header]
    for cell, column in zip(header, columns, strict=True):
        if column is None and cell.text and (meant := _meant(cell.text)):
            message = tell(
                "unknown column {column}; is {meant} meant?", column=quoted(cell.text), meant=meant
            )
            faults.append(sheet.fault(cell, "column", message))
    times = Counter(column.meaning for column in columns if column)
    faults += [
        sheet.fault(
            header[0],
            "column",
            tell(
                "{count} columns mean {meaning!r}: {columns}",
                count=count,
                meaning=meaning,
                columns=", ".join(
                    quoted(each.cell.text) for each in columns if each and each.meaning == meaning
                ),
            ),
        )
        for meaning, count in times.items()
        if count > 1
    ]
    missing = [meaning for meaning in ("name", "height") if meaning not in times]
    if not {"depth", "width", "diameter"} & times.keys():
        missing.append("depth")
    faults += [
        sheet.fault(
            header[0],
            "no column",
            tell("no column for the {meaning!r} of an object", meaning=meaning),
        )
        for meaning in missing
    ]
    if faults:
        faults.append(Fault(sheet.path, "", "", "accepted", accepted()))
    return columns, faults


def _meant(header: str) -> str:
    """The known word that a header resembles, "" if none: a slip would lose a column."""
    if header.startswith("#"):  # it is left out on purpose
        return ""
    bare = _GAPS.sub(" ", _UNIT.sub("", header.lower())).strip()
    begin, _, _ = bare.rpartition(" ")
    if bare in PLAN or begin in PLAN:  # "X" may be a column of ticks, "x direction" anything
        return ""
    if "length" in (bare, begin):
        return tell("depth (front to back) or width (side to side)")
    if bare in _MEANINGS or begin in _MEANINGS:  # with a unit that is none
        meaning = begin if begin in _MEANINGS else bare
        units = UNITS.get(_MEANINGS[meaning])
        if units:
            return tell("{meaning!r} in one of {units}", meaning=meaning, units=", ".join(units))
        english = meaning in _ENGLISH  # "Raum Nr" and "Forma pago" are columns of their own
        return f"{meaning!r}" if english else ""
    near = get_close_matches(bare, _LONG, 1, 0.8) or get_close_matches(begin, _LONG, 1, 0.8)
    return f"{near[0]!r}" if near else ""


def accepted() -> str:
    """The columns that are accepted, in words."""
    names = [f"{name}_{next(iter(UNITS[name]))}" if name in UNITS else name for name in WORDS]
    return tell(
        "accepted columns, in English (and in German and Spanish): {names}; name, depth (front to "
        "back) or width (side to side) or diameter, and height are needed; lengths may be in cm, "
        "mm, in or ft, as in 'height_cm' or 'Height (cm)'",
        names=", ".join(names),
    )
