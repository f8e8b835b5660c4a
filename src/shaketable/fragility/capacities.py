"""Incremental dynamic analysis: the lowest level of each motion that overturns each body.

Vamvatsikos D., Cornell C.A. (2002) Incremental dynamic analysis, Earthquake Engng Struct. Dyn.
31(3):491-514. A rocking body may survive a stronger shaking than the one that overturned it, their
"structural resurrection" (section 2). Levels are therefore scanned from the first at which the body
can move at all: in steps of 5 % to the highest, for what is survived, and below the lowest fall so
found in steps of 1 %. Falls between two such levels, both of which are survived, are not seen.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shaketable.body import Body
from shaketable.errors import InputError
from shaketable.fragility.counts import STRANGE
from shaketable.fragility.intensities import intensities
from shaketable.models import Model, model_of
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.signal import measure_named
from shaketable.simulate import fell, listed, simulate_each, simulate_many
from shaketable.simulate.around import Around, listed_surroundings
from shaketable.simulate.checks import numbers, unique_names
from shaketable.surroundings import Surroundings
from shaketable.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    import xarray as xr

log = logging.getLogger(__name__)

HUNT_AND_FILL = "hunt & fill"
RATIO = 1.05  # of a level to the one below it
FINE = 1.01  # the same below the lowest fall of those
MULTIPLE = 20.0  # of the level at which a body can move: the highest that is tried
LEAST_FRICTION = 0.01  # of what slides to an edge, however smooth its support is
PRECISION = 0.01  # relative, of the lowest overturning level


class Scan(NamedTuple):
    """What one motion does to each body at each scale, (body, polarity).

    Attributes:
        below: the scale below the lowest fall, 0 if that is the lowest of all; NaN without a fall.
        first: the scale of the lowest fall; infinite without one.
        survived: how many scales above it are survived.
        highest: the highest of these; NaN if there is none.
    """

    below: NDArray[np.float64]
    first: NDArray[np.float64]
    survived: NDArray[np.float64]
    highest: NDArray[np.float64]


def ida(
    bodies: Body | Sequence[Body],
    motions: Sequence[Motion],
    measure: str = "PGV",
    *,
    levels: str | ArrayLike = HUNT_AND_FILL,
    polarities: ArrayLike = (1, -1),
    model: Model | str | None = None,
    surroundings: Around = None,
    multiple: float = MULTIPLE,
    precision: float = PRECISION,
    progress: Progress = False,
    threads: int | None = None,
) -> xr.Dataset:
    """Find the lowest level of each motion that overturns each body (incremental dynamic analysis).

    Args:
        bodies: one or more, on a level support.
        motions: at least one, each scaled as a whole.
        measure: how levels are told: PGA, PGV, SA(1.0), or another of `intensity_measures`.
        levels: "hunt & fill" scans levels that rise by 5 %, and those below the lowest fall by
            1 %, and then bisects to `precision`; or levels of the measure in SI, of which the
            lowest that overturns is told.
        polarities, model, surroundings, progress, threads: as for `simulate_many`.
        multiple: the highest level that is scanned, over the one at which the body can tip.
        precision: relative, of the lowest overturning level.

    Returns:
        Dataset over (body, motion, polarity): `capacity`, the lowest level of the measure that
        overturns the body, infinite where none does; `scale`, the factor on the motion there;
        `tried`, the highest level; `survived`, how many of the levels above the lowest fall it
        survives; and `highest_survived`, the highest of these, NaN where there is none.

    Raises:
        InputError: what `simulate_many` says, or a measure that does not grow with the motion.
    """
    bodies = [bodies] if isinstance(bodies, Body) else listed("bodies", bodies, Body)
    motions = listed("motions", motions, Motion)
    signs = numbers("polarities", polarities)
    model = model_of(model)
    around = listed_surroundings(surroundings)
    if len(around) == 1:
        around = around * len(bodies)
    holds = max(math.tan(min(model.rest_limit, 0.5 * math.pi)), LEAST_FRICTION)
    slips = np.array([holds if each and each.edge else math.inf for each in around])
    found = measure_named(measure)
    if found.power is None or found.power < 1:
        raise InputError(
            f"measure {measure!r}: does not grow with the motion; levels need one that does"
        )
    if not 1.0 < multiple < math.inf:
        raise InputError(f"multiple must be above 1 and finite, got {multiple!r}")
    if not 1e-6 <= precision < 1.0:
        raise InputError(f"precision must lie between 1e-6 and 1, got {precision!r}")
    given = None if isinstance(levels, str) else np.sort(numbers("levels", levels))
    if given is None and levels != HUNT_AND_FILL:
        raise InputError(f"levels= must be {HUNT_AND_FILL!r} or levels, got {levels!r}")
    if given is not None and not given[0] > 0.0:
        raise InputError(f"levels= must be above 0, got {given[0]:g}")

    once = intensities(motions, found)[:, 0]
    if not once.all():
        weak = motions[int(np.argmin(once))].name
        raise InputError(f"motion {weak!r}: its {found.name} is zero; it cannot be scaled")
    shape = (len(bodies), len(motions), signs.size)
    below, scale, survived, above, tried = (np.full(shape, np.nan) for _ in range(5))

    def scan(motion: Motion, scales: NDArray[np.float64]) -> Scan:
        runs = simulate_many(
            bodies, [motion], scales=scales, polarities=signs, model=model,
            surroundings=surroundings, progress=False,
            threads=threads,
        )  # fmt: skip
        overturned = fell(runs).isel(motion=0, tilt=0).transpose("body", "polarity", "scale")
        return _scanned(scales, overturned.values)

    with meter("motions", len(motions), progress) as done:
        for k, motion in enumerate(motions):
            if given is not None:
                scales = (given / once[k]) ** (1.0 / found.power)
                each = scan(motion, scales)
            else:
                scales = _levels(tipping_scales(bodies, motion, slips), multiple, RATIO)
                each = scan(motion, scales)
                if np.isfinite(each.first).any():
                    end = each.first[np.isfinite(each.first)].max()
                    fine = scan(motion, scales[0] * FINE ** np.arange(_steps(end / scales[0])))
                    lower = fine.first <= each.first
                    each = each._replace(
                        below=np.where(lower, fine.below, each.first / FINE),
                        first=np.where(lower, fine.first, each.first),
                    )
            below[:, k], scale[:, k], survived[:, k], above[:, k] = each
            tried[:, k] = scales[-1]
            done(1)
    if given is None:
        scale = _bisected(bodies, motions, signs, model, around, below, scale, precision, threads)
    _warn(scale)
    return _dataset(
        bodies, motions, signs, found.name, found.unit, found.power, once,
        {"scale": scale, "tried": tried, "survived": survived, "above": above},
    )  # fmt: skip


def tipping_scales(
    bodies: Sequence[Body], motion: Motion, slips: ArrayLike = math.inf
) -> NDArray[np.float64]:
    """The least scale s of a motion at which each body can tip: s |a_x| = (g + s a_y) tan α.

    Args:
        bodies, motion: what is shaken, and how.
        slips: in place of tan α where it is less: of what falls as it slides, its friction.
    """
    slender = [min(body.slenderness_left, body.slenderness_right) for body in bodies]
    ratio = np.minimum(np.tan(slender), slips)
    strongest = np.full(ratio.size, np.abs(motion.horizontal).max())
    if motion.vertical is not None:
        strongest = np.array(
            [np.max(np.abs(motion.horizontal) - each * motion.vertical) for each in ratio]
        )
    return np.asarray(ratio * STANDARD_GRAVITY / strongest)


def _levels(tipping: NDArray[np.float64], multiple: float, ratio: float) -> NDArray[np.float64]:
    """Scales from the least at which one of the bodies can tip, to `multiple` of the largest."""
    span = multiple * tipping.max() / tipping.min()
    return np.asarray(tipping.min() * ratio ** np.arange(math.ceil(math.log(span, ratio)) + 1))


def _steps(span: float) -> int:
    """How many fine levels a span has."""
    return math.ceil(math.log(span, FINE)) + 1 if span > 1.0 else 1


def _scanned(scales: NDArray[np.float64], fell: NDArray[np.bool_]) -> Scan:
    """A scan from falls at rising scales, (body, polarity, scale)."""
    any_fall = np.asarray(fell.any(axis=-1))
    first = fell.argmax(axis=-1)
    stands_above = ~fell & (np.arange(scales.size) > first[..., None]) & any_fall[..., None]
    count = stands_above.sum(axis=-1)
    last = scales.size - 1 - stands_above[..., ::-1].argmax(axis=-1)
    return Scan(
        below=np.where(any_fall, np.append(0.0, scales)[first], np.nan),
        first=np.where(any_fall, scales[first], np.inf),
        survived=count.astype(np.float64),
        highest=np.where(count > 0, scales[last], np.nan),
    )


def _bisected(
    bodies: Sequence[Body],
    motions: Sequence[Motion],
    signs: NDArray[np.float64],
    model: Model,
    around: Sequence[Surroundings | None],
    below: NDArray[np.float64],
    above: NDArray[np.float64],
    precision: float,
    threads: int | None,
) -> NDArray[np.float64]:
    """The lowest overturning scale, brought to within `precision` of one that does not."""
    where = np.flatnonzero(np.isfinite(above))
    low, high = below.ravel()[where], above.ravel()[where]
    low = np.where(low > 0.0, low, high / FINE)  # below the least level of all nothing moves
    body, motion, sign = np.unravel_index(where, above.shape)
    while where.size and (high / low > 1.0 + precision * (1.0 + 1e-9)).any():
        middle = np.sqrt(low * high)
        runs = simulate_each(
            [bodies[k] for k in body],
            [motions[k] for k in motion],
            scales=middle,
            polarities=signs[sign],
            model=model,
            surroundings=[around[k] for k in body] if any(around) else None,
            progress=False,
            threads=threads,
        )
        overturned = fell(runs).values
        high, low = np.where(overturned, middle, high), np.where(overturned, low, middle)
    scale = above.copy()
    scale.ravel()[where] = high
    return scale


def _warn(scale: NDArray[np.float64]) -> None:
    strange = int((np.isfinite(scale) & (scale > STRANGE)).sum())
    if strange:
        log.warning(
            "%d of %d lowest overturning levels scale a motion by more than %g: what is then "
            "shaken by is hardly an earthquake",
            strange,
            scale.size,
            STRANGE,
        )
    never = int(np.isinf(scale).sum())
    if never:
        log.warning(
            "%d of %d motions did not overturn a body at any level that was tried", never,
            scale.size,
        )  # fmt: skip


def _dataset(
    bodies: Sequence[Body],
    motions: Sequence[Motion],
    signs: NDArray[np.float64],
    name: str,
    unit: str,
    power: int,
    once: NDArray[np.float64],
    found: dict[str, NDArray[np.float64]],
) -> xr.Dataset:
    import xarray as xr

    dims = ("body", "motion", "polarity")
    at_one = once[None, :, None]

    def level(scale: NDArray[np.float64], told: str) -> tuple[object, ...]:
        return dims, at_one * scale**power, {"units": unit, "long_name": f"{name} {told}"}

    return xr.Dataset(
        {
            "capacity": level(found["scale"], "of the lowest level that overturns"),
            "scale": (dims, found["scale"], {"long_name": "factor on the motion there"}),
            "tried": level(found["tried"], "of the highest level that was tried"),
            "survived": (
                dims,
                found["survived"].astype(np.int64),
                {"long_name": "levels above the lowest fall that were survived"},
            ),
            "highest_survived": level(found["above"], "of the highest of these"),
        },
        coords={
            "body": unique_names(bodies),
            "motion": unique_names(motions),
            "polarity": signs.astype(np.int64),
        },
        attrs={"measure": name, "units": unit},
    )
