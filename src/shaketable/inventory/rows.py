"""A row of an inventory, and the body that stands for it."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import replace

from shaketable.body import Body
from shaketable.errors import Fault, quoted
from shaketable.inventory.answers import anchored_in, answer_in, castors_in
from shaketable.inventory.carriers import hangs_or_is_fixed, what_it_stands_on
from shaketable.inventory.columns import (
    ANSWERS,
    FORCES,
    LENGTHS,
    LOSSES,
    METRES,
    PLAN,
    ZERO,
    Column,
)
from shaketable.inventory.hints import mentions_castors, mentions_round
from shaketable.inventory.item import BaseShape, Castors, Item
from shaketable.inventory.left_out import taken_sizes
from shaketable.inventory.numbers import degrees_in, number_in
from shaketable.inventory.shapes import SHAPES, against_shape
from shaketable.inventory.surroundings import SIDES, with_surroundings
from shaketable.inventory.vocabulary import normalized, plain
from shaketable.language import tell, translated
from shaketable.tables.sheet import LONGEST_TEXT, Cell, Sheet
from shaketable.units import radians

LOWEST = 0.05  # of its height: no centre of gravity is lower
LONGEST_SUPPORT = 20.0  # m
FARTHEST = 5.0  # m: a wall or an edge beyond that is none
LARGEST_ROOM = 200.0  # m: a place in a plan beyond that is in another unit
LONGEST_LOSS = 0.05  # m: rolling friction of a few millimetres is much
DENSITIES = (5.0, 25_000.0)  # kg/m³ within its sizes: an empty basket; more than solid lead
NUMBERS = (*LENGTHS, *FORCES, "mass", "eccentricity", "quantity", "cost")
MOST_OBJECTS = 1_000_000  # of one kind
#: Numbers without which an object can be simulated, by what is usual.
OPTIONAL = (
    "cg_height", "eccentricity", "gyration_radius", "support_length", "mass", "quantity", "cost",
    *LOSSES,
)  # fmt: skip
SHAPING = ("cg_height", "eccentricity", "gyration_radius", "support_length")  # likewise numbers
DECIDING = ("castors", "shape", "anchored")  # words without which nothing good is said
WORDS_THAT_MAY_BE_UNKNOWN = (*DECIDING, *ANSWERS, "critical")
BASES = ("depth", "width", "diameter")
IMPLAUSIBLE = "implausible"  # the kind of a fault: of a number that furniture does not have
NOT_EXPECTED = "is not to be expected of furniture"
FURNITURE = (0.02, 5.0)  # m: sizes beyond these are hardly in metres
#: No word: a number, or a slip in one.
_BARE = re.compile(r"[-+\d.,\s]*|[-+]?(nan|inf|infinity)|[-+\d.]+e[-+\d]+", re.IGNORECASE)
FULL_CIRCLE = 360.0
MOST_CRITICAL = 5
PLACES = {"latitude": 90.0, "longitude": 180.0}  # degrees, at most


def item_of(
    sheet: Sheet,
    columns: list[Column | None],
    row: list[Cell],
    *,
    accept_sizes: bool,
    unread: tuple[str, ...] = (),
    remarks: list[Fault] | None = None,
    catalogue: bool = False,
) -> tuple[list[Fault], Item | None]:
    """The faults of a row, and its item if it has none.

    With `remarks`, cells that are not needed and hold text in place of a number ("ca. 350", "?")
    or a word that is not known are taken as empty, and told there. Where that is a word that
    decides (castors, anchored, shape) nothing good is said of the object.

    Args:
        sheet: where the row stands.
        columns: what its cells mean.
        row: its cells.
        accept_sizes: whether sizes may lie outside FURNITURE.
        unread: headers of columns that may say castors, anchors or shapes, and are not understood.
        remarks: takes what is to be told; None to refuse such cells.
        catalogue: whether sizes that are left out are taken from the catalogue of common things.
    """
    cells = {
        column.meaning: (cell, column) for column, cell in zip(columns, row, strict=False) if column
    }
    faults = _texts(sheet, columns, row)
    if remarks is not None:
        cells, more = _without_what_is_not_read(sheet, cells, remarks)
        unread = (*unread, *more)
    numbers: dict[str, float] = {}
    for meaning, (cell, column) in cells.items():
        if meaning in NUMBERS and cell.text and not cell.wrong:
            read = number_in(sheet, cell, column)
            if read.fault:
                faults.append(read.fault)
                continue
            numbers[meaning] = read.number
            if read.remark and remarks is not None:
                remarks.append(sheet.fault(cell, "range", read.remark, column.cell.text))
    faults += _place(sheet, cells, numbers)
    if "facing" in cells and cells["facing"][0].text:
        read = degrees_in(sheet, *cells["facing"], FULL_CIRCLE)
        faults += [read.fault] if read.fault else []
        numbers["facing"] = read.number
    text = {meaning: cell.text for meaning, (cell, _) in cells.items()}
    faults += [
        sheet.fault(
            cell,
            "word",
            tell("expected {accepted}, found {found}", accepted=accepted, found=quoted(cell.text)),
            column.cell.text,
        )
        for meaning, (cell, column) in cells.items()
        if (accepted := _unknown_word(meaning, cell.text))
    ]
    headers = {column.meaning: column.cell.text for column in columns if column}
    shape = SHAPES.get(plain(text.get("shape", "")))
    filled = {meaning for meaning, (cell, _) in cells.items() if cell.text or cell.wrong}
    left_out = catalogue or "height" not in filled or not filled & {*BASES}
    usual = taken_sizes(text.get("name", ""), numbers, shape, filled) if left_out else None
    taken = usual if catalogue else None
    if taken:
        numbers, shape = taken.numbers, taken.shape
        filled |= {each.what for each in taken.assumed}
    empty = [need for need in ("name", "height") if need not in filled]
    base = [size for size in BASES if size in headers] or ["depth"]
    if not filled & {*BASES}:
        empty.append(base[0])
    mend = ""
    if usual and not catalogue:
        mend = tell(
            "the catalogue has usual sizes of {thing}: --catalogue takes them",
            thing=quoted(usual.thing.key),
        )
    faults += [
        sheet.fault(
            row[0],
            "empty",
            tell("is empty; it is needed for every object"),
            headers.get(need, need),
        )._replace(mend="" if need == "name" else mend)
        for need in empty
    ]
    faults += [
        sheet.fault(row[0], "contradiction", message, headers.get(meaning, meaning))
        for meaning, message in (
            [] if faults else [*_contradictions(numbers), *against_shape(numbers, shape)]
        )
    ]
    faults += [] if faults or accept_sizes else _implausible(sheet, cells, numbers)
    if faults:
        return faults, None
    if "diameter" in numbers or shape is BaseShape.CYLINDER:
        across = next(numbers[size] for size in BASES if size in numbers)
        shape = BaseShape.CYLINDER
        numbers["depth"] = numbers["width"] = across
    item = _item(numbers, text, shape or BaseShape.BOX)
    if taken:
        rolls = item.castors is Castors.NONE and not text.get("castors") and taken.thing.castors
        item = replace(
            item,
            castors=Castors.UNKNOWN if rolls else item.castors,
            # the catalogue knows what is round, and a name may say that this one is, too
            may_be_round=item.shape is BaseShape.BOX
            and not text.get("shape")
            and mentions_round(item.name),
            assumed=taken.assumed,
            assumed_as=taken.thing.key,
        )
    item, wrong = with_surroundings(item, numbers, text)
    if wrong:
        return [
            sheet.fault(
                cells[meaning][0] if meaning in cells else row[0],
                "contradiction",
                message,
                headers.get(meaning, meaning),
            )
            for meaning, message in wrong
        ], None
    said = (text.get("note", ""), text.get("location", ""), text.get("stands_on", ""))
    strapped = item.surroundings is not None and bool(item.surroundings.straps)
    on_castors = item.castors in (Castors.FREE, Castors.LOCKED, Castors.SOME)
    asked = not (text.get("anchored") or strapped or on_castors)
    hangs = asked and hangs_or_is_fixed(item.name, *said)
    return [], replace(item, row=row[0].row, unread=unread, hangs=hangs)


def _without_what_is_not_read(
    sheet: Sheet, cells: Mapping[str, tuple[Cell, Column]], remarks: list[Fault]
) -> tuple[dict[str, tuple[Cell, Column]], tuple[str, ...]]:
    """Cells of a row, those that cannot be read and are not needed empty; headers that decide."""
    found, deciding = dict(cells), []
    for meaning, (cell, column) in cells.items():
        if cell.shared and cell.text and meaning in ("mass", "quantity", "cost"):
            text = tell("is merged over several rows, and left out: whose it is cannot be told")
            remarks.append(sheet.fault(cell, "left blank", text, column.cell.text))
            found[meaning] = (cell._replace(text=""), column)
            continue
        is_number = meaning in OPTIONAL and bool(number_in(sheet, cell, column).fault)
        if (
            not cell.text
            or cell.wrong
            or not (
                (is_number and not _BARE.fullmatch(normalized(cell.text)))
                or (meaning in WORDS_THAT_MAY_BE_UNKNOWN and _unknown_word(meaning, cell.text))
            )
        ):
            continue
        text = tell("{found} cannot be read, and is left out", found=quoted(cell.text))
        if meaning in DECIDING or meaning in SHAPING:
            deciding.append(column.cell.text)
            text = tell(
                "{found} cannot be read, accepted: {accepted}; until it is mended the object gets "
                "no class",
                found=quoted(cell.text),
                accepted=_unknown_word(meaning, cell.text) or tell("a number"),
            )
        remarks.append(sheet.fault(cell, "left blank", text, column.cell.text))
        found[meaning] = (cell._replace(text=""), column)
    return found, tuple(deciding)


def _place(
    sheet: Sheet, cells: Mapping[str, tuple[Cell, Column]], numbers: dict[str, float]
) -> list[Fault]:
    """Faults of a latitude and a longitude; without any, both are put among the numbers."""
    given = {meaning: cells[meaning] for meaning in PLACES if meaning in cells}
    filled = {meaning: pair for meaning, pair in given.items() if pair[0].text}
    if len(filled) == 1:
        ((meaning, (cell, column)),) = filled.items()
        other = next(name for name in PLACES if name != meaning)
        return [
            sheet.fault(cell, "place", translated(f"is given without a {other}"), column.cell.text)
        ]
    faults = []
    for meaning, (cell, column) in filled.items():
        read = degrees_in(sheet, cell, column, PLACES[meaning])
        if read.fault:
            faults.append(read.fault)
        else:
            numbers[meaning] = read.number
    return faults


def _unknown_word(meaning: str, text: str) -> str:
    """What is accepted in a cell of words, "" if its text is."""
    word = plain(text)
    if meaning == "anchored" and anchored_in(text) is None:
        return tell("yes or no")
    if meaning in ANSWERS and meaning != "anchored" and answer_in(text) is None:
        return tell("yes or no")
    if meaning == "castors" and word and castors_in(text) is None:
        return tell("none, free, locked, or yes if that is not known")
    if meaning == "wall_side" and word not in SIDES:
        return tell("back, front, left or right")
    if meaning == "shape" and word not in ("", *SHAPES):
        return tell("box, cylinder or feet")
    if meaning == "critical" and _critical(word) is None:
        return tell("yes, no or a whole number from 1 to {most}", most=MOST_CRITICAL)
    return ""


def _critical(word: str) -> int | None:
    """0 to MOST_CRITICAL, of which "yes" is the largest and 1 a step; None for any other word."""
    if word.isdecimal() and word.isascii():
        return int(word) if int(word) <= MOST_CRITICAL else None
    answer = answer_in(word)
    return None if answer is None else MOST_CRITICAL * answer


def _texts(sheet: Sheet, columns: list[Column | None], row: list[Cell]) -> list[Fault]:
    """Faults of a row's cells as texts."""
    faults = [
        sheet.fault(
            cell,
            "more cells",
            tell("has more cells than the header has columns: {found}", found=quoted(cell.text)),
        )
        for cell in row[len(columns) :]
        if cell.text
    ][:1]
    faults += [
        sheet.fault(cell, "cell", cell.wrong, column.cell.text)
        for column, cell in zip(columns, row, strict=False)
        if column and cell.wrong
    ]
    faults += [
        sheet.fault(
            cell,
            "long",
            tell(
                "has {count:,} characters; at most {most:,}",
                count=len(cell.text),
                most=LONGEST_TEXT,
            ),
            column.cell.text if column else "",
        )
        for column, cell in zip(columns, row, strict=False)
        if len(cell.text) > LONGEST_TEXT
    ]
    return faults


def _contradictions(numbers: Mapping[str, float]) -> list[tuple[str, str]]:
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
    if not faults and radius > (most := _largest_gyration_radius(base, numbers)):
        message = tell(
            "found {radius:g} m; a body within its base and height with this centre of gravity has "
            "at most {most:.3g} m",
            radius=radius,
            most=most,
        )
        faults.append(("gyration_radius", message))
    return faults


def _implausible(
    sheet: Sheet, cells: Mapping[str, tuple[Cell, Column]], numbers: Mapping[str, float]
) -> list[Fault]:
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


def _too_light_or_heavy(
    sheet: Sheet, cells: Mapping[str, tuple[Cell, Column]], numbers: Mapping[str, float]
) -> list[Fault]:
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


def _item(numbers: Mapping[str, float], text: Mapping[str, str], shape: BaseShape) -> Item:
    """The item of a row without faults.

    Eccentricity, radius of gyration and support length are given front to back, and hold in no
    other direction.
    """
    depth, width = numbers.get("depth"), numbers.get("width")
    heights = {key: numbers[key] for key in ("height", "cg_height") if key in numbers}
    base = width if depth is None else depth
    assert base is not None
    sideways = None if depth is None or width is None else _body(width, heights, text["name"])
    castors = castors_in(text["castors"]) if text.get("castors") else None
    if castors is None:
        told = mentions_castors(text["name"], text.get("note", ""))
        castors = Castors.UNKNOWN if told else Castors.NONE
    answers = {name: bool(answer_in(text.get(name, ""))) for name in ANSWERS}
    answers["anchored"] = bool(anchored_in(text.get("anchored", "")))
    as_wide = depth is None or width is None or depth == width
    unsaid = not text.get("shape") and shape is BaseShape.BOX and not answers["anchored"]
    return Item(
        body=_body(base, numbers, text["name"]),
        height=numbers["height"],
        sideways=sideways,
        depth_known=depth is not None,
        support_length=numbers.get("support_length"),
        shape=shape,
        may_be_round=unsaid and as_wide and mentions_round(text["name"]),
        rolling_friction=numbers.get("rolling_friction", 0.0),
        contour_friction=numbers.get("contour_friction", 0.0),
        drilling_friction=numbers.get("drilling_friction", 0.0),
        facing=radians(numbers["facing"]) if "facing" in numbers else None,
        castors=castors,
        mass=numbers.get("mass"),
        quantity=int(numbers.get("quantity", 1.0)),
        cost=numbers.get("cost"),
        building=text.get("building", ""),
        site=(numbers["longitude"], numbers["latitude"]) if "latitude" in numbers else None,
        floor=text.get("floor", ""),
        location=text.get("location", ""),
        position=(numbers["x"], numbers["y"]) if {"x", "y"} <= numbers.keys() else None,
        wall=text.get("wall", ""),
        note=text.get("note", ""),
        critical=_critical(plain(text.get("critical", ""))) or 0,
        blocks_exit=answers["blocks_exit"],
        people_nearby=answers["people_nearby"],
        must_not_fall=answers["must_not_fall"],
        anchored=answers["anchored"],
        stands_on=what_it_stands_on(
            text.get("stands_on", ""), text["name"], text.get("note", ""),
            text.get("location", ""), numbers["height"],
        ) if castors in (Castors.NONE, Castors.UNKNOWN) else "",
    )  # fmt: skip


def _body(base: float, numbers: Mapping[str, float], name: str) -> Body:
    """The body on a base [m]: a uniform rectangle as far as the row gives no other numbers."""
    height = numbers["height"]
    uniform = math.hypot(base, height) / math.sqrt(12)
    return Body(
        width=base,
        cg_height=numbers.get("cg_height", height / 2),
        left=numbers.get("eccentricity", 0.5) * base,
        gyration_radius=numbers.get(
            "gyration_radius", min(uniform, _largest_gyration_radius(base, numbers))
        ),
        name=name,
    )


def _largest_gyration_radius(base: float, numbers: Mapping[str, float]) -> float:
    """The largest of all bodies in the rectangle with this centre of gravity: all mass in corners.

    i² <= h (H - h) + b_L b_R (Bhatia & Davis 2000, in each direction).
    """
    height = numbers["height"]
    cg_height = numbers.get("cg_height", height / 2)
    eccentricity = numbers.get("eccentricity", 0.5)
    return math.sqrt(cg_height * (height - cg_height) + eccentricity * (1 - eccentricity) * base**2)
