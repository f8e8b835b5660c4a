"""Motions in a file: the same as in memory, and read one by one."""

from __future__ import annotations

import errno
import io
import tempfile
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from shaketable import InputError, Motion, SimulationError
from shaketable.lazy_motions import SERIES, Head, heads_of, in_order
from shaketable.motion_file import MotionFile, in_temporary_file
from shaketable.origin import Origin
from shaketable.records.pairs import each_paired, paired


def three() -> list[Motion]:
    """With one, two and three components."""
    rng = np.random.default_rng(0)
    a, b, c = rng.normal(size=(3, 40))
    origin = Origin(event="e", station="s", azimuth=90.0, processing=("filtered",))
    return [
        Motion(a, 0.01, name="one", origin=origin),
        Motion(b, 0.02, transverse=c, name="two", transverse_origin=origin),
        Motion(c[:7], 0.005, vertical=a[:7], transverse=b[:7], vertical_origin=origin),
    ]


def told(motion: Motion) -> list[object]:
    series = [getattr(motion, name) for name in SERIES]
    return [*Head.of(motion), *(None if each is None else each.tolist() for each in series)]


@pytest.mark.parametrize("in_memory", [2**24, 1])
def test_what_was_written_is_read(in_memory: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shaketable.motion_file.IN_MEMORY", in_memory)
    motions = three()
    kept = in_temporary_file(iter(motions))
    assert [told(motion) for motion in kept] == [told(motion) for motion in motions]
    assert told(kept[-1]) == told(motions[2])
    assert [motion.name for motion in kept[:2]] == ["one", "two"]
    assert list(map(told, in_order(kept, [2, 0]))) == [told(motions[2]), told(motions[0])]
    with pytest.raises(IndexError):
        kept[3]
    with ThreadPoolExecutor(8) as threads:
        found = list(threads.map(lambda k: told(kept[k % 3]), range(300)))
    assert found == [told(motions[k % 3]) for k in range(300)]


def test_what_is_known_survives_json() -> None:
    for head in heads_of(three()):
        assert Head.from_dict(head.as_dict()) == head


def test_pairs_are_joined_one_by_one(p695: list[Motion]) -> None:
    kept = in_temporary_file(p695[:6])
    assert list(map(told, each_paired(kept))) == list(map(told, paired(p695[:6])))
    assert all(motion.transverse is not None for motion in each_paired(kept))


def test_faults_of_a_file(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(InputError, match=r"motions\[1\] must be a Motion; got str"):
        in_temporary_file([three()[0], "record.at2"])  # type: ignore[list-item]
    with pytest.raises(SimulationError, match="the file of motions ends before one"):
        MotionFile(io.BytesIO(bytes(8)), heads_of(three()))[0]

    class Full(io.BytesIO):
        def write(self, content: Any, /) -> int:
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(tempfile, "SpooledTemporaryFile", lambda size: Full())
    with pytest.raises(SimulationError, match=r"No space left on device after 0 motions.*TMPDIR"):
        in_temporary_file([replace(three()[0])])
