"""One body under one motion, or many under many."""

from __future__ import annotations

import logging
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.errors import InputError, joined
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.response import Outcome, Response
from shaketable.support import Support
from shaketable.units import STANDARD_GRAVITY, degrees

if TYPE_CHECKING:
    import xarray as xr

log = logging.getLogger(__name__)

MODELS = ("rocking",)
LANES_PER_TASK = 512

STILL_ROCKING = (
    "still rocked an hour after the motion's end and counts as standing: "
    "balanced on an edge, or losing hardly any energy at an impact"
)


def simulate(
    body: Body,
    motion: Motion,
    support: Support | None = None,
    *,
    model: str = "rocking",
    initial_rotation: float = 0.0,
) -> Response:
    """Shake one body and keep its history.

    Args:
        body: what stands on the support.
        motion: ground acceleration, linear between its samples.
        support: tilt and restitution; a level one by default.
        model: "rocking" (physics.md section 2: no sliding, no jump).
        initial_rotation: θ [rad] in (-π/2, π/2) at which the body is let go at t = 0.

    Raises:
        InputError: an unknown model, or a tilt at which the body falls by itself.
    """
    from shaketable.engine import single

    support = support or Support()
    _require_model(model)
    _say_what_is_ignored(support)
    require_stable([body], support.tilt)
    if not -math.pi / 2 < initial_rotation < math.pi / 2:
        raise InputError(
            f"initial_rotation [rad] must lie between -π/2 and π/2, got {initial_rotation!r}"
        )
    blocks = _blocks([body], [support.tilt], support)[0]
    parts = int(_substeps(blocks[None], motion)[0])
    push, gravity, h = _refined(motion, parts)
    samples, crossings = push.size, 64
    while True:
        times = np.empty(samples)
        history = single.History(
            times, np.empty_like(times), np.empty_like(times), np.empty(crossings)
        )
        end = single.rock_one(push, gravity, h, blocks, float(initial_rotation), history)
        if end.samples <= samples and end.impacts <= crossings:
            break
        samples, crossings = end.samples, end.impacts
    if end.ending == single.STILL_ROCKING:
        log.warning("%s %s", body.name or "the body", STILL_ROCKING)
    kept = np.arange(end.samples)
    kept = kept[(kept % parts == 0) | (kept >= push.size)]
    return Response(
        outcome=Outcome(end.direction),
        overturning_time=float(end.overturning_time),
        peak_rotation=float(end.peak),
        impacts=int(end.impacts),
        impact_times=history.impact_times[: end.impacts].copy(),
        time=history.time[kept],
        rotation=history.rotation[kept],
        angular_velocity=history.angular_velocity[kept],
        body=body,
        motion=motion,
        support=support,
    )


def simulate_many(
    bodies: Sequence[Body],
    motions: Sequence[Motion],
    *,
    tilts: Iterable[float] = (0.0,),
    scales: Iterable[float] = (1.0,),
    polarities: Iterable[int] = (1, -1),
    support: Support | None = None,
    model: str = "rocking",
    progress: Progress = True,
    threads: int | None = None,
) -> xr.Dataset:
    """Shake every body under every motion, polarity, tilt and scale, on all cores.

    Args:
        bodies: at least one.
        motions: at least one.
        tilts: β of the support [rad]; the tilt of `support` itself must be 0.
        scales: factors on both components of each motion.
        polarities: 1 and -1; -1 reverses the horizontal component.
        support: everything about the support but its tilt.
        model: "rocking".
        progress: True shows a progress bar with the time left on stderr; a function is told
            instead how many simulations more are done.
        threads: all cores by default; the results do not depend on it.

    Returns:
        Dataset over (body, motion, polarity, tilt, scale): outcome (int8, see Outcome),
        overturning_time [s] (NaN if standing), peak_rotation [rad], impacts.

    Raises:
        InputError: nothing to simulate, or a tilt at which a body falls by itself.
    """
    from shaketable.engine import pool

    support = support or Support()
    tilts, scales, polarities = list(tilts), list(scales), list(polarities)
    _require_model(model)
    if support.tilt != 0.0:
        raise InputError("simulate_many takes the tilt from tilts=, not from its support")
    given = {
        "bodies": bodies,
        "motions": motions,
        "tilts": tilts,
        "scales": scales,
        "polarities": polarities,
    }
    for name, values in given.items():
        if not len(values):
            raise InputError(f"simulate_many needs at least one value in {name}=")
    if not set(polarities) <= {1, -1}:
        raise InputError(f"polarities must be 1 or -1, got {polarities!r}")
    for tilt in tilts:  # the ranges that a support and a body must keep
        Support(tilt=tilt)
    _say_what_is_ignored(support)
    require_stable(bodies, max(tilts))

    blocks = _blocks(bodies, tilts, support)  # (body, tilt, 12)
    shape = (len(bodies), len(polarities), len(tilts))
    of_body, of_polarity, of_tilt = (index.ravel() for index in np.indices(shape))
    members = _Members.empty((len(motions), len(scales), of_body.size))
    polarity = np.array(polarities, np.float64)[of_polarity]

    work = []
    for m, motion in enumerate(motions):
        for s, scale in enumerate(scales):
            loud = motion.scaled(scale)
            parts = _substeps(blocks, loud)[of_body]
            for part in np.unique(parts):
                lanes = np.flatnonzero(parts == part)
                for chunk in np.split(lanes, range(LANES_PER_TASK, lanes.size, LANES_PER_TASK)):
                    piece = partial(
                        _rock,
                        motion,
                        scale,
                        int(part),
                        blocks[of_body[chunk], of_tilt[chunk]],
                        polarity[chunk],
                        members,
                        (m, s, chunk),
                    )
                    energy = float(np.square(loud.horizontal).sum())
                    work.append((energy * part * chunk.size, piece))
    work.sort(key=lambda piece: -piece[0])
    with meter("simulations", int(members.outcome.size), progress) as done:
        pool.run_all([piece for _, piece in work], threads, done)
    if members.still_rocking.any():
        log.warning(
            "%d of %d simulations %s",
            members.still_rocking.sum(),
            members.still_rocking.size,
            STILL_ROCKING,
        )
    return _dataset(members, bodies, motions, polarities, tilts, scales)


@dataclass(frozen=True)
class _Members:
    """What becomes of each member, arrays of shape (motion, scale, lane)."""

    outcome: NDArray[np.int8]
    overturning_time: NDArray[np.float64]
    peak_rotation: NDArray[np.float64]
    impacts: NDArray[np.int32]
    still_rocking: NDArray[np.bool_]

    @classmethod
    def empty(cls, shape: tuple[int, int, int]) -> _Members:
        return cls(
            np.zeros(shape, np.int8),
            np.full(shape, np.nan),
            np.zeros(shape),
            np.zeros(shape, np.int32),
            np.zeros(shape, np.bool_),
        )


def _rock(
    motion: Motion,
    scale: float,
    parts: int,
    blocks: NDArray[np.float64],
    polarity: NDArray[np.float64],
    members: _Members,
    where: tuple[int, int, NDArray[np.intp]],
) -> int:
    """Simulate some members under one motion; returns how many."""
    from shaketable.engine import cpu, single

    count = polarity.size
    push, gravity, h = _refined(motion.scaled(scale), parts)
    lanes = cpu.Lanes(
        blocks,
        polarity,
        ending=np.zeros(count, np.int8),
        direction=np.zeros(count, np.int8),
        overturning_time=np.full(count, np.nan),
        peak=np.zeros(count),
        impacts=np.zeros(count, np.int64),
    )
    demands = cpu.stretch_demands(push, gravity)
    cpu.rock_lanes(push, gravity, demands, h, lanes)
    members.outcome[where] = lanes.direction
    members.overturning_time[where] = lanes.overturning_time
    members.peak_rotation[where] = lanes.peak
    members.impacts[where] = lanes.impacts
    members.still_rocking[where] = lanes.ending == single.STILL_ROCKING
    return count


def _blocks(
    bodies: Sequence[Body], tilts: Sequence[float], support: Support
) -> NDArray[np.float64]:
    """The kernels' view of each body on each tilt, shape (body, tilt, 12)."""
    from shaketable.engine import blocks

    sizes = np.array([(b.width, b.cg_height, b.left, b.gyration_radius) for b in bodies], float)
    kept = support.rocking_restitution
    return blocks.tabulate_blocks(sizes, np.array(tilts, float), math.nan if kept is None else kept)


def _substeps(blocks: NDArray[np.float64], motion: Motion) -> NDArray[np.intp]:
    """Parts to cut a time step into for each body, so that the series is exact, shape (body,)."""
    from shaketable.kernels.taylor import MAX_PHASE

    gravity = STANDARD_GRAVITY if motion.vertical is None else STANDARD_GRAVITY + motion.vertical
    strongest = math.sqrt(float(np.max(motion.horizontal**2 + gravity**2)))
    k = blocks[:, 0, [1, 7]].max(axis=1)  # of both sides
    phase = np.sqrt(k * strongest) * motion.time_step
    parts: NDArray[np.intp] = np.maximum(1, np.ceil(phase / MAX_PHASE)).astype(np.intp)
    return parts


def _refined(motion: Motion, parts: int) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """a_x, g + a_y and the time step, with every step cut into `parts`: the same motion."""
    push = motion.horizontal.copy()  # compiled code tells read-only arrays apart
    lift = np.zeros_like(push) if motion.vertical is None else motion.vertical
    if parts > 1:
        at = np.arange((push.size - 1) * parts + 1) / parts
        push = np.interp(at, np.arange(push.size), push)
        lift = np.interp(at, np.arange(lift.size), lift)
    return push, STANDARD_GRAVITY + lift, motion.time_step / parts


def _require_model(model: str) -> None:
    if model not in MODELS:
        raise InputError(f"unknown model {model!r}; accepted: {', '.join(MODELS)}")


def _say_what_is_ignored(support: Support) -> None:
    if math.isfinite(support.static_friction) or support.restitution:
        log.warning("the rocking model ignores the support's friction and normal restitution")


def require_stable(bodies: Sequence[Body], tilt: float) -> None:
    """InputError that names each body that falls downhill by itself at `tilt` [rad]."""
    faults = [
        f"body {body.name or index}: falls by itself on a support tilted {degrees(tilt):.4g}°; "
        f"it stands below {degrees(body.slenderness_left):.4g}° = atan(left / cg_height)"
        for index, body in enumerate(bodies)
        if tilt >= body.slenderness_left
    ]
    if faults:
        raise InputError(joined(faults))


def _names(things: Sequence[Body] | Sequence[Motion]) -> list[str]:
    """Their names, with a number where two share one or one has none."""
    names = [thing.name for thing in things]
    if all(names) and len(set(names)) == len(names):
        return names
    return [f"{name or 'unnamed'} #{index}" for index, name in enumerate(names)]


def _dataset(
    members: _Members,
    bodies: Sequence[Body],
    motions: Sequence[Motion],
    polarities: list[int],
    tilts: list[float],
    scales: list[float],
) -> xr.Dataset:
    """The members over (body, motion, polarity, tilt, scale), with units."""
    import xarray as xr

    dimensions = ("body", "motion", "polarity", "tilt", "scale")

    def variable(values: NDArray[np.generic], **attributes: object) -> tuple[object, ...]:
        split = values.reshape(len(motions), len(scales), len(bodies), len(polarities), len(tilts))
        return dimensions, split.transpose(2, 0, 3, 4, 1), attributes

    return xr.Dataset(
        {
            "outcome": variable(
                members.outcome,
                long_name="outcome",
                flag_values=[int(o) for o in Outcome],
                flag_meanings=" ".join(o.name.lower() for o in Outcome),
            ),
            "overturning_time": variable(
                members.overturning_time, long_name="time of overturning", units="s"
            ),
            "peak_rotation": variable(
                members.peak_rotation, long_name="peak rotation", units="rad"
            ),
            "impacts": variable(members.impacts, long_name="number of impacts"),
        },
        coords={
            "body": _names(bodies),
            "motion": _names(motions),
            "polarity": polarities,
            "tilt": ("tilt", tilts, {"units": "rad", "long_name": "tilt of the support"}),
            "scale": scales,
        },
    )
