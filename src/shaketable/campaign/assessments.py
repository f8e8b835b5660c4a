"""The assessment of an inventory, some objects at a time, for inventories of many thousands."""

from __future__ import annotations

import json
import time
import zlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar

from shaketable.assess.assessment import Assessment
from shaketable.assess.carried import kick_among
from shaketable.assess.job import assess
from shaketable.assess.walls import walls_of
from shaketable.campaign.as_json import from_json, to_json
from shaketable.campaign.fingerprint import environment, motion_hash, thing_hash
from shaketable.campaign.motions import StoredMotions
from shaketable.campaign.notes import whole_notes
from shaketable.campaign.objects import Objects
from shaketable.campaign.simulations import spread
from shaketable.campaign.work import RESULTS, BlockResult
from shaketable.errors import SimulationError
from shaketable.inventory import Item
from shaketable.lazy_motions import heads_of
from shaketable.models import Model
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.records.pairs import joined_pairs
from shaketable.simulate.kinds import CPU

ITEMS = 64  # of a block
SAMPLE = 8  # items, to tell how long it will take
ITEM = 15_000  # bytes of the results of an item before compression, rather more


@dataclass(frozen=True, kw_only=True, eq=False)
class Assessments:
    """A `Work` that assesses an inventory in blocks.

    Attributes:
        items: none of them anchored.
        motions, scale, model: as for `assess`.
        tilt: of all supports [rad], 0 or more.
        inventory, motions_told: what the report calls them.
        inventory_sha256: of the inventory's file.
        in_pairs: whether objects are also assessed in three dimensions, under the pairs of
            components among the motions.
    """

    items: Sequence[Item]
    motions: Sequence[Motion]
    scale: float
    tilt: float
    model: Model
    inventory: str = ""
    inventory_sha256: str = ""
    motions_told: str = ""
    in_pairs: bool = False
    items_per_block: int = ITEMS

    kind: ClassVar[str] = "assessments"
    counted: ClassVar[str] = "objects"
    chunks: ClassVar[int] = 1
    device: ClassVar[str] = CPU

    @cached_property
    def shaking(self) -> list[Motion]:
        """The motions in memory: each block needs all of them."""
        return joined_pairs(self.motions) if self.in_pairs else list(self.motions)

    @property
    def blocks(self) -> int:
        return -(-len(self.items) // self.items_per_block)

    @property
    def size(self) -> int:
        return ITEM * len(self.items)

    @property
    def named(self) -> Mapping[str, Sequence[Any]]:
        return {"items": self.items, "motions": heads_of(self.motions)}

    def _which(self, number: int) -> slice:
        return slice(number * self.items_per_block, (number + 1) * self.items_per_block)

    @property
    def total(self) -> int:
        return len(self.items)

    def count(self, number: int) -> int:
        return len(self.items[self._which(number)])

    def longest_first(self) -> list[int]:
        return list(range(self.blocks))

    @staticmethod
    def environment() -> dict[str, str]:
        """The code and the versions here, on which the results depend."""
        return environment("**/*.py")

    def fingerprint(self) -> dict[str, Any]:
        return {
            "environment": self.environment(),
            "items": [thing_hash(item) for item in self.items],
            "motions": [motion_hash(motion) for motion in self.motions],
            "scale": self.scale,
            "tilt": self.tilt,
            "model": repr(self.model),
            "pairs": self.in_pairs,
            "blocks": self.items_per_block,
        }

    def parts_of(self, number: int, made: Mapping[str, Any]) -> dict[str, Any]:
        return {"items": made["items"][self._which(number)], "block": number}

    def told(self) -> dict[str, Any]:
        return {
            "items": [to_json(item) for item in self.items],
            "scale": self.scale,
            "tilt": self.tilt,
            "model": to_json(self.model),
            "pairs": self.in_pairs,
            "inventory": self.inventory,
            "inventory_sha256": self.inventory_sha256,
            "motions_told": self.motions_told,
            "items_per_block": self.items_per_block,
        }

    @classmethod
    def load(cls, told: Mapping[str, Any], motions: StoredMotions, check: bool) -> Assessments:
        """Rebuild the work from what `told` said and the stored motions.

        Raises:
            KeyError, TypeError, ValueError, AttributeError: something of it is damaged.
        """
        items = [from_json(one) for one in told["items"]]
        if check and [thing_hash(item) for item in items] != told["fingerprint"]["items"]:
            raise ValueError("its items are not those that it was begun with")
        return cls(
            items=items,
            motions=motions,
            scale=told["scale"],
            tilt=told["tilt"],
            model=from_json(told["model"]),
            inventory=told["inventory"],
            inventory_sha256=told["inventory_sha256"],
            motions_told=told["motions_told"],
            in_pairs=told["pairs"],
            items_per_block=told["items_per_block"],
        )

    def create(self, objects: Objects) -> None:
        """Nothing must be there before."""

    def is_there(self, objects: Objects) -> bool:
        return True

    def opened(self, objects: Objects) -> None:
        """Read all motions, once for all threads of a process."""
        _ = self.shaking

    def assessed(self, items: Sequence[Item]) -> Assessment:
        """The assessment of some of the items."""
        return assess(
            items,
            self.shaking,
            scale=self.scale,
            tilt=self.tilt,
            model=self.model,
            planar=not self.in_pairs,
            leading=0,  # which objects come first is known when all are done
            progress=False,
        )

    def do(self, number: int, progress: Progress) -> BlockResult:
        """Assess the items of a block.

        Raises:
            InputError: what `assess` says.
        """
        found = self.assessed(self.items[self._which(number)]).results
        if callable(progress):
            progress(len(found))
        return BlockResult([to_json(one) for one in found], len(found), {})

    def write(self, number: int, values: Any, kept: None, objects: Objects) -> dict[str, list[int]]:
        content = zlib.compress(json.dumps(values).encode())
        objects.put(_name(number), content)
        return {_name(number): [len(content), zlib.crc32(content)]}

    def warn(self, notes: Iterable[Mapping[str, Any]]) -> None:
        """Warnings are in the results of each object."""

    def sample(self) -> tuple[int, float]:
        """Items spread evenly over all of them are assessed."""
        some = [self.items[k] for k in spread(len(self.items), SAMPLE)]
        self.assessed(some[:1])  # compiles
        start = time.perf_counter()
        self.assessed(some)
        return len(some), time.perf_counter() - start


def read_assessment(work: Assessments, objects: Objects) -> Assessment:
    """The assessment of all items.

    Raises:
        InputError: it is not done.
        SimulationError: something is damaged.
    """
    whole_notes(work, objects)
    results = []
    for number in range(work.blocks):
        content = objects.get(_name(number))
        if content is None:
            raise SimulationError(f"{objects.place}: {_name(number)} is gone")
        before = number * work.items_per_block
        found = [from_json(one) for one in json.loads(zlib.decompress(content))]
        results += [
            replace(one, number=before + one.number, kick=kick_among(one.item, work.items))
            for one in found
        ]
    # assess one item for what all items share: motions, recordings, peaks
    first = work.assessed(work.items[:1])
    floor = replace(first.floors[0], results=results)
    return replace(first, floors=[floor], walls=walls_of(None, work.items))


def _name(number: int) -> str:
    return f"{RESULTS}/items/{number:08d}.json.z"
