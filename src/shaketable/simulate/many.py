"""Many bodies under many motions, on all cores."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from shaketable.body import Body
from shaketable.engine.endings import SENTENCES
from shaketable.errors import InputError
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.simulate.members import Members, dataset
from shaketable.simulate.setup import (
    blocks_of,
    refined,
    require_model,
    require_stable,
    say_what_to_expect,
    stands_of,
    substeps,
)
from shaketable.support import Support

if TYPE_CHECKING:
    import xarray as xr

    from shaketable.engine import cpu, general_many

log = logging.getLogger(__name__)

LANES_PER_TASK = 512

Where = tuple[int, int, NDArray[np.intp]]  # index of some members: motion, scale, lanes
#: Simulates some lanes under one motion and writes to their members.
Runner = Callable[[Motion, int, NDArray[np.intp], Members, Where], None]


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
        model: "rocking" or "general", as for `simulate`.
        progress: True shows a progress bar with the time left on stderr; a function is told
            instead how many simulations more are done.
        threads: all cores by default; the results do not depend on it.

    Returns:
        Dataset over (body, motion, polarity, tilt, scale): outcome (int8, see Outcome),
        overturning_time [s] (NaN if standing), peak_rotation [rad], impacts. With the general
        model also slip [m] at the end, + uphill, the farthest slip_downhill and slip_uphill [m],
        both >= 0, max_lift [m], and ending (int8; its attributes say what the flags mean).

    Raises:
        InputError: nothing to simulate, an unknown model, a polarity that is neither 1 nor -1, a
            tilted `support`, or a tilt at which a body falls by itself.
    """
    from shaketable.engine import pool

    support = support or Support()
    tilts, scales, polarities = list(tilts), list(scales), list(polarities)
    _require(bodies, motions, tilts, scales, polarities, support, model)
    say_what_to_expect(model, support, max(tilts))

    shape = (len(bodies), len(polarities), len(tilts))
    of_body, of_polarity, of_tilt = (index.ravel() for index in np.indices(shape))
    members = Members.empty((len(motions), len(scales), of_body.size))
    polarity = np.array(polarities, np.float64)[of_polarity]
    blocks = blocks_of(bodies, tilts, support)
    if model == "rocking":
        run = _rocking_runner(blocks[of_body, of_tilt], polarity)
    else:
        run = _general_runner(stands_of(bodies, tilts, support)[of_body, of_tilt], polarity)

    work = []
    for m, motion in enumerate(motions):
        for s, scale in enumerate(scales):
            loud = motion.scaled(scale)
            parts = substeps(blocks, loud)[of_body]
            energy = float(np.square(loud.horizontal).sum())
            for part in np.unique(parts):
                lanes = np.flatnonzero(parts == part)
                for chunk in np.split(lanes, range(LANES_PER_TASK, lanes.size, LANES_PER_TASK)):
                    # scaled only where it is simulated: a thousand motions need not lie around
                    piece = partial(
                        _simulate, run, motion, scale, int(part), members, (m, s, chunk)
                    )
                    work.append((energy * part * chunk.size, piece))
    work.sort(key=lambda piece: -piece[0])
    with meter("simulations", int(members.outcome.size), progress) as done:
        pool.run_all([piece for _, piece in work], threads, done)
    for ending, sentence in SENTENCES.items():
        count = int((members.ending == ending).sum())
        if count:
            log.warning("%d of %d simulations %s", count, members.ending.size, sentence)
    return dataset(members, model, bodies, motions, polarities, tilts, scales)


def _require(
    bodies: Sequence[Body],
    motions: Sequence[Motion],
    tilts: Sequence[float],
    scales: Sequence[float],
    polarities: Sequence[int],
    support: Support,
    model: str,
) -> None:
    """InputError for what cannot be simulated."""
    require_model(model)
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
    require_stable(bodies, max(tilts))


def _simulate(
    run: Runner, motion: Motion, scale: float, parts: int, members: Members, where: Where
) -> int:
    """Simulate some members under one motion; returns how many."""
    run(motion.scaled(scale), parts, where[2], members, where)
    return where[2].size


def _write_common(members: Members, where: Where, found: cpu.Lanes | general_many.Crowd) -> None:
    """What both models tell of a simulation."""
    members.outcome[where] = found.direction
    members.overturning_time[where] = found.overturning_time
    members.peak_rotation[where] = found.peak
    members.impacts[where] = found.impacts
    members.ending[where] = found.ending


def _rocking_runner(blocks: NDArray[np.float64], polarity: NDArray[np.float64]) -> Runner:
    """`blocks` and `polarity` of every lane."""
    from shaketable.engine import cpu

    def run(
        motion: Motion, parts: int, chunk: NDArray[np.intp], members: Members, where: Where
    ) -> None:
        push, gravity, h = refined(motion, parts)
        count = chunk.size
        lanes = cpu.Lanes(
            blocks[chunk],
            polarity[chunk],
            ending=np.zeros(count, np.int8),
            direction=np.zeros(count, np.int8),
            overturning_time=np.full(count, np.nan),
            peak=np.zeros(count),
            impacts=np.zeros(count, np.int64),
        )
        cpu.rock_lanes(push, gravity, cpu.stretch_demands(push, gravity), h, lanes)
        _write_common(members, where, lanes)

    return run


def _general_runner(stands: NDArray[np.float64], polarity: NDArray[np.float64]) -> Runner:
    """`stands` and `polarity` of every lane."""
    from shaketable.engine import cpu, general_many
    from shaketable.engine.stands import tabulate_grips

    grips = tabulate_grips(stands)

    def run(
        motion: Motion, parts: int, chunk: NDArray[np.intp], members: Members, where: Where
    ) -> None:
        push, gravity, h = refined(motion, parts)
        count = chunk.size
        crowd = general_many.Crowd(
            stands[chunk],
            grips[chunk],
            polarity[chunk],
            ending=np.zeros(count, np.int8),
            direction=np.zeros(count, np.int8),
            overturning_time=np.full(count, np.nan),
            peak=np.zeros(count),
            impacts=np.zeros(count, np.int64),
            slip=np.zeros(count),
            farthest_down=np.zeros(count),
            farthest_up=np.zeros(count),
            lift=np.zeros(count),
        )
        demands = cpu.stretch_demands(push, gravity)
        general_many.move_crowd(push, gravity, demands, h, crowd)
        _write_common(members, where, crowd)
        members.slip[where] = crowd.slip
        members.slip_downhill[where] = np.abs(crowd.farthest_down)
        members.slip_uphill[where] = crowd.farthest_up
        members.max_lift[where] = crowd.lift

    return run
