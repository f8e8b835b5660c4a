"""How far a campaign is, and what it would take."""

from __future__ import annotations

import time
from collections import Counter
from dataclasses import dataclass
from typing import Any

import numpy as np

from shaketable.campaign.beginning import bytes_of, bytes_of_inputs
from shaketable.campaign.lock import age_of, holder_of, is_over
from shaketable.campaign.notes import faults_of, notes_of, numbers_in
from shaketable.campaign.objects import Objects
from shaketable.campaign.plan import Plan
from shaketable.campaign.results import plan_of
from shaketable.campaign.work import FAILED, failed_name
from shaketable.simulate.kinds import are_solids

PROBE = (24, 16)  # bodies and motions
PROBE_OF_SOLIDS = (4, 8)


@dataclass(frozen=True, kw_only=True)
class Status:
    """How far a campaign is.

    Attributes:
        blocks, simulations: of the whole campaign.
        done, simulated: of them so far.
        failed: why blocks failed in the last run, by their numbers.
        damaged: blocks whose results are missing or cut short; they are not among those done.
        seconds: of workers, that what is done took.
        size: bytes in the store of what is done.
        hosts: how many blocks each machine did.
        holder: of the lock: host, process and the age of its heartbeat [s]; None if nobody runs it.
        gone: whether that process is known to be gone.
    """

    blocks: int
    simulations: int
    done: int
    simulated: int
    failed: dict[int, str]
    damaged: int
    seconds: float
    size: int
    hosts: dict[str, int]
    holder: tuple[str, int, float] | None
    gone: bool


def status_of(objects: Objects) -> Status:
    """How far the campaign of a store is.

    Raises:
        InputError: no campaign is there.
    """
    plan = plan_of(objects)
    holder = holder_of(objects)
    noted = notes_of(plan, objects)
    faults = faults_of(noted, objects, whole=False)
    notes = [note for number, note in noted.items() if number not in faults]
    failed = {
        number: str((objects.get_json(failed_name(number)) or {}).get("reason", ""))
        for number in numbers_in(FAILED, objects)
    }
    return Status(
        blocks=int(np.prod(plan.grid)),
        simulations=plan.simulations,
        done=len(notes),
        simulated=sum(int(note.get("simulations", 0)) for note in notes),
        failed=failed,
        damaged=len(faults),
        seconds=sum(float(note.get("seconds", 0.0)) for note in notes),
        size=sum(size for note in notes for size, _ in note["chunks"].values()),
        hosts=dict(Counter(str(note.get("host", "")) for note in notes)),
        holder=_told(holder) if holder else None,
        gone=is_over(holder, age_of(holder)) if holder else False,
    )


def _told(holder: dict[str, Any]) -> tuple[str, int, float]:
    return str(holder.get("host", "")), int(holder.get("process", 0)), age_of(holder)


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """What a campaign would take.

    Attributes:
        blocks, simulations: how many.
        size: bytes of the results before compression.
        inputs: bytes of bodies and motions, about.
        rate: simulations a second of this process, of a sample of the campaign.
    """

    blocks: int
    simulations: int
    size: int
    inputs: int
    rate: float

    @property
    def seconds(self) -> float:
        """That it would take here."""
        return self.simulations / self.rate


def estimate(plan: Plan, threads: int | None = None) -> Estimate:
    """Count, and simulate a sample: bodies and motions spread evenly over all of them."""
    ensemble = plan.ensemble
    probe = PROBE_OF_SOLIDS if are_solids(ensemble.bodies) else PROBE
    some = ensemble.some(
        _spread(len(ensemble.bodies), probe[0]), _spread(len(ensemble.motions), probe[1])
    )
    first = some.some([0], [0])
    first.run(lambda part: None, threads, False)  # compiles
    start = time.perf_counter()
    some.run(lambda part: None, threads, False)
    rate = int(np.prod(some.shape)) / (time.perf_counter() - start)
    return Estimate(
        blocks=int(np.prod(plan.grid)),
        simulations=plan.simulations,
        size=bytes_of(plan),
        inputs=bytes_of_inputs(plan),
        rate=rate,
    )


def _spread(count: int, most: int) -> list[int]:
    return [int(k) for k in np.unique(np.linspace(0, count - 1, most).astype(int))]
