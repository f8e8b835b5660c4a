"""Inventories: a CSV table of objects, and the bodies that stand for them.

Columns: name, width_m, height_m and, optionally, cg_height_m, eccentricity, gyration_radius_m,
support_length_m, quantity, floor, location, note. Every fault of a file is reported at once.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections import Counter
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path

from shaketable.body import SIZES, Body
from shaketable.errors import InputError, joined, quoted
from shaketable.inputs import NUMBER, read_file

REQUIRED = ("name", "width_m", "height_m")
NUMBERS = (
    "width_m",
    "height_m",
    "cg_height_m",
    "eccentricity",
    "gyration_radius_m",
    "support_length_m",
    "quantity",
)
OPTIONAL = (
    "cg_height_m",
    "eccentricity",
    "gyration_radius_m",
    "support_length_m",
    "quantity",
    "floor",
    "location",
    "note",
)
LONGEST_TEXT = 1000  # characters of a cell
MOST_ROWS = 200_000
MOST_OBJECTS = 1_000_000  # of one kind

_NUMBER = re.compile(NUMBER, re.ASCII)


@dataclass(frozen=True, kw_only=True)
class Item:
    """One kind of object in an inventory.

    Attributes:
        body: the body that is simulated for it.
        height: full height [m].
        support_length: length of the support on the middle of which it stands, in the direction of
            the shaking [m]; None if it cannot walk off.
        quantity: number of such objects.
        floor: label of the floor of a building on which it stands, "" if none is given.
        location, note: free text.
    """

    body: Body
    height: float
    support_length: float | None = None
    quantity: int = 1
    floor: str = ""
    location: str = ""
    note: str = ""

    @property
    def name(self) -> str:
        return self.body.name

    def with_base(self, width: float) -> Body:
        """The same object on a base of another width [m].

        It stands for feet or a plate under it: the centre of gravity keeps its height and its
        place between the corners, and the radius of gyration stays the same.
        """
        return replace(self.body, width=width, left=self.body.left / self.body.width * width)


def read_inventory(path: str | Path) -> list[Item]:
    """The items of an inventory file.

    Raises:
        InputError: lists all faults of the file, one a line, with line and field.
    """
    path = Path(path)
    try:
        text = read_file(path).decode("utf-8-sig")
        # strict: a quote that is opened and not closed is an error
        reader = csv.DictReader(io.StringIO(text, newline=""), skipinitialspace=True, strict=True)
        columns = [(name or "").strip() for name in reader.fieldnames or []]
        reader.fieldnames = columns
        rows = [(reader.line_num, row) for row in islice(reader, MOST_ROWS + 1)]
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path}: not a CSV text file in UTF-8 ({error})") from None
    if len(rows) > MOST_ROWS:
        raise InputError(f"{path}: holds more than {MOST_ROWS:,} rows, the most that are read")
    faults = _column_faults(path, columns)
    if faults:
        raise InputError(joined(faults))
    if rows and not text.endswith(("\n", "\r")) and None in rows[-1][1].values():
        line = rows[-1][0]
        raise InputError(
            f"{path}, line {line}: the file ends within this row: it has fewer cells than the "
            f"header has columns; is the file cut short?"
        )
    rows = [(line, row) for line, row in rows if any(_cell(v) for v in row.values())]
    if not rows:
        raise InputError(f"{path}: holds no objects; each needs a row below the header")
    items: list[Item] = []
    lines: dict[tuple[str, str], int] = {}
    for line, row in rows:
        found, item = _item(f"{path}, line {line}", row)
        faults += found
        name = _cell(row.get("name"))
        here = (name, _cell(row.get("floor")))  # the same name may be on several floors
        if name and here in lines:
            faults.append(
                f"{path}, line {line}, name: {quoted(name)} is also on line {lines[here]}"
            )
        lines.setdefault(here, line)
        if item is not None:
            items.append(item)
    if faults:
        raise InputError(joined(faults))
    return items


def _cell(value: object) -> str:
    return value.strip() if isinstance(value, str) else ""


def _column_faults(path: Path, columns: list[str]) -> list[str]:
    if not columns:
        return [f"{path}: the file is empty; its first line must name the columns"]
    accepted = f"accepted: {', '.join(REQUIRED)} and, optionally, {', '.join(OPTIONAL)}"
    faults = [
        f"{path}, line 1: unknown column {quoted(name)}; {accepted}"
        for name in columns
        if name not in (*REQUIRED, *OPTIONAL)
    ]
    faults += [
        f"{path}, line 1: column {name!r} is missing; {accepted}"
        for name in REQUIRED
        if name not in columns
    ]
    faults += [
        f"{path}, line 1: column {quoted(name)} appears {times} times"
        for name, times in Counter(columns).items()
        if times > 1
    ]
    return faults


def _item(where: str, row: dict[str | None, object]) -> tuple[list[str], Item | None]:
    """The faults of a row, and its item if it has none."""
    faults, numbers = _numbers(where, row)
    faults += _contradictions(where, numbers)
    if faults:
        return faults, None
    eccentricity = numbers.get("eccentricity", 0.5)
    most = _largest_gyration_radius(numbers, eccentricity)
    if numbers.get("gyration_radius_m", 0.0) > most:
        return [
            f"{where}, gyration_radius_m: found {numbers['gyration_radius_m']:g} m; a body within "
            f"width_m and height_m with this centre of gravity has at most {most:.3g} m"
        ], None
    width, height = numbers["width_m"], numbers["height_m"]
    body = Body(
        width=width,
        cg_height=numbers.get("cg_height_m", height / 2),
        left=eccentricity * width,
        gyration_radius=numbers.get(
            "gyration_radius_m", min(math.hypot(width, height) / math.sqrt(12), most)
        ),
        name=_cell(row.get("name")),
    )
    item = Item(
        body=body,
        height=height,
        support_length=numbers.get("support_length_m"),
        quantity=int(numbers.get("quantity", 1.0)),
        floor=_cell(row.get("floor")),
        location=_cell(row.get("location")),
        note=_cell(row.get("note")),
    )
    return [], item


def _numbers(where: str, row: dict[str | None, object]) -> tuple[list[str], dict[str, float]]:
    """The faults of a row's cells, and its numbers by their columns."""
    faults = []
    if None in row:
        faults.append(f"{where}: has more cells than the header has columns")
    if not _cell(row.get("name")):
        faults.append(f"{where}, name: is empty")
    for key, value in row.items():
        cell = _cell(value)
        if len(cell) > LONGEST_TEXT:
            faults.append(f"{where}, {key}: has {len(cell):,} characters; at most {LONGEST_TEXT:,}")
        if any(line.count(",") >= len(row) - 1 for line in cell.splitlines()[1:]):
            faults.append(f"{where}, {key}: a quote is not closed and swallows whole rows")
    numbers: dict[str, float] = {}
    for field in NUMBERS:
        cell = _cell(row.get(field))
        if not cell:
            if field in REQUIRED:
                faults.append(f"{where}, {field}: is empty; a positive number is needed")
            continue
        number = float(cell.upper().replace("D", "E")) if _NUMBER.fullmatch(cell) else math.nan
        if not (math.isfinite(number) and number > 0.0):
            faults.append(f"{where}, {field}: expected a positive number, found {quoted(cell)}")
        elif field.endswith("_m") and not SIZES[0] <= number <= SIZES[1]:
            faults.append(
                f"{where}, {field}: must lie between {SIZES[0]:g} and {SIZES[1]:g} m, "
                f"found {number:g} m"
            )
        else:
            numbers[field] = number
    return faults, numbers


def _contradictions(where: str, numbers: dict[str, float]) -> list[str]:
    """What a row's numbers cannot be, or cannot be together."""
    faults = []
    quantity = numbers.get("quantity", 1.0)
    if quantity != int(quantity):
        faults.append(f"{where}, quantity: expected a whole number, found {quantity:g}")
    elif quantity > MOST_OBJECTS:
        faults.append(f"{where}, quantity: found {quantity:g}; at most {MOST_OBJECTS:,} accepted")
    eccentricity = numbers.get("eccentricity", 0.5)
    if eccentricity >= 1.0:
        faults.append(
            f"{where}, eccentricity: must lie between 0 and 1, where the centre of gravity is "
            f"inside the base; found {eccentricity:g}"
        )
    length = numbers.get("support_length_m", math.inf)
    if length < numbers.get("width_m", 0.0):
        faults.append(
            f"{where}, support_length_m: found {length:g} m, shorter than the base of "
            f"{numbers['width_m']:g} m that stands on it"
        )
    cg_height = numbers.get("cg_height_m", 0.0)
    if cg_height >= numbers.get("height_m", math.inf):
        faults.append(
            f"{where}, cg_height_m: {cg_height:g} m is not inside the body of height_m = "
            f"{numbers['height_m']:g} m"
        )
    return faults


def _largest_gyration_radius(numbers: dict[str, float], eccentricity: float) -> float:
    """The largest of all bodies in the rectangle with this centre of gravity: all mass in corners.

    i² <= h (H - h) + b_L b_R (Bhatia & Davis 2000, in each direction).
    """
    width, height = numbers["width_m"], numbers["height_m"]
    cg_height = numbers.get("cg_height_m", height / 2)
    return math.sqrt(
        cg_height * (height - cg_height) + eccentricity * (1 - eccentricity) * width**2
    )
