"""One block: simulated, written, and noted as done; the same in this process and on a worker."""

from __future__ import annotations

import platform
import time
from collections import Counter
from collections.abc import Mapping
from functools import lru_cache
from threading import Lock
from typing import Any, NamedTuple

from numpy.typing import NDArray

from shaketable.campaign import arrays, inputs, summary
from shaketable.campaign.fingerprint import environment, key_of
from shaketable.campaign.objects import Objects
from shaketable.campaign.plan import ALL, Block, Plan
from shaketable.errors import InputError, SimulationError
from shaketable.progress import Progress
from shaketable.simulate.kinds import CUDA

DONE, FAILED = "campaign/done", "campaign/failed"
BEGUN = "campaign/begun.json"


class Result(NamedTuple):
    """What a block gave, before it is written."""

    block: Block
    values: Mapping[str, NDArray[Any]]
    endings: Counter[int]
    seconds: float


def simulate_block(
    plan: Plan, block: Block, threads: int | None = None, progress: Progress = False
) -> Result:
    """Simulate a block.

    Raises:
        InputError: a body that falls by itself on one of the tilts.
    """
    start = time.perf_counter()
    ensemble = plan.ensemble_of(block)
    ensemble.require_standing()
    values: Mapping[str, NDArray[Any]]
    if plan.keep == ALL:
        results = ensemble.results()
        endings = ensemble.run(results.store, threads, progress, plan.device)
        values = arrays.values_of_all(results, ensemble)
    else:
        which = slice(block.first_motion, block.end_motion)
        tally = summary.SummaryTally(
            ensemble, plan.sources.recording[which], plan.sources.event[which]
        )
        endings = ensemble.run(tally.store, threads, progress, plan.device)
        values = arrays.values_of_summary(tally.summary, plan)
    return Result(block, values, endings, time.perf_counter() - start)


def require_begun(objects: Objects, token: str) -> None:
    """SimulationError if a store is not, or no longer, that of this beginning."""
    if (objects.get_json(BEGUN) or {}).get("token") != token:
        raise SimulationError(
            f"{objects.place}: was begun anew; this block is of an older campaign"
        )


def write_block(
    plan: Plan,
    result: Result,
    key: str,
    kept: Mapping[str, Any],
    objects: Objects,
    token: str | None = None,
) -> None:
    """Write the chunks of a block, and then that it is done, unless the store was begun anew."""
    sizes = arrays.write(result.values, plan, result.block, kept, objects)
    if token is not None:
        require_begun(objects, token)
    objects.put_json(
        done_name(result.block.number),
        {
            "key": key,
            "simulations": sum(result.endings.values()),
            "endings": {str(int(code)): number for code, number in result.endings.items()},
            "seconds": result.seconds,
            "host": platform.node(),
            "chunks": sizes,
        },
    )


def done_name(number: int) -> str:
    return f"{DONE}/{number:08d}.json"


def failed_name(number: int) -> str:
    return f"{FAILED}/{number:08d}.json"


class CampaignSite(NamedTuple):
    """A store as a worker sees it."""

    plan: Plan
    made: Mapping[str, Any]
    arrays: Mapping[str, Any]
    objects: Objects


_FIRST = Lock()  # of the threads of a worker only one reads the plan


def site_of(place: str, begun: str) -> CampaignSite:
    """The plan and the arrays of a store, read once in each process.

    Args:
        place: of the store.
        begun: changes with every new beginning of a store.
    """
    with _FIRST:
        return _site(place, begun)


@lru_cache(maxsize=2)
def _site(place: str, begun: str) -> CampaignSite:
    objects = Objects(place)
    told = objects.get_json(inputs.PLAN)
    if told is None:
        raise SimulationError(f"{place}: no campaign is there, seen from {platform.node()}")
    made = told["fingerprint"]
    mine = environment()
    if made["environment"] != mine:
        other = ", ".join(
            f"{name} {mine.get(name)} in place of {there}"
            for name, there in made["environment"].items()
            if mine.get(name) != there
        )
        raise SimulationError(f"the worker on {platform.node()} has {other}")
    plan = inputs.load(objects, told)
    if plan.device == CUDA:
        from shaketable.engine.cuda import require_gpu

        require_gpu()
    return CampaignSite(plan, made, arrays.opened(plan, objects), objects)


def do_block(place: str, begun: str, number: int) -> tuple[int, str]:
    """Simulate and write a block on a worker, on one of its threads.

    Returns:
        The simulations, and why it failed, "" if it did not.
    """
    site = site_of(place, begun)
    block = site.plan.block(number)
    try:
        result = simulate_block(site.plan, block, threads=1)
    except InputError as error:
        return 0, str(error)
    # the store may have been begun anew while this block was at work
    require_begun(site.objects, begun)
    write_block(site.plan, result, key_of(block, site.made), site.arrays, site.objects, begun)
    return sum(result.endings.values()), ""
