"""The bodies that a campaign's file names: an inventory, a grid or a sample, planar or solids."""

from __future__ import annotations

import itertools
import logging
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.errors import InputError, named
from shaketable.inventory import Item, read_inventory, solid_of
from shaketable.inventory.directions import directed
from shaketable.simulate.checks import stand
from shaketable.simulate.kinds import are_solids
from shaketable.simulate.standing import standing_limit
from shaketable.solid import ROLLING_RESISTANCE, Solid
from shaketable.surroundings import Surroundings
from shaketable.toml_file import TomlFile, is_number

log = logging.getLogger(__name__)

SIZES = ("base_m", "depth_m", "width_m", "height_m", "eccentricity", "restitution_factor")
BOX = ("depth_m", "width_m")  # along x, from front to back, and along y
SHAPE, SHAPES = "shape", ("box", "cylinder")
KINDS = ("inventory", "grid", "sobol")
ONLY_STANDING, SOLIDS = "only_standing", "solids"
MOST_NAMED = 3
MOST_BODIES = 10**7


Bodies = list[Any]  # all planar, or all of them Solids
Held = Mapping[str, Surroundings]  # by the name of a body, as its list says


class GridRange(NamedTuple):
    """Values of a grid or a sample."""

    low: float
    high: float
    logarithmic: bool

    def at(self, share: NDArray[np.float64]) -> NDArray[np.float64]:
        if self.logarithmic:
            return np.asarray(self.low * (self.high / self.low) ** share)
        return np.asarray(self.low + (self.high - self.low) * share)


def bodies_of(told: TomlFile) -> tuple[Bodies, Held]:
    """Those of an inventory, of a grid or of a sample; and what surrounds those of an inventory."""
    given = {
        "inventory": told.get("bodies", "inventory", str, None),
        "grid": told.get("bodies", "grid", dict, None),
        "sobol": told.get("bodies", "sobol", dict, None),
    }
    told.get("bodies", ONLY_STANDING, bool, False)
    if told.get("bodies", SOLIDS, bool, False) and given["inventory"] is None:
        told.fault(
            f"bodies.{SOLIDS}", "is for an inventory; a grid has depth_m and width_m, or shape"
        )
    chosen = [name for name, value in given.items() if value is not None]
    if len(chosen) != 1:
        found = ", ".join(chosen) or "none"
        told.fault("bodies", f"give one of {', '.join(KINDS)}; found {found}")
        return [], {}
    if given["inventory"] is not None:
        return _of_inventory(told)
    if given["grid"] is not None:
        return _of_grid(told, given["grid"]), {}
    return _of_sobol(told, given["sobol"] or {}), {}


def standing(
    told: TomlFile,
    bodies: Bodies,
    tilts: Sequence[float],
    azimuth: float,
    orientations: Sequence[float],
) -> Bodies:
    """The bodies that stand by themselves on all tilts toward an azimuth, however turned [rad].

    The others are a fault of the file, unless it says that they are to be left out.
    """
    if not bodies:
        return []
    if are_solids(bodies):
        stays = np.array([_stands(solid, tilts, azimuth, orientations) for solid in bodies])
    else:
        stays = stand(bodies, min(tilts)) & stand(bodies, max(tilts))
    falling = [body.name or f"body {k}" for k, body in enumerate(bodies) if not stays[k]]
    if falling:
        said = (
            f"{len(falling):,} of {len(bodies):,} bodies fall by themselves on one of the tilts: "
            f"{named(falling, MOST_NAMED)}"
        )
        if told.get("bodies", ONLY_STANDING, bool, False):
            log.warning("left out: %s", said)
        else:
            message = f"{said}; leave them or the tilt out, or set {ONLY_STANDING} = true"
            told.fault("bodies", message)
    return [body for body, stays_up in zip(bodies, stays, strict=True) if stays_up]


def _stands(
    solid: Any, tilts: Sequence[float], azimuth: float, orientations: Sequence[float]
) -> bool:
    """Whether a solid stands on tilts toward an azimuth, however it is turned [rad]."""
    downhill = [
        (abs(tilt), azimuth + (math.pi if tilt < 0.0 else 0.0) - turn)
        for tilt in tilts
        for turn in orientations
    ]
    return all(tilt < standing_limit(solid, toward) for tilt, toward in downhill)


def items_of(told: TomlFile) -> list[Item]:
    """The objects of the inventory that are loose; none where no inventory is given."""
    return [item for _, item in _numbered(told)]


def _numbered(told: TomlFile) -> list[tuple[int, Item]]:
    """Those objects, each with its place among all objects of the inventory, from 1."""
    name = told.get("bodies", "inventory", str, None)
    if name is None:
        return []
    try:
        every = enumerate(read_inventory(told.path.parent / name), 1)
        return [(number, item) for number, item in every if item.loose]
    except InputError as error:
        told.fault("bodies.inventory", str(error))
        return []


def _of_inventory(told: TomlFile) -> tuple[Bodies, Held]:
    """Every object front to back and, where that differs, side to side; or as a solid."""
    items = _numbered(told)
    if told.get("bodies", SOLIDS, bool, False):
        return _solids_of(items, told.has("surroundings"))
    rolling = [item.name for _, item in items if item.rolls]
    if rolling and not told.get("plan", "report", bool, False):
        log.warning(
            "%d objects on castors are simulated as if they did not roll: %s; a campaign with "
            "report = true knows castors",
            len(rolling),
            named(rolling, MOST_NAMED),
        )
    ways = directed(items)
    return [way.body for way in ways], {
        way.body.name: way.surroundings for way in ways if way.surroundings
    }


def _solids_of(items: Sequence[tuple[int, Item]], held: bool) -> tuple[list[Solid], Held]:
    """The objects whose base is known, and what surrounds them; a warning names the others.

    Args:
        items: each with its place, from 1.
        held: whether the file surrounds them, so that they need their masses.
    """
    found = [(number, item, solid_of(item, ROLLING_RESISTANCE)) for number, item in items]
    unknown = [item.name for _, item, solid in found if solid is None]
    if unknown:
        log.warning(
            "left out: %d of %d objects, whose depth or width is not known, or a round base with "
            "its centre of gravity off its centre: %s",
            len(unknown),
            len(items),
            named(unknown, MOST_NAMED),
        )
    solids: list[Solid] = []
    around: dict[str, Surroundings] = {}
    for k, item, solid in found:
        if solid is not None:
            own = item.surroundings
            mass = item.mass if held or own else None
            solids.append(replace(solid.renamed(f"{k}: {item.name}"), mass=mass))
            around |= {solids[-1].name: own} if own else {}
    return solids, around


def _of_grid(told: TomlFile, grid: Mapping[str, Any]) -> Bodies:
    values: dict[str, list[float]] = {}
    for name, given in _sizes(told, "grid", grid).items():
        if isinstance(given, dict):
            span = _range(told, f"bodies.grid.{name}", given, {"count"})
            count = given.get("count")
            if not isinstance(count, int) or isinstance(count, bool) or count < 1:
                told.fault(f"bodies.grid.{name}", f"expected a count of 1 or more, found {count!r}")
            elif span is not None:
                shares = np.linspace(0.0, 1.0, count) if count > 1 else np.zeros(1)
                values[name] = span.at(shares).tolist()
            continue
        found = given if isinstance(given, list) else [given]
        if not found or not all(is_number(each) for each in found):
            told.fault(f"bodies.grid.{name}", f"expected numbers or a range, found {given!r}")
            continue
        values[name] = [float(each) for each in found]
    if told.faults:
        return []
    if math.prod(map(len, values.values())) > MOST_BODIES:
        told.fault("bodies.grid", f"more than {MOST_BODIES:,} bodies")
        return []
    rows = itertools.product(*values.values())
    each = [dict(zip(values, row, strict=True)) for row in rows]
    return _made(told, "grid", each, grid.get(SHAPE))


def _of_sobol(told: TomlFile, sample: Mapping[str, Any]) -> Bodies:
    from scipy.stats import qmc

    count, seed = sample.get("count"), sample.get("seed", 0)
    for name, value, least in (("count", count, 1), ("seed", seed, 0)):
        if not isinstance(value, int) or isinstance(value, bool) or value < least:
            message = f"expected a whole number from {least} on, found {value!r}"
            told.fault(f"bodies.sobol.{name}", message)
    spans = {}
    rest = {name: value for name, value in sample.items() if name not in ("count", "seed")}
    for name, given in _sizes(told, "sobol", rest).items():
        if is_number(given):
            spans[name] = GridRange(float(given), float(given), False)
        elif isinstance(given, dict):
            span = _range(told, f"bodies.sobol.{name}", given, set())
            if span is not None:
                spans[name] = span
        else:
            told.fault(f"bodies.sobol.{name}", f"expected a number or a range, found {given!r}")
    if told.faults or not isinstance(count, int):
        return []
    if count > MOST_BODIES:
        told.fault("bodies.sobol.count", f"more than {MOST_BODIES:,} bodies")
        return []
    points = qmc.Sobol(len(spans), rng=np.random.default_rng(seed))
    shares = points.random_base2(math.ceil(math.log2(max(2, count))))[:count]
    columns = {name: span.at(shares[:, k]).tolist() for k, (name, span) in enumerate(spans.items())}
    rows = zip(*columns.values(), strict=True)
    each = [dict(zip(columns, row, strict=True)) for row in rows]
    return _made(told, "sobol", each, sample.get(SHAPE))


def _sizes(told: TomlFile, where: str, given: Mapping[str, Any]) -> dict[str, Any]:
    """The sizes of a grid or a sample; both lengths are needed."""
    for name in given:
        if name not in (*SIZES, SHAPE):
            accepted = ", ".join((*SIZES, SHAPE))
            told.fault(f"bodies.{where}.{name}", f"unknown; accepted: {accepted}")
    _require_shape(told, f"bodies.{where}", given)
    sizes = BOX if _is_box(given) else ("base_m",)
    for name in (*sizes, "height_m"):
        told_already = name == "base_m" and "width_m" in given and SHAPE not in given
        if name not in given and not told_already:
            told.fault(f"bodies.{where}", _missing(name))
    return {name: value for name, value in given.items() if name in SIZES}


def _range(told: TomlFile, key: str, given: Mapping[str, Any], more: set[str]) -> GridRange | None:
    unknown = sorted(set(given) - {"from", "to", "logarithmic"} - more)
    low, high = given.get("from"), given.get("to")
    logarithmic = given.get("logarithmic", False)
    if (
        unknown
        or not is_number(low)
        or not is_number(high)
        or not isinstance(logarithmic, bool)
        or not low <= high
        or (logarithmic and low <= 0.0)
    ):
        told.fault(
            key,
            "expected from, to, in order, and perhaps logarithmic = true, then above 0; found "
            f"{dict(given)!r}",
        )
        return None
    return GridRange(float(low), float(high), logarithmic)


def _require_shape(told: TomlFile, where: str, given: Mapping[str, Any]) -> None:
    """Note a shape that there is not, and what does not go with a shape."""
    shape = given.get(SHAPE)
    if shape is not None and shape not in SHAPES:
        told.fault(f"{where}.{SHAPE}", f"expected {' or '.join(SHAPES)}, found {shape!r}")
    box = _is_box(given)
    if "width_m" in given and not (box or shape):
        told.fault(f"{where}.width_m", "of a box, beside depth_m; in a plane the one size along "
                   "the shaking is base_m")  # fmt: skip
    unfit = ["base_m"] if box else []
    unfit += ["eccentricity", *BOX] if shape == "cylinder" else []
    unfit += ["restitution_factor"] if box or shape is not None else []
    for name in unfit:
        if name in given:
            told.fault(f"{where}.{name}", f"a {shape or 'box'} in three dimensions has none")


def _is_box(given: Mapping[str, Any]) -> bool:
    """Whether sizes are a box's: it has a depth or, beside no base, a width."""
    named = given.get(SHAPE) == "box" or "depth_m" in given
    return named and given.get(SHAPE) != "cylinder"


def _missing(name: str) -> str:
    """What is said where a size is missing."""
    if name == "base_m":
        return "base_m is missing: the size along the shaking, or the diameter of a cylinder"
    if name in BOX:
        return f"{name} is missing: a box has depth_m, along the shaking, and width_m, across it"
    return f"{name} is missing"


def _made(told: TomlFile, where: str, rows: list[dict[str, float]], shape: str | None) -> Bodies:
    """The bodies of rows of sizes; what cannot be is a fault."""
    bodies: list[Any] = []
    for row in rows:
        name = " ".join(f"{key.removesuffix('_m')} {value:.6g}" for key, value in row.items())
        try:
            bodies.append(_one(row, shape, f"{shape} {name}" if shape else name))
        except InputError as error:
            told.fault(f"bodies.{where}", f"{name}: {error}")
            if len(told.faults) > 20:
                break
    return bodies


def _one(row: Mapping[str, float], shape: str | None, name: str) -> Body | Solid:
    height, eccentricity = row["height_m"], row.get("eccentricity", 0.5)
    if shape == "cylinder":
        return Solid.cylinder(row["base_m"], height, name=name)
    if "depth_m" in row:
        sizes = row["depth_m"], row["width_m"]
        return Solid.box(*sizes, height, eccentricity=(eccentricity, 0.5), name=name)
    return Body.rectangle(
        row["base_m"],
        height,
        eccentricity=eccentricity,
        restitution_factor=row.get("restitution_factor"),
        name=name,
    )
