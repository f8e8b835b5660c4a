"""The simulations of a library of fragility functions, a case in each block."""

from __future__ import annotations

import time
import zlib
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from importlib.metadata import version
from typing import Any, ClassVar

from shaketable.campaign.as_json import KINDS, from_json, to_json
from shaketable.campaign.fingerprint import DECIDING, environment, hash_of, motion_hash
from shaketable.campaign.motions import StoredMotions
from shaketable.campaign.notes import whole_notes
from shaketable.campaign.objects import Objects
from shaketable.campaign.simulations import spread
from shaketable.campaign.work import RESULTS, BlockResult
from shaketable.engine.pool import available_cores
from shaketable.errors import SimulationError
from shaketable.fragility.limit_states import LimitState
from shaketable.lazy_motions import heads_of
from shaketable.library.case import Case, Held, Stand
from shaketable.library.fitted import LibraryFunction, Shaking, functions_of_case
from shaketable.library.library import Library
from shaketable.library.shaken import MOST_SCALES, CaseRuns, motions_under, simulated
from shaketable.library.thing import LibraryThing, Size
from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.simulate.kinds import CPU
from shaketable.synthesis import ShearBuilding

RUN = 40  # bytes of a simulation before compression, about
SAMPLE = 6  # cases
SAMPLED_MOTIONS = 8  # of each

#: Everything that the store of a library keeps as JSON.
LIBRARY_KINDS: dict[str, type] = KINDS | {
    kind.__name__: kind
    for kind in (Case, Held, Library, LimitState, LibraryThing, ShearBuilding, Size, Stand)
}
#: Sources that decide what a case's simulations give.
CASES = (
    "library/thing.py", "library/case.py", "library/draws.py", "library/shaken.py",
    "library/reach.py", "synthesis/floors.py", "oscillators/*.py", "fragility/cloud.py",
    "inventory/catalogue/__init__.py",
    "inventory/catalogue/things.csv",
)  # fmt: skip


@dataclass(frozen=True, kw_only=True, eq=False)
class Libraries:
    """A `Work` that simulates the cases of a library.

    Attributes:
        library: what is wanted.
        motions: of the ground, with both components.
    """

    library: Library
    motions: Sequence[Motion]

    kind: ClassVar[str] = "library"
    counted: ClassVar[str] = "simulations"
    chunks: ClassVar[int] = 1
    device: ClassVar[str] = CPU

    @cached_property
    def ground(self) -> list[Motion]:
        """The motions in memory: each block needs all of them."""
        return list(self.motions)

    @property
    def cases(self) -> Sequence[Case]:
        return self.library.cases

    @property
    def blocks(self) -> int:
        return len(self.cases)

    @property
    def size(self) -> int:
        return RUN * self.total

    @property
    def named(self) -> Mapping[str, Sequence[Any]]:
        return {"cases": self.cases, "motions": heads_of(self.motions)}

    @property
    def total(self) -> int:
        return sum(self.count(k) for k in range(self.blocks))

    def count(self, number: int) -> int:
        """At most: where few scales tell, there are fewer."""
        return self.cases[number].held.draws * len(self.motions) * MOST_SCALES

    def longest_first(self) -> list[int]:
        straps = [case.held.strength is not None for case in self.cases]
        return sorted(range(self.blocks), key=lambda k: not straps[k])

    @staticmethod
    def environment() -> dict[str, str]:
        """The code and the versions here, on which the results depend."""
        return environment(*DECIDING, *CASES) | {"scipy": version("scipy")}

    def fingerprint(self) -> dict[str, Any]:
        return {
            "environment": self.environment(),
            "cases": [hash_of(repr(case).encode()) for case in self.cases],
            "motions": [motion_hash(motion) for motion in self.motions],
            "seed": self.library.seed,
        }

    def parts_of(self, number: int, made: Mapping[str, Any]) -> dict[str, Any]:
        return {"cases": made["cases"][number]}

    def told(self) -> dict[str, Any]:
        return {"library": to_json(self.library)}

    @classmethod
    def load(cls, told: Mapping[str, Any], motions: StoredMotions, check: bool) -> Libraries:
        """Rebuild the work from what `told` said and the stored motions.

        Raises:
            KeyError, TypeError, ValueError, AttributeError: something of it is damaged.
        """
        library = from_json(told["library"], LIBRARY_KINDS)
        hashes = [hash_of(repr(case).encode()) for case in library.cases]
        if check and hashes != told["fingerprint"]["cases"]:
            raise ValueError("its cases are not those that it was begun with")
        return cls(library=library, motions=motions)

    def create(self, objects: Objects) -> None:
        """Nothing must be there before."""

    def is_there(self, objects: Objects) -> bool:
        return True

    def opened(self, objects: Objects) -> None:
        """Read all motions, once for all threads of a process."""
        _ = self.ground

    def do(self, number: int, progress: Progress) -> BlockResult:
        """Simulate a case.

        Raises:
            InputError: a thing that falls by itself on its tilt.
        """
        case = self.cases[number]
        found = simulated(case, motions_under(case, self.ground), seed=self.library.seed)
        if callable(progress):
            progress(self.count(number))
        moving = int(found.moving.sum())
        notes = {"simulations": found.fell.size, "moving": moving}
        return BlockResult(found.as_bytes(), self.count(number), notes)

    def write(self, number: int, values: Any, kept: None, objects: Objects) -> dict[str, list[int]]:
        objects.put(_name(number), values)
        return {_name(number): [len(values), zlib.crc32(values)]}

    def warn(self, notes: Iterable[Mapping[str, Any]]) -> None:
        """Runs that were given up are told with each function."""

    def sample(self) -> tuple[int, float]:
        """Cases spread evenly over all of them are simulated under some of the motions."""
        some = [self.cases[k] for k in spread(self.blocks, SAMPLE)]
        few = [self.ground[k] for k in spread(len(self.ground), SAMPLED_MOTIONS)]
        simulated(some[0], motions_under(some[0], few[:1]), scales=[0.5])  # compiles
        start, count = time.perf_counter(), 0
        for case in some:
            simulated(case, motions_under(case, few), seed=self.library.seed)
            count += case.held.draws * len(few) * MOST_SCALES
        return count, time.perf_counter() - start


def runs_of(work: Libraries, objects: Objects) -> list[CaseRuns]:
    """The simulations of each case.

    Raises:
        InputError: it is not done.
        SimulationError: something is damaged.
    """
    whole_notes(work, objects)
    found = []
    for number in range(work.blocks):
        content = objects.get(_name(number))
        if content is None:
            raise SimulationError(f"{objects.place}: {_name(number)} is gone")
        found.append(CaseRuns.from_bytes(content))
    return found


def functions_of(
    work: Libraries, objects: Objects, *, progress: Progress = True, threads: int | None = None
) -> list[LibraryFunction]:
    """The functions of all cases, in their order.

    Raises:
        InputError: it is not done.
        SimulationError: something is damaged.
    """
    shaking, library = Shaking(work.ground), work.library

    def fitted(pair: tuple[Case, CaseRuns]) -> list[LibraryFunction]:
        return functions_of_case(
            *pair, shaking, states=library.states, measures=library.measures, seed=library.seed
        )

    pairs = list(zip(work.cases, runs_of(work, objects), strict=True))
    found: list[LibraryFunction] = []
    with (
        ThreadPoolExecutor(threads or available_cores()) as pool,
        meter("cases", len(pairs), progress) as done,
    ):
        for some in pool.map(fitted, pairs):
            found += some
            done(1)
    return found


def _name(number: int) -> str:
    return f"{RESULTS}/cases/{number:08d}.npz"
