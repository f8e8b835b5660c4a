"""Which numbers an object cannot have, alone or together, and which furniture does not have."""

from __future__ import annotations

import math
from collections.abc import Mapping

from shaketable.errors import Fault
from shaketable.inventory.cells import Cells
from shaketable.inventory.columns import LOSSES, METRES, PLAN, ZERO
from shaketable.language import tell, translated
from shaketable.tables.sheet import Sheet

LOWEST = 0.05  # of its height: no centre of gravity is lower
LONGEST_SUPPORT = 20.0  # m
FARTHEST = 5.0  # m: a wall or an edge beyond that is none
LARGEST_ROOM = 200.0  # m: a place in a plan beyond that is in another unit
LONGEST_LOSS = 0.05  # m: rolling friction of a few millimetres is much
DENSITIES = (5.0, 25_000.0)  # kg/m³ within its sizes: an empty basket; more than solid lead
MOST_OBJECTS = 1_000_000  # of one kind
BASES = ("depth", "width", "diameter")
IMPLAUSIBLE = "implausible"  # the kind of a fault: of a number that furniture does not have
NOT_EXPECTED = "is not to be expected of furniture"
FURNITURE = (0.02, 5.0)  # m: sizes beyond these are hardly in metres


def contradictions(numbers: Mapping[str, float]) -> list[tuple[str, str]]:
    """What a row's numbers cannot be, or cannot be together: which, and why."""
    faults = []
    one = [meaning for meaning in PLAN if meaning in numbers]
    if len(one) == 1:
        faults.append((one[0], tell("is given alone: a place in a plan has an x and a y")))
    quantity = numbers.get("quantity", 1.0)
    if quantity != int(quantity):
        message = tell("expected a whole number, found {quantity:g}", quantity=quantity)
        faults.append(("quantity", message))
    elif quantity > MOST_OBJECTS:
        message = tell(
            "found {quantity:g}; at most {most:,} accepted", quantity=quantity, most=MOST_OBJECTS
        )
        faults.append(("quantity", message))
    eccentricity = numbers.get("eccentricity", 0.5)
    if eccentricity >= 1.0:
        message = tell(
            "must lie between 0 and 1, where the centre of gravity is inside the base; found "
            "{eccentricity:g}",
            eccentricity=eccentricity,
        )
        faults.append(("eccentricity", message))
    if "diameter" in numbers and numbers.keys() & {"depth", "width"}:
        message = tell("is given beside a depth or width; give the one or the other")
        faults.append(("diameter", message))
    base = next(numbers[size] for size in BASES if size in numbers)
    length = numbers.get("support_length", math.inf)
    if length < base:
        message = tell(
            "found {length:g} m, shorter than the base of {base:g} m that stands on it",
            length=length,
            base=base,
        )
        faults.append(("support_length", message))
    cg_height, height = numbers.get("cg_height", 0.0), numbers["height"]
    if cg_height >= height:
        message = tell(
            "{cg_height:g} m is not inside the body of height {height:g} m",
            cg_height=cg_height,
            height=height,
        )
        faults.append(("cg_height", message))
    radius = numbers.get("gyration_radius", 0.0)
    if not faults and radius > (most := largest_gyration_radius(base, numbers)):
        message = tell(
            "found {radius:g} m; a body within its base and height with this centre of gravity has "
            "at most {most:.3g} m",
            radius=radius,
            most=most,
        )
        faults.append(("gyration_radius", message))
    return faults


def implausible(sheet: Sheet, cells: Cells, numbers: Mapping[str, float]) -> list[Fault]:
    """Sizes that no furniture has, with the unit that they may be in."""
    faults = []
    for meaning in (*BASES, "height"):
        size = numbers.get(meaning)
        if size is None or meaning not in cells or FURNITURE[0] <= size <= FURNITURE[1]:
            continue
        cell, column = cells[meaning]
        likely = [
            tell(
                "{size:g} m, if it is in {unit}",
                size=size / column.factor * METRES[unit],
                unit=unit,
            )
            for unit in ("cm", "mm", "m")
            if unit != column.unit
            and FURNITURE[0] <= size / column.factor * METRES[unit] <= FURNITURE[1]
        ]
        message = tell("{size:g} m {implausible}", size=size, implausible=translated(NOT_EXPECTED))
        if likely:
            message += tell(" (it would be {sizes})", sizes=tell(" and ").join(likely))
        faults.append(sheet.fault(cell, IMPLAUSIBLE, message, column.cell.text))
    cg_height = numbers.get("cg_height", math.inf)
    if "cg_height" in cells and cg_height < LOWEST * numbers["height"]:
        cell, column = cells["cg_height"]
        message = tell(
            "a centre of gravity {cg_height:g} m above the floor {implausible}, of a height of "
            "{height:g} m; is it in another unit?",
            cg_height=cg_height,
            implausible=translated(NOT_EXPECTED),
            height=numbers["height"],
        )
        faults.append(sheet.fault(cell, IMPLAUSIBLE, message, column.cell.text))
    for meaning, longest in {
        "support_length": LONGEST_SUPPORT, **dict.fromkeys(LOSSES, LONGEST_LOSS),
        **dict.fromkeys(ZERO, FARTHEST), **dict.fromkeys(PLAN, LARGEST_ROOM),
    }.items():  # fmt: skip
        if numbers.get(meaning, 0.0) <= longest:
            continue
        cell, column = cells[meaning]
        message = tell(
            "{length:g} m {implausible}; is it in another unit?",
            length=numbers[meaning],
            implausible=translated(NOT_EXPECTED),
        )
        faults.append(sheet.fault(cell, IMPLAUSIBLE, message, column.cell.text))
    return faults or _too_light_or_heavy(sheet, cells, numbers)


def _too_light_or_heavy(sheet: Sheet, cells: Cells, numbers: Mapping[str, float]) -> list[Fault]:
    """A mass that nothing of these sizes has."""
    if "mass" not in numbers or "mass" not in cells:
        return []
    given = [numbers[size] for size in BASES if size in numbers]
    volume = given[0] * given[-1] * numbers["height"]  # square, where only one size is known
    density = numbers["mass"] / volume
    if DENSITIES[0] <= density <= DENSITIES[1]:
        return []
    cell, column = cells["mass"]
    message = tell(
        "{mass:g} kg in {volume:.2g} m³ {implausible}: {least:g} to {most:,.0f} kg/m³ are expected",
        mass=numbers["mass"],
        volume=volume,
        implausible=translated(NOT_EXPECTED),
        least=DENSITIES[0],
        most=DENSITIES[1],
    )
    return [sheet.fault(cell, IMPLAUSIBLE, message, column.cell.text)]


def largest_gyration_radius(base: float, numbers: Mapping[str, float]) -> float:
    """The largest of all bodies in the rectangle with this centre of gravity: all mass in corners.

    i² <= h (H - h) + b_L b_R (Bhatia & Davis 2000, in each direction).
    """
    height = numbers["height"]
    cg_height = numbers.get("cg_height", height / 2)
    eccentricity = numbers.get("eccentricity", 0.5)
    return math.sqrt(cg_height * (height - cg_height) + eccentricity * (1 - eccentricity) * base**2)
