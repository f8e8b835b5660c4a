"""Hashes of all that the results of a campaign depend on.

Blocks with different hashes are never combined.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from shaketable.body import Body
from shaketable.campaign.as_json import to_json
from shaketable.errors import named
from shaketable.inventory import Item
from shaketable.motion import Motion
from shaketable.solid import Solid
from shaketable.surroundings import Surroundings

if TYPE_CHECKING:
    from shaketable.rooms import Room

_PACKAGE = Path(__file__).resolve().parents[1]
#: Sources that decide what a simulation gives, and what a summary makes of it.
DECIDING = (
    "physics/*/*.py", "engine/*.py", "models/*.py", "simulate/*.py", "surroundings.py",
    "campaign/summary.py", "campaign/sketch.py", "body.py", "solid.py", "footprint.py",
    "motion.py", "lazy_motions.py", "motion_file.py", "support.py", "outcome.py",
    "units.py", "compiled/*.py", "resampling.py", "origin.py",
)  # fmt: skip
VERSIONS = ("numba", "llvmlite", "numpy")
DIGITS = 16
MOST_NAMED = 3

Fingerprint = Mapping[str, Any]


@cache
def source_hash(*patterns: str) -> str:
    """Hash of the sources that match."""
    digest = hashlib.sha256()
    for path in sorted({path for pattern in patterns for path in _PACKAGE.glob(pattern)}):
        digest.update(f"\0{path.relative_to(_PACKAGE).as_posix()}\0".encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:DIGITS]


@cache
def environment(*patterns: str) -> dict[str, str]:
    """The code, of sources that match, and the versions that are installed here."""
    return {
        "shaketable's code": source_hash(*(patterns or DECIDING)),
        **{name: version(name) for name in VERSIONS},
    }


def thing_hash(thing: Body | Solid | Item | Room, around: Surroundings | None = None) -> str:
    """Of its numbers, its name, and what holds it."""
    told = [thing, around] if around else thing
    return hash_of(json.dumps(to_json(told), sort_keys=True).encode())


def motion_hash(motion: Motion) -> str:
    """Of its samples, its time step, its name and where it comes from."""
    told = [
        motion.name,
        float(motion.time_step),
        motion.origin and (motion.origin.event, motion.origin.station),
    ]
    parts = [motion.horizontal.astype("<f8").tobytes(), repr(told).encode("utf-8", "surrogatepass")]
    if motion.vertical is not None:
        parts.append(motion.vertical.astype("<f8").tobytes())
    if motion.transverse is not None:
        parts += [b"transverse", motion.transverse.astype("<f8").tobytes()]
    return hash_of(*parts)


def key_of(made: Fingerprint, parts: Mapping[str, Any]) -> str:
    """Of a block: all that its results depend on, of the fingerprint's lists its own parts."""
    mine = {**{name: value for name, value in made.items() if name != "blocks"}, **parts}
    return hash_of(json.dumps(mine, sort_keys=True).encode())


def differences(
    begun: Fingerprint, now: Fingerprint, lists: Mapping[str, Sequence[Any]]
) -> list[str]:
    """What of a store's campaign differs from the one that is asked for, in words.

    Args:
        begun, now: fingerprints of both.
        lists: what each hash of those entries that are lists of them is of, now.
    """
    said = []
    for name, there in begun.items():
        here = now.get(name)
        if there == here:
            continue
        if name == "environment":
            said += [
                f"{part}: {there.get(part, 'none')} → {here and here.get(part, 'none')}"
                for part in sorted({*there, *(here or {})})
                if there.get(part) != (here or {}).get(part)
            ]
        elif name in lists:
            said.append(_which(name, there, here or [], lists[name]))
        elif name == "blocks":
            if all(begun.get(each) == now[each] for each in lists):
                said.append("blocks: cut otherwise")
        else:
            said.append(f"{name}: {_short(there)} → {_short(here)}")
    return said


def _which(name: str, there: Sequence[str], here: Sequence[str], now: Sequence[Any]) -> str:
    if len(there) != len(here):
        return f"{name}: {len(there):,} → {len(here):,}"
    changed = [k for k, (a, b) in enumerate(zip(there, here, strict=True)) if a != b]
    who = named([now[k].name or f"number {k}" for k in changed], MOST_NAMED)
    return f"{name}: {len(changed):,} of {len(here):,} differ ({who})"


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 80 else f"{text[:77]}..."


def hash_of(*parts: bytes) -> str:
    """Of some parts, each by itself."""
    digest = hashlib.sha256()
    for part in parts:
        digest.update(len(part).to_bytes(8, "little"))
        digest.update(part)
    return digest.hexdigest()[: 2 * DIGITS]
