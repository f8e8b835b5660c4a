"""How far a campaign is, and what it would take."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import Any

from shaketable.campaign.beginning import bytes_of_inputs
from shaketable.campaign.kinds import work_of
from shaketable.campaign.lock import age_of, holder_of, is_over
from shaketable.campaign.notes import FAILED, failed_name, faults_of, notes_of, numbers_in
from shaketable.campaign.objects import Objects
from shaketable.campaign.work import Work


@dataclass(frozen=True, kw_only=True)
class Status:
    """How far a campaign is.

    Attributes:
        counted: what its blocks are counted in: "simulations" or "objects".
        blocks, count: how many blocks, and how much of that, the whole campaign has.
        blocks_done, count_done: of them so far.
        failed: why blocks failed in the last run, by their numbers.
        damaged: blocks whose results are missing or cut short; they are not among those done.
        seconds: worker time of the finished blocks, summed [s].
        size: of the finished blocks in the store [bytes].
        hosts: how many blocks each machine did.
        holder: of the lock: host, process and the age of its heartbeat [s]; None if nobody runs it.
        gone: whether that process is known to be gone.
    """

    counted: str
    blocks: int
    count: int
    blocks_done: int
    count_done: int
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
    work = work_of(objects, check=False)
    holder = holder_of(objects)
    noted = notes_of(work, objects)
    faults = faults_of(noted, objects, whole=False)
    notes = [note for number, note in noted.items() if number not in faults]
    failed = {
        number: str((objects.get_json(failed_name(number)) or {}).get("reason", ""))
        for number in numbers_in(FAILED, objects)
    }
    return Status(
        counted=work.counted,
        blocks=work.blocks,
        count=work.total,
        blocks_done=len(notes),
        count_done=sum(int(note.get("count", 0)) for note in notes),
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
        counted: what its blocks are counted in: "simulations" or "objects".
        blocks, count: how many blocks, and how much of that.
        size: bytes of the results before compression.
        inputs: estimated size of bodies and motions [bytes].
        rate: of this process, measured with a sample [`counted`/s].
    """

    counted: str
    blocks: int
    count: int
    size: int
    inputs: int
    rate: float

    @property
    def seconds(self) -> float:
        """Estimated time in this process [s]."""
        return self.count / self.rate


def estimate(work: Work) -> Estimate:
    """Count, and do a sample."""
    count, seconds = work.sample()
    return Estimate(
        counted=work.counted,
        blocks=work.blocks,
        count=work.total,
        size=work.size,
        inputs=bytes_of_inputs(work),
        rate=count / seconds,
    )
