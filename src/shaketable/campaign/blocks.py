"""One block: done, written, and noted as done; the same in this process and on a worker."""

from __future__ import annotations

import platform
import time
from collections.abc import Mapping
from functools import lru_cache
from threading import Lock
from typing import Any, NamedTuple

from shaketable.campaign.fingerprint import key_of
from shaketable.campaign.kinds import load, require_environment, require_format
from shaketable.campaign.notes import done_name
from shaketable.campaign.objects import Objects
from shaketable.campaign.work import PLAN, BlockResult, Work
from shaketable.engine.pool import at_most
from shaketable.errors import InputError, SimulationError
from shaketable.progress import Progress
from shaketable.simulate.kinds import CUDA

BEGUN = "campaign/begun.json"


def do_timed(work: Work, number: int, progress: Progress = False) -> tuple[BlockResult, float]:
    """Do a block; returns what it gave, and the seconds that it took."""
    start = time.perf_counter()
    return work.do(number, progress), time.perf_counter() - start


def require_begun(objects: Objects, token: str) -> None:
    """SimulationError unless the store's token is this one."""
    if (objects.get_json(BEGUN) or {}).get("token") != token:
        raise SimulationError(
            f"{objects.place}: was begun anew; this block is of an older campaign"
        )


class Site(NamedTuple):
    """A store and what is done in it, ready to take blocks."""

    work: Work
    made: Mapping[str, Any]  # all that its results depend on
    objects: Objects
    kept: Any  # what the work opened in it

    def write(
        self, number: int, result: BlockResult, seconds: float, token: str | None = None
    ) -> None:
        """Write a block, and then that it is done, unless the store was begun anew."""
        sizes = self.work.write(number, result.values, self.kept, self.objects)
        if token is not None:
            require_begun(self.objects, token)
        self.objects.put_json(
            done_name(number),
            {
                "key": key_of(self.made, self.work.parts_of(number, self.made)),
                "count": result.amount,
                **result.notes,
                "seconds": seconds,
                "host": platform.node(),
                "chunks": sizes,
            },
        )


_FIRST = Lock()  # of the threads of a worker only one reads the plan


def site_of(place: str, begun: str) -> Site:
    """A store as a worker sees it, read once in each process.

    Args:
        place: of the store.
        begun: changes with every new beginning of a store.

    Raises:
        SimulationError: the worker has other code or versions, or does not see the store.
    """
    with _FIRST:
        return _site(place, begun)


@lru_cache(maxsize=2)
def _site(place: str, begun: str) -> Site:
    objects = Objects(place)
    told = objects.get_json(PLAN)
    if told is None:
        raise SimulationError(f"{place}: no campaign is there, seen from {platform.node()}")
    require_format(told, objects)
    require_environment(told)
    work = load(objects, told)
    if work.device == CUDA:
        from shaketable.engine.cuda import require_gpu

        require_gpu()
    return Site(work, told["fingerprint"], objects, work.opened(objects))


def prepare(place: str, begun: str) -> None:
    """Read the store on a worker, so that what is wrong is told before any work; see `site_of`."""
    site_of(place, begun)


def do_block(place: str, begun: str, number: int) -> tuple[int, str]:
    """Do and write a block on a worker, on one of its threads.

    Returns:
        How much was done, and the reason of a failure, "" on success.

    Raises:
        SimulationError: the store was begun anew, or the worker may not work on it.
    """
    site = site_of(place, begun)
    try:
        with at_most(1):
            result, seconds = do_timed(site.work, number)
    except InputError as error:
        return 0, str(error)
    # the store may have been begun anew while this block was at work
    require_begun(site.objects, begun)
    site.write(number, result, seconds, begun)
    return result.amount, ""
