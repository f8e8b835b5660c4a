"""An assessment in pieces that a store keeps, for inventories of many thousand objects.

Each piece is one object of the store, which appears whole or not at all; what is there is not done
again.
"""

from __future__ import annotations

import hashlib
import json
import platform
import threading
import time
import uuid
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from shaketable.assess.assessment import Assessment
from shaketable.assess.job import assess
from shaketable.assess.record import from_json, to_json
from shaketable.campaign.beginning import require_store
from shaketable.campaign.driver import forget_failures, require_all_done, stopping
from shaketable.campaign.fingerprint import environment, motion_hash, source_hash
from shaketable.campaign.inputs import PLAN, load_model, told_of_model
from shaketable.campaign.lock import LOCK, locked, require_held
from shaketable.campaign.motions import StoredMotions, save_motions
from shaketable.campaign.objects import Objects, disk_of
from shaketable.campaign.tally import BlockTally
from shaketable.campaign.work import BEGUN, require_begun
from shaketable.engine.pool import at_most
from shaketable.errors import InputError, SimulationError
from shaketable.inventory import Item
from shaketable.lazy_motions import heads_of
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.records.pairs import joined_pairs

REPORT = "report"  # the kind of such a store
PIECE = 64  # items
SAMPLE = 8  # of them, to tell how long it will take
VERSIONS, CODE = "versions of packages", "shaketable's code"
RESULTS = "results/items"


@dataclass(frozen=True, kw_only=True, eq=False)
class ReportJob:
    """What is assessed: arguments of `assess`, and what to call inventory and motions.

    Attributes:
        in_pairs: whether objects are also assessed in three dimensions, under the pairs of
            components among the motions.
    """

    items: Sequence[Item]
    motions: Sequence[Motion]
    scale: float
    tilt: float
    model: Model
    inventory: str = ""
    motions_told: str = ""
    in_pairs: bool = False
    piece_size: int = PIECE

    @cached_property
    def pairs(self) -> list[Motion]:
        """Both components of a recording as one motion, where they are wanted."""
        return joined_pairs(self.motions) if self.in_pairs else []

    @property
    def pieces(self) -> int:
        """How many pieces it has."""
        return -(-len(self.items) // self.piece_size)

    def items_of(self, number: int) -> Sequence[Item]:
        """The items of a piece."""
        return self.items[number * self.piece_size : (number + 1) * self.piece_size]

    def piece(self, number: int, progress: Progress) -> Assessment:
        """The assessment of a piece's items."""
        return assess(
            self.items_of(number),
            self.motions,
            scale=self.scale,
            tilt=self.tilt,
            model=self.model,
            pairs=self.pairs,
            progress=progress,
        )


def run_report(
    job: ReportJob,
    store: str | Path,
    *,
    client: Any = None,
    fresh: bool = False,
    progress: Progress = True,
) -> None:
    """Assess what is missing of a job.

    Args:
        job: what to assess; none of its items is anchored.
        store: folder or URL.
        client: a dask.distributed.Client whose workers do it; this process by default.
        fresh: begin anew, whatever the store holds.
        progress: whether to draw a bar.

    Raises:
        InputError: what `assess` says, or a store that was begun with something else.
        SimulationError: pieces that failed on workers, all others being done.
    """
    objects = Objects(store)
    require_store(objects)
    with disk_of(objects), locked(objects) as lost:
        made = _begin(job, objects, fresh)
        forget_failures(objects)
        missing = [k for k in range(job.pieces) if not _is_whole(objects, k, made)]
        count, tally = sum(len(job.items_of(k)) for k in missing), BlockTally(len(missing))
        with meter("objects", count, progress, tally.__str__) as done:
            if client is None:
                _run_here(ReportSite(job, made, objects), missing, done, tally, lost)
                return
            from shaketable.campaign.cluster import Task, run_on

            task = Task(site_of, do_piece)
            failures = run_on(client, task, missing, objects, done, tally, lost)
        require_all_done(failures, job.pieces, objects)


class ReportSite(NamedTuple):
    """A store of an assessment."""

    job: ReportJob
    made: str  # hash of all that the results depend on
    objects: Objects

    def assess(self, number: int) -> bytes:
        """The results of a piece as they are kept."""
        found = self.job.piece(number, False)
        return _packed(self.made, [to_json(one) for one in found.results])


def _run_here(
    site: ReportSite,
    missing: Sequence[int],
    done: Callable[[int], None],
    tally: BlockTally,
    lost: threading.Event,
) -> None:
    with stopping() as stopped:
        for number in missing:
            require_held(lost, site.objects)
            if stopped.is_set():
                raise KeyboardInterrupt
            site.objects.put(_name(number), site.assess(number))
            tally.done += 1
            done(len(site.job.items_of(number)))


_FIRST = threading.Lock()  # of the threads of a worker only one reads the plan


def site_of(place: str, begun: str) -> ReportSite:
    """A store as a worker sees it, read once in each process.

    Args:
        place: of the store.
        begun: changes with every new beginning of a store.

    Raises:
        SimulationError: the worker has other code or versions.
    """
    with _FIRST:
        return _site(place, begun)


@lru_cache(maxsize=2)
def _site(place: str, begun: str) -> ReportSite:
    objects = Objects(place)
    told = objects.get_json(PLAN)
    if told is None:
        raise SimulationError(f"{place}: no campaign is there, seen from {platform.node()}")
    made = told["fingerprint"]
    mine = {VERSIONS: environment(), CODE: source_hash("**/*.py")}
    other = [name for name, there in mine.items() if made[name] != there]
    if other:
        raise SimulationError(f"the worker on {platform.node()} has other {' and '.join(other)}")
    return ReportSite(_load(objects, told), _hash(made), objects)


def do_piece(place: str, begun: str, number: int) -> tuple[int, str]:
    """Assess and write a piece on a worker, on one of its threads.

    Returns:
        The items, and why it failed, "" if it did not.
    """
    site = site_of(place, begun)
    try:
        with at_most(1):
            content = site.assess(number)
    except InputError as error:
        return 0, str(error)
    # the store may have been begun anew while this piece was at work
    require_begun(site.objects, begun)
    site.objects.put(_name(number), content)
    return len(site.job.items_of(number)), ""


def seconds_of(job: ReportJob) -> float:
    """How long a job would take here, about: a sample of its items is assessed."""
    some = [job.items[k] for k in np.unique(np.linspace(0, len(job.items) - 1, SAMPLE).astype(int))]
    replace(job, items=some[:1]).piece(0, False)  # compiles
    start = time.perf_counter()
    replace(job, items=some, piece_size=SAMPLE).piece(0, False)
    return (time.perf_counter() - start) * len(job.items) / len(some)


def is_report(objects: Objects) -> bool:
    """Whether a store holds an assessment."""
    return (objects.get_json(PLAN) or {}).get("kind") == REPORT


def read_report(objects: Objects) -> tuple[Assessment, ReportJob, dict[str, Any]]:
    """The assessment of all pieces, its job, and what it depends on.

    Raises:
        InputError: it is not done.
        SimulationError: something is damaged.
    """
    told = objects.get_json(PLAN) or {}
    if told.get("kind") != REPORT:
        raise InputError(f"{objects.place}: no assessment is there")
    job = _load(objects, told)
    made = _hash(told["fingerprint"])
    results = []
    for number in range(job.pieces):
        content = objects.get(_name(number))
        if content is None:
            raise InputError(
                f"{objects.place}: {number:,} of {job.pieces:,} pieces or more are done; run the "
                "campaign again to do the rest"
            )
        before = number * job.piece_size
        found = [from_json(one) for one in _unpacked(content, made, objects, number)]
        results += [replace(one, number=before + one.number) for one in found]
    # one item alone tells what is the same for all: motions, recordings, peaks
    first = replace(job, items=job.items[:1]).piece(0, False)
    floor = replace(first.floors[0], results=results)
    return replace(first, floors=[floor]), job, told["fingerprint"]


def _begin(job: ReportJob, objects: Objects, fresh: bool) -> str:
    """Make a store ready; returns a hash of all that the results depend on."""
    items = [to_json(item) for item in job.items]
    made = {
        VERSIONS: environment(),
        CODE: source_hash("**/*.py"),
        "items": hashlib.sha256(json.dumps(items).encode()).hexdigest(),
        "motions": [motion_hash(motion) for motion in job.motions],
        "scale": job.scale,
        "tilt": job.tilt,
        "model": repr(job.model),
        "pairs": job.in_pairs,
        "vertical": any(head.has_vertical for head in heads_of(job.motions)),
        "piece": job.piece_size,
    }
    told = None if fresh else objects.get_json(PLAN)
    if told is not None:
        there = told.get("fingerprint", {})
        if there == made:
            return _hash(made)
        changed = [name for name in made if there.get(name) != made[name]]
        raise InputError(
            f"{objects.place}: was begun with another campaign, which differs in "
            f"{', '.join(changed)}; go on with what it was begun with, give another store, or "
            "--fresh to delete what is done and begin anew"
        )
    objects.put_json(BEGUN, {"token": uuid.uuid4().hex, "time": time.time()})
    for name in objects.names("campaign"):
        if f"campaign/{name}" not in (LOCK, BEGUN):
            objects.remove(f"campaign/{name}")
    objects.remove("results")
    save_motions(job.motions, objects)
    objects.put_json(
        PLAN,
        {
            "kind": REPORT,
            "fingerprint": made,
            "items": items,
            "motions": [head.as_dict() for head in heads_of(job.motions)],
            "scale": job.scale,
            "tilt": job.tilt,
            "model": told_of_model(job.model),
            "pairs": job.in_pairs,
            "inventory": job.inventory,
            "motions_told": job.motions_told,
        },
    )
    return _hash(made)


def _load(objects: Objects, told: dict[str, Any]) -> ReportJob:
    try:
        made = told["fingerprint"]
        return ReportJob(
            items=[from_json(one) for one in told["items"]],
            motions=list(StoredMotions(objects, told["motions"], made["motions"])),
            scale=told["scale"],
            tilt=told["tilt"],
            model=load_model(told["model"]),
            inventory=told["inventory"],
            motions_told=told["motions_told"],
            in_pairs=told["pairs"],
            piece_size=made["piece"],
        )
    except (KeyError, TypeError, ValueError) as error:
        raise SimulationError(f"{objects.place}: the plan is damaged ({error})") from None


def _name(number: int) -> str:
    return f"{RESULTS}/{number:08d}.json.z"


def _packed(made: str, results: list[Any]) -> bytes:
    return zlib.compress(json.dumps({"made": made, "results": results}).encode())


def _unpacked(content: bytes, made: str, objects: Objects, number: int) -> list[Any]:
    """The results of a piece; zlib's checksum tells a damaged one."""
    try:
        told = json.loads(zlib.decompress(content))
        if told["made"] != made:
            raise ValueError("it is of another campaign")
        found: list[Any] = told["results"]
    except (zlib.error, ValueError, KeyError, TypeError) as error:
        raise SimulationError(
            f"{objects.place}: {_name(number)} is damaged ({error}); run the campaign again"
        ) from None
    return found


def _is_whole(objects: Objects, number: int, made: str) -> bool:
    content = objects.get(_name(number))
    try:
        return content is not None and bool(_unpacked(content, made, objects, number))
    except SimulationError:
        return False


def _hash(made: dict[str, Any]) -> str:
    return hashlib.sha256(json.dumps(made, sort_keys=True).encode()).hexdigest()[:32]


def status_of_report(objects: Objects) -> tuple[int, int]:
    """Items that are assessed, and all."""
    told = objects.get_json(PLAN) or {}
    count = len(told.get("items", ()))
    pieces = [name for name in objects.names(RESULTS) if name.endswith(".json.z")]
    size = told.get("fingerprint", {}).get("piece", PIECE)
    return min(count, size * len(pieces)), count
