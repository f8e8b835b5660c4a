"""The rows of a library as a table, with what every column means."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from shaketable.library.case import Case
from shaketable.library.effects import DrawnBeta, drawn_beta
from shaketable.library.fitted import TESTS, LibraryFunction
from shaketable.units import degrees

if TYPE_CHECKING:
    import pandas as pd


class LibraryColumn(NamedTuple):
    """A column: its type as a Table Schema has it, its unit, and what it means."""

    kind: str
    unit: str
    meaning: str


DIGITS = 5  # of numbers in files
TEXT, NUMBER, WHOLE = "string", "number", "integer"
#: Every column, in order.
COLUMNS = {
    "id": LibraryColumn(
        TEXT, "", "name of the case and the limit state, in every export; with the measure it "
        "names one row",
    ),
    "thing": LibraryColumn(TEXT, "", "what stands there: kind, size and, if not 1, its scale"),
    "kind": LibraryColumn(TEXT, "", "key in the catalogue of common things"),
    "group": LibraryColumn(
        TEXT, "", "furniture, home, laboratory, technical, hospital, museum, school"
    ),
    "size": LibraryColumn(
        TEXT, "", "slender: smallest base and largest height that are usual; middle; stout: the "
        "largest base and the smallest height; or a label, of sizes of its own",
    ),
    "scale": LibraryColumn(NUMBER, "1", "factor on all lengths"),
    "stands_on": LibraryColumn(TEXT, "", "base, circle, feet or free castors"),
    "depth": LibraryColumn(NUMBER, "m", "from front to back; diameter of a circle"),
    "width": LibraryColumn(NUMBER, "m", "from side to side"),
    "height": LibraryColumn(NUMBER, "m", "of the whole thing"),
    "cg_low": LibraryColumn(NUMBER, "1", "lowest centre of gravity drawn, over the height"),
    "cg_high": LibraryColumn(NUMBER, "1", "highest centre of gravity drawn, over the height"),
    "place": LibraryColumn(TEXT, "", "the ground, or a floor of a building"),
    "storeys": LibraryColumn(WHOLE, "1", "of the linear shear building; empty on the ground"),
    "first_period": LibraryColumn(NUMBER, "s", "of the building; empty on the ground"),
    "damping": LibraryColumn(NUMBER, "1", "of the building; empty on the ground"),
    "floor": LibraryColumn(
        WHOLE, "1", "on which it stands: 4 is the slab above the fourth storey, 0 the ground"
    ),
    "held": LibraryColumn(TEXT, "", "free, at a wall, at a wall with a strap, or on a table"),
    "wall_gap": LibraryColumn(NUMBER, "m", "from its back to the wall; empty without one"),
    "strap_strength": LibraryColumn(NUMBER, "weights of the thing", "force that breaks the strap"),
    "strap_slack": LibraryColumn(NUMBER, "m", "of the strap; empty without one"),
    "edge": LibraryColumn(NUMBER, "m", "from its front to the edge of its table; empty on a floor"),
    "tilt": LibraryColumn(NUMBER, "degrees", "of its support, toward its back"),
    "friction_low": LibraryColumn(NUMBER, "1", "least coefficient of friction drawn"),
    "friction_high": LibraryColumn(NUMBER, "1", "largest coefficient of friction drawn"),
    "limit_state": LibraryColumn(
        TEXT, "", "what is reached: uplift, slides so far, walks off its table, overturns (falls), "
        "overturns or held up (or would at the end without its wall and strap; edition 1.0 has "
        "overturns or leans instead: or ends turned on its wall or in its strap, at any angle), "
        "reaches so far from the wall behind it",
    ),
    "measure": LibraryColumn(
        TEXT, "", "intensity measure, geometric mean of both horizontal components; of the ground, "
        "or with a leading 'floor' of the floor's motion",
    ),
    "unit": LibraryColumn(TEXT, "", "of the medians"),
    "median": LibraryColumn(
        NUMBER, "unit", "θ, the level at which half of such things reach the state; empty where "
        "there is no function",
    ),
    "median_low": LibraryColumn(
        NUMBER, "unit", "lower end of its 95 % interval, for other earthquakes of the same kind; "
        "not for errors of the model or of sizes",
    ),
    "median_high": LibraryColumn(NUMBER, "unit", "upper end of it"),
    "beta": LibraryColumn(
        NUMBER, "1", "standard deviation of ln of the level, to be used with the median: the root "
        "of the sum of the squares of the next three parts",
    ),
    "beta_low": LibraryColumn(NUMBER, "1", "lower end of its 95 % interval over earthquakes"),
    "beta_high": LibraryColumn(NUMBER, "1", "upper end of it"),
    "beta_motions": LibraryColumn(
        NUMBER, "1", "part that motions of one level and their directions differ by"
    ),
    "beta_object": LibraryColumn(
        NUMBER, "1", "part of the exact sizes, the centre of gravity and the friction, which are "
        "not known",
    ),
    "beta_model": LibraryColumn(
        NUMBER, "1", "part of the energy that impacts and rolling take, which is not known, and of "
        f"{TESTS:g}, by which shake-table tests of two granite blocks scatter about predictions; "
        "no furniture was tested",
    ),
    "simulations": LibraryColumn(WHOLE, "1", "to which it was fitted"),
    "recordings": LibraryColumn(WHOLE, "1", "independent recordings among the motions"),
    "events": LibraryColumn(WHOLE, "1", "earthquakes of which they are"),
    "recordings_reaching": LibraryColumn(
        WHOLE, "1", "recordings of which at least one simulation reaches the state"
    ),
    "held_up": LibraryColumn(
        NUMBER, "1", "largest share of simulations at one factor on the motions that have not "
        "overturned, and would at the end without wall and strap; in edition 1.0, whose column is "
        "leaning, that end turned on a wall or in a strap, at any angle",
    ),
    "given_up": LibraryColumn(
        NUMBER, "1", "share of simulations that were stopped while the thing still moved, which "
        "have not overturned, so that the true share is as high or higher",
    ),
    "problem": LibraryColumn(TEXT, "", "why there is no function"),
    "caution": LibraryColumn(TEXT, "", "what is weak about it"),
}  # fmt: skip


def table_of(functions: Sequence[LibraryFunction]) -> pd.DataFrame:
    """A row for each function, in SI, with the columns of COLUMNS."""
    import pandas as pd

    parts = parts_of_beta(functions)
    rows = [_row(one, part) for one, part in zip(functions, parts, strict=True)]
    return pd.DataFrame(rows, columns=list(COLUMNS))


def rounded(table: pd.DataFrame) -> pd.DataFrame:
    """The table with its numbers in DIGITS digits, more than any interval tells."""
    found = table.copy()
    for name, column in COLUMNS.items():
        if column.kind == NUMBER:
            found[name] = [
                float(f"{value:.{DIGITS}g}") if np.isfinite(value) else np.nan
                for value in found[name].astype(np.float64)
            ]
    return found


def parts_of_beta(functions: Sequence[LibraryFunction]) -> list[DrawnBeta]:
    """What was drawn adds to β of each function, from all that are held alike."""
    alike: dict[tuple[object, ...], list[int]] = {}
    for number, one in enumerate(functions):
        key = one.case.held.name, one.case.thing.round, one.state.name, one.measure.name
        alike.setdefault(key, []).append(number)
    found: dict[int, DrawnBeta] = {}
    for numbers in alike.values():
        drawn = drawn_beta([functions[k].effects for k in numbers])
        found |= zip(numbers, drawn, strict=True)
    return [found[k] for k in range(len(functions))]


def _row(one: LibraryFunction, drawn: DrawnBeta) -> Mapping[str, Any]:
    curve, known = one.curve, not one.problem
    fitted = float(curve.fits.beta[0]) if known else np.nan
    together = float(np.hypot(*drawn))
    # no more than was found: then nothing is left for the motions
    within = min(1.0, fitted / together) if together else 1.0
    of_object, of_model = within * drawn.object, within * drawn.model
    return {
        "id": one.identifier,
        **_about_case(one.case),
        "limit_state": one.state.name,
        "measure": one.measure.name,
        "unit": one.measure.measure.unit,
        "median": curve.median,
        "median_low": curve.median_interval[0],
        "median_high": curve.median_interval[1],
        "beta": curve.beta,
        "beta_low": curve.beta_interval[0],
        "beta_high": curve.beta_interval[1],
        "beta_motions": float(np.sqrt(max(fitted**2 - of_object**2 - of_model**2, 0.0)))
        if known
        else np.nan,
        "beta_object": of_object if known else np.nan,
        "beta_model": float(np.hypot(of_model, TESTS)) if known else np.nan,
        "simulations": one.simulations,
        "recordings": curve.recordings,
        "events": curve.events,
        "recordings_reaching": curve.reached_by,
        "held_up": one.held_up,
        "given_up": one.moving,
        "problem": one.problem,
        "caution": one.caution,
    }


def _about_case(case: Case) -> Mapping[str, Any]:
    thing, building, held = case.thing, case.stand.building, case.held
    base = "circle" if thing.round else "feet" if thing.on_feet else "base"
    strapped = held.strength is not None
    return {
        "thing": thing.name,
        "kind": thing.kind,
        "group": thing.common.group,
        "size": thing.label or thing.size.value,
        "scale": thing.scale,
        "stands_on": "free castors" if thing.rolls else base,
        "depth": thing.depth,
        "width": thing.width,
        "height": thing.height,
        "cg_low": thing.common.cg.least,
        "cg_high": thing.common.cg.most,
        "place": case.stand.name,
        "storeys": building and building.storeys,
        "first_period": building and building.first_period,
        "damping": building and building.damping,
        "floor": case.stand.floor,
        "held": held.name,
        "wall_gap": held.wall_gap,
        "strap_strength": held.strength,
        "strap_slack": held.slack if strapped else None,
        "edge": held.edge,
        "tilt": degrees(case.tilt),
        "friction_low": case.friction[0],
        "friction_high": case.friction[1],
    }
