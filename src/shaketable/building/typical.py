"""The first period of a building of which only its structure and its height are known."""

from __future__ import annotations

from typing import NamedTuple

from shaketable.errors import InputError
from shaketable.language import tell

MOST_STOREYS = 200
STOREY_HEIGHT = 3.2  # m, where none is given
#: Periods of buildings of one structure and height, as shares of the typical one: assumed. A code
#: gives short ones, as these mean larger forces.
VARIED = (0.7, 1.0, 1.4)
SOURCE = (
    "approximate period of ASCE 7, as Taly, Design of Reinforced Masonry Structures, Table 7.4 "
    "prints its coefficients"
)


class PeriodOfHeight(NamedTuple):
    """Coefficients of T = c h^x, T in seconds and h in metres."""

    c: float
    x: float


OTHER = PeriodOfHeight(0.0488, 0.75)
STRUCTURES = {
    "concrete frame": PeriodOfHeight(0.0466, 0.9),
    "steel frame": PeriodOfHeight(0.0724, 0.8),
    "braced steel frame": OTHER,  # those with eccentric braces have longer periods
    "concrete walls": OTHER,
    "masonry": OTHER,
    "timber": OTHER,
}


def typical_period(structure: str, storeys: int, storey_height: float = STOREY_HEIGHT) -> float:
    """The first period that is typical of a structure [s].

    T = c h^x with the coefficients of ASCE 7 (Taly, Design of Reinforced Masonry Structures,
    equation 7.59 and Table 7.4), h from the base to the roof.

    Args:
        structure: one of STRUCTURES.
        storeys: above the ground.
        storey_height: of each [m].

    Raises:
        InputError: another structure, or a height that storeys do not have.
    """
    known = STRUCTURES.get(structure)
    if known is None:
        raise InputError(
            tell(
                "structure: accepted are {accepted}, found {found!r}",
                accepted=", ".join(STRUCTURES),
                found=structure,
            )
        )
    if not (isinstance(storeys, int) and 1 <= storeys <= MOST_STOREYS):
        raise InputError(
            tell(
                "storeys: a whole number from 1 to {most} is expected, found {found!r}",
                most=MOST_STOREYS,
                found=storeys,
            )
        )
    if not 2.0 <= storey_height <= 10.0:
        raise InputError(
            tell(
                "storey_height_m: from 2 to 10 m are expected, found {found:g}",
                found=storey_height,
            )
        )
    return float(known.c * (storeys * storey_height) ** known.x)
