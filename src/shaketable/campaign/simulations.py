"""The simulations of a plan, as a store keeps them: a block is a whole chunk of each array."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from shaketable.campaign import arrays, summary
from shaketable.campaign.as_json import from_json, to_json
from shaketable.campaign.fingerprint import environment, motion_hash, thing_hash
from shaketable.campaign.motions import StoredMotions
from shaketable.campaign.objects import Objects
from shaketable.campaign.plan import ALL, Plan
from shaketable.campaign.work import BlockResult
from shaketable.motion import Motion
from shaketable.progress import Progress
from shaketable.simulate.ensemble import Ensemble
from shaketable.simulate.kinds import are_solids

PROBE = (24, 16)  # bodies and motions
PROBE_OF_SOLIDS = (4, 8)


@dataclass(frozen=True, eq=False)
class Simulations:
    """A `Work` that runs the simulations of a plan."""

    plan: Plan

    kind: ClassVar[str] = "simulations"
    counted: ClassVar[str] = "simulations"

    @property
    def motions(self) -> Sequence[Motion]:
        return self.plan.ensemble.motions

    @property
    def blocks(self) -> int:
        return int(np.prod(self.plan.grid))

    @property
    def chunks(self) -> int:
        return len(arrays.layouts(self.plan))

    @property
    def size(self) -> int:
        return sum(
            int(np.prod(layout.shape, dtype=object)) * layout.dtype.itemsize
            for layout in arrays.layouts(self.plan).values()
        )

    @property
    def device(self) -> str:
        return self.plan.device

    @property
    def named(self) -> Mapping[str, Sequence[Any]]:
        return {"bodies": self.plan.ensemble.bodies, "motions": self.motions}

    @property
    def total(self) -> int:
        return self.plan.simulations

    def count(self, number: int) -> int:
        _, first_body, end_body, first_motion, end_motion = self.plan.block(number)
        pairs = (end_body - first_body) * (end_motion - first_motion)
        return pairs * self.total // (len(self.plan.ensemble.bodies) * len(self.motions))

    def longest_first(self) -> list[int]:
        return self.plan.strongest_first()

    @staticmethod
    def environment() -> dict[str, str]:
        """The code and the versions here, on which the results depend."""
        return environment()

    def fingerprint(self) -> dict[str, Any]:
        plan, ensemble = self.plan, self.plan.ensemble
        return {
            "environment": self.environment(),
            "bodies": _hashes(ensemble),
            "motions": [motion_hash(motion) for motion in ensemble.motions],
            "tilts": ensemble.tilts.tolist(),
            "scales": ensemble.scales.tolist(),
            "polarities": ensemble.polarities.tolist(),
            "azimuth": ensemble.azimuth,
            "orientations": ensemble.orientations.tolist(),
            "model": repr(ensemble.model),
            "device": plan.device,
            "keep": plan.keep,
            "recordings": plan.recordings,
            "blocks": [plan.bodies_per_block, list(map(list, plan.motion_parts))],
        }

    def parts_of(self, number: int, made: Mapping[str, Any]) -> dict[str, Any]:
        block = self.plan.block(number)
        return {
            "bodies": made["bodies"][block.first_body : block.end_body],
            "motions": made["motions"][block.first_motion : block.end_motion],
            "block": list(block),
        }

    def told(self) -> dict[str, Any]:
        plan, ensemble = self.plan, self.plan.ensemble
        return {
            "bodies": [to_json(body) for body in ensemble.bodies],
            "surroundings": [to_json(each) for each in ensemble.surroundings],
            "azimuth": ensemble.azimuth,
            "orientations": ensemble.orientations.tolist(),
            "model": to_json(ensemble.model),
            "tilts": ensemble.tilts.tolist(),
            "scales": ensemble.scales.tolist(),
            "polarities": ensemble.polarities.tolist(),
            "keep": plan.keep,
            "recordings": plan.recordings,
            "device": plan.device,
            "bodies_per_block": plan.bodies_per_block,
            "motion_parts": [list(part) for part in plan.motion_parts],
        }

    @classmethod
    def load(cls, told: Mapping[str, Any], motions: StoredMotions, check: bool) -> Simulations:
        """Rebuild the work from what `told` said and the stored motions.

        Raises:
            KeyError, TypeError, ValueError, AttributeError: something of it is damaged.
        """
        ensemble = Ensemble(
            bodies=[from_json(each) for each in told["bodies"]],
            motions=motions,
            surroundings=[from_json(each) for each in told["surroundings"]],
            model=from_json(told["model"]),
            azimuth=told["azimuth"],
            tilts=np.array(told["tilts"]),
            scales=np.array(told["scales"]),
            polarities=np.array(told["polarities"]),
            orientations=np.array(told["orientations"]),
        )
        hashes = told["fingerprint"]["bodies"]
        if check and _hashes(ensemble) != hashes:
            raise ValueError("its bodies are not those that it was begun with")
        plan = Plan(
            ensemble=ensemble,
            keep=told["keep"],
            recordings=told["recordings"],
            device=told["device"],
            bodies_per_block=told["bodies_per_block"],
            motion_parts=tuple((first, end) for first, end in told["motion_parts"]),
        )
        return cls(plan)

    def create(self, objects: Objects) -> None:
        arrays.create(self.plan, objects)

    def is_there(self, objects: Objects) -> bool:
        return arrays.is_there(self.plan, objects)

    def opened(self, objects: Objects) -> dict[str, Any]:
        return arrays.opened(self.plan, objects)

    def do(self, number: int, progress: Progress) -> BlockResult:
        """Simulate a block.

        Raises:
            InputError: a body that falls by itself on one of the tilts.
        """
        plan, block = self.plan, self.plan.block(number)
        ensemble = plan.ensemble_of(block)
        ensemble.require_standing()
        if plan.keep == ALL:
            results = ensemble.results()
            endings = ensemble.run(results.store, None, progress, plan.device)
            values = arrays.values_of_all(results, ensemble, self.plan)
        else:
            which = slice(block.first_motion, block.end_motion)
            tally = summary.SummaryTally(
                ensemble, plan.sources.recording[which], plan.sources.event[which]
            )
            endings = ensemble.run(tally.store, None, progress, plan.device)
            values = arrays.values_of_summary(tally.summary, plan)
        told = {str(int(code)): count for code, count in endings.items()}
        return BlockResult(values, sum(endings.values()), {"endings": told})

    def write(self, number: int, values: Any, kept: Any, objects: Objects) -> dict[str, list[int]]:
        return arrays.write(values, self.plan, self.plan.block(number), kept, objects)

    def warn(self, notes: Iterable[Mapping[str, Any]]) -> None:
        endings: Counter[int] = Counter()
        for note in notes:
            endings.update({int(code): n for code, n in note.get("endings", {}).items()})
        self.plan.ensemble.warn_of(endings)

    def sample(self) -> tuple[int, float]:
        """Bodies and motions spread evenly over all of them are simulated."""
        ensemble = self.plan.ensemble
        probe = PROBE_OF_SOLIDS if are_solids(ensemble.bodies) else PROBE
        some = ensemble.some(
            spread(len(ensemble.bodies), probe[0]), spread(len(ensemble.motions), probe[1])
        )
        some.some([0], [0]).run(lambda part: None, None, False)  # compiles
        start = time.perf_counter()
        some.run(lambda part: None, None, False)
        return int(np.prod(some.shape)), time.perf_counter() - start


def _hashes(ensemble: Ensemble) -> list[str]:
    """Of each body and of what holds it."""
    return [thing_hash(body, ensemble.around(k)) for k, body in enumerate(ensemble.bodies)]


def spread(count: int, most: int) -> list[int]:
    """At most `most` evenly spaced indices below `count`."""
    return [int(k) for k in np.unique(np.linspace(0, count - 1, most).astype(int))]
