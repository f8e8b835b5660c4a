"""An empty inventory with examples, menus and explanations, to be filled in."""

from __future__ import annotations

from shaketable.errors import InputError
from shaketable.inventory.catalogue import LANGUAGES as NAMED_IN
from shaketable.inventory.catalogue import catalogue
from shaketable.inventory.columns import METRES, SIZES_OF_BODY, UNITS, written_heading
from shaketable.inventory.row_words import MOST_CRITICAL
from shaketable.inventory.vocabulary import ENGLISH, Vocabulary, first_word, vocabularies
from shaketable.tables.template import Question, Template

LENGTHS = ("cm", "mm", "m", "in")
YES_OR_NO = ("anchored", "blocks_exit", "people_nearby", "must_not_fall")
MENUS = {
    "castors": ("castors", ("none", "free", "locked")),
    "shape": ("shapes", ("box", "cylinder", "feet")),
    **dict.fromkeys(YES_OR_NO, ("answers", ("yes", "no"))),
    "critical": ("answers", ("yes", "no", *map(str, range(1, MOST_CRITICAL + 1)))),
}
#: Columns that few lists need, in English alone: they follow the others where all are asked for.
RARE = {
    "cg_height_m": "height of its centre of gravity; half the height if left empty",
    "eccentricity": "distance of its centre of gravity from the front, as a share of the depth; "
    "0.5 if empty",
    "gyration_radius_m": "about its centre of gravity; that of a uniform body if empty",
    "support_length_m": "length, front to back, of the table on whose middle it stands",
    "rolling_friction_mm": "what it loses as it rolls, in three dimensions: a length that, times "
    "its weight, is the moment against rolling; none if empty",
    "contour_friction_mm": "of a cylinder: a length that, times its weight and the rate at which "
    "its contact goes around the rim, is the power lost; none if empty",
    "drilling_friction_mm": "a length that, times its weight, is the moment against turning on the "
    "spot beyond that of its feet; none if empty",
    "facing_deg": "compass azimuth to which its front looks, degrees from north; if empty, it is "
    "turned in several ways to the motions",
    "wall_gap_mm": "distance to the wall behind it, in millimetres; empty if there is none near",
    "wall_side": "the side on which that wall is, and to which straps go: back, front, left or "
    "right; back if empty",
    "strap": "a strap from the middle of that side to the wall, as top:slack=5mm,stiffness=50kN/m; "
    "several with a semicolon between; it needs the mass",
    "strap_strength_n": "force at which each strap breaks, newtons; it is taken as unbreakable if "
    "empty",
    "pad": "force that pulls off one of its feet that are glued down, newtons; none if empty",
    "edge_mm": "distance from its front to the edge of the shelf or table on which it stands; "
    "empty on a floor",
    "lip_mm": "height of the lip at that edge",
    "replacement_cost": "of one, if it is lost, in any currency; hazard adds up the losses",
    "building": "which building it stands in, where there are several; may be empty",
    "latitude": "of the building, decimal degrees, for maps of shaking; may be empty",
    "longitude": "likewise",
    "x_m": "middle of its base in the plan of that room, to the right, metres; for shaketable room",
    "y_m": "likewise, upward",
    "wall": "number of the wall of that plan before which it stands: its back comes there, beside "
    "x_m and y_m; may be empty",
}
#: Things of the catalogue as examples: sizes [m], and answers that every language has a word for.
_EXAMPLES = {
    "bookcase": {"depth": 0.32, "width": 0.9, "height": 1.8, "quantity": 8, "location": "E12",
                 "blocks_exit": "yes", "people_nearby": "yes"},
    "bench-top analyser": {"depth": 0.6, "width": 0.8, "height": 0.5, "mass": 45, "quantity": 2,
                           "location": "E14", "critical": 4},
    "gas cylinder large": {"depth": 0.23, "height": 1.64, "shape": "cylinder", "mass": 65,
                           "quantity": 2, "location": "E14", "must_not_fall": "yes"},
    "crash cart": {"depth": 0.5, "width": 0.7, "height": 1.1, "castors": "locked", "quantity": 3,
                   "location": "E20", "critical": 5},
}  # fmt: skip


def inventory_template(
    language: str = ENGLISH, *, lengths: str = "cm", every: bool = False
) -> Template:
    """An empty inventory, with a sheet for the building.

    Args:
        language: of its headings, menus and explanations, one that has a file in `words`.
        lengths: unit of the sizes, one of LENGTHS.
        every: whether columns that few lists need are there, too, in English.

    Raises:
        InputError: another language or unit.
    """
    words = {each.language: each for each in vocabularies()}
    for given, accepted in ((language, words), (lengths, LENGTHS)):
        if given not in accepted:
            raise InputError(f"expected one of {', '.join(accepted)}, found {given!r}")
    own = words[language]
    names = {meaning: written_heading(own, meaning, lengths) for meaning in own.explained}
    explained = {names[meaning]: text for meaning, text in own.explained.items()}
    return Template(
        title=own.values["sheets"]["objects"][0],
        explained=explained | (RARE if every else {}),
        examples=[
            {names[column]: _example(language, column, value, lengths)
             for column, value in {"name": key, **values}.items()}
            for key, values in _EXAMPLES.items()
        ],
        menus={
            names[meaning]: [
                each if each.isdecimal() else first_word(language, table, each) for each in values
            ]
            for meaning, (table, values) in MENUS.items()
        },
        suggested={names["name"]: _common_names(language)},
        numbers={
            **{names[each]: False for each in (*SIZES_OF_BODY, "mass") if each in names},
            names["quantity"]: True,
        },
        explanations=own.values["sheets"]["columns"][0],
        asked={own.values["sheets"]["building"][0]: _of_building(own)},
    )  # fmt: skip


def _example(language: str, column: str, value: object, lengths: str) -> object:
    if column == "name":
        return catalogue()[str(value)].names[language][0]
    if column in MENUS and isinstance(value, str):
        return first_word(language, MENUS[column][0], str(value))
    if UNITS.get(column) is METRES and isinstance(value, float):
        return round(value / METRES[lengths], 4)
    return value


def _common_names(language: str) -> list[str]:
    """What the catalogue calls its things, in the order of their letters."""
    named = language if language in NAMED_IN else ENGLISH
    return sorted((thing.names[named][0] for thing in catalogue().values()), key=str.lower)


def _of_building(own: Vocabulary) -> list[Question]:
    """What the sheet of the building asks for."""
    structures = [words[0] for words in own.values["structures"].values()]
    return [
        Question(
            name=words[0][:1].upper() + words[0][1:],
            explained=own.explained_building.get(meaning, ""),
            menu=structures if meaning == "structure" else (),
        )
        for meaning, words in own.values["building"].items()
    ]
