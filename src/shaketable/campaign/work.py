"""What a campaign does in blocks that its store keeps: simulations, an inventory, or rooms.

Everything else of the campaign, its lock, its blocks, its workers and their failures, is the same
for every kind of work; `kinds.kind_of` lists them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, ClassVar, NamedTuple, Protocol

from shaketable.campaign.objects import Objects
from shaketable.motion import Motion
from shaketable.progress import Progress

PLAN = "campaign/plan.json"
RESULTS = "results"  # all that blocks write lies below it


class BlockResult(NamedTuple):
    """What a block gave, before it is written."""

    values: Any
    amount: int  # how much was done
    notes: Mapping[str, Any]  # extra JSON for the block's note


class Work(Protocol):
    """What a campaign does.

    Attributes:
        kind: its word in the plan.
        counted: the unit of `count`: "simulations", "objects" or "rooms".
        chunks: how many objects a block writes.
    """

    kind: ClassVar[str]
    counted: ClassVar[str]

    @property
    def motions(self) -> Sequence[Motion]: ...
    @property
    def blocks(self) -> int:
        """How many there are."""

    @property
    def chunks(self) -> int: ...
    @property
    def size(self) -> int:
        """An upper estimate of all results before compression [bytes]."""

    @property
    def device(self) -> str: ...
    @property
    def named(self) -> Mapping[str, Sequence[Any]]:
        """Entries of the fingerprint that are lists of hashes → the objects, in the same order."""

    @property
    def total(self) -> int:
        """How much all blocks have to do."""

    def count(self, number: int) -> int:
        """How much a block has to do; no motion is read for it."""

    def longest_first(self) -> list[int]:
        """The numbers of all blocks, those with the most work first."""

    def fingerprint(self) -> dict[str, Any]:
        """All that the results depend on, by names that a message can use."""

    def parts_of(self, number: int, made: Mapping[str, Any]) -> dict[str, Any]:
        """The entries of a fingerprint that differ between blocks, for one of them."""

    def told(self) -> dict[str, Any]:
        """The JSON from which `load` rebuilds it, with motions and fingerprint."""

    def create(self, objects: Objects) -> None:
        """Write what must be there before any block."""

    def is_there(self, objects: Objects) -> bool:
        """Whether what `create` wrote is there, and undamaged."""

    def opened(self, objects: Objects) -> Any:
        """What `write` is given, opened once."""

    def do(self, number: int, progress: Progress) -> BlockResult:
        """Do a block, on as many cores as `pool.available_cores` tells."""

    def write(self, number: int, values: Any, kept: Any, objects: Objects) -> dict[str, list[int]]:
        """Write a block's objects; return {name: [size in bytes, CRC-32]}."""

    def warn(self, notes: Iterable[Mapping[str, Any]]) -> None:
        """Tell of what is odd about the blocks that are done."""

    def sample(self) -> tuple[int, float]:
        """How much of it was done as a sample, and the seconds that this took."""
