"""Who begins a campaign holds few of its motions at a time, however many there are."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from shaketable import Body, InputError, Motion, simulate_many
from shaketable.campaign import open_campaign, run_campaign
from shaketable.campaign.description import read_campaign
from shaketable.campaign.motions import AT_ONCE
from shaketable.campaign.run import run
from shaketable.campaign.simulations import Simulations
from shaketable.origin import Origin
from shaketable.records.folders import AT_HAND

COUNT = 600
BLOCK = 20  # motions of a block
#: Those of the file that is written, and of two blocks (one simulated, one being written).
MOST = AT_ONCE + 2 * BLOCK


class Alive:
    """The largest number of motions that were in memory at once."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now: weakref.WeakSet[Any] = weakref.WeakSet()
        self.most = 0
        check = Motion.__post_init__

        def counted(motion: Motion) -> None:
            check(motion)
            self.now.add(_Hashed(motion))
            self.most = max(self.most, len(self.now))

        monkeypatch.setattr(Motion, "__post_init__", counted)


class _Hashed:
    """Lives as long as a motion."""

    def __init__(self, motion: Motion) -> None:
        object.__setattr__(motion, "_held", self)


def some(count: int = COUNT) -> Iterator[Motion]:
    """Motions of forty events in no order."""
    rng = np.random.default_rng(1)
    for k in range(count):
        yield Motion(
            2.0 * rng.normal(size=50), 0.02, name=f"motion {k}",
            origin=Origin(event=f"event {k * 7 % 40}", station=f"station {k}"),
        )  # fmt: skip


BODIES = [Body.rectangle(0.1 + 0.02 * k, 1.0, name=f"body {k}") for k in range(3)]


@pytest.mark.parametrize("keep", ["all", "summary"])
def test_a_generator_is_never_held_as_a_whole(
    keep: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    given: dict[str, Any] = {"keep": keep, "block": BLOCK * 6, "progress": False}
    listed = run_campaign(BODIES, list(some()), store=tmp_path / "a", **given).load()
    alive = Alive(monkeypatch)
    found = run_campaign(BODIES, some(), store=tmp_path / "b", **given).load()
    assert 0 < alive.most <= MOST
    xr.testing.assert_identical(found, listed)
    if keep == "all":
        known = simulate_many(BODIES, list(some()), progress=False)
        xr.testing.assert_identical(found, known)
    # the same command goes on, by the same motions
    alive.most = 0
    run_campaign(BODIES, some(), store=tmp_path / "b", **given)
    assert 0 < alive.most <= MOST + AT_ONCE * 4  # what the store holds is read as well
    louder = (replace(m, time_step=0.03) if m.name == "motion 3" else m for m in some())
    with pytest.raises(InputError, match=r"motions: 1 of 600 differ \(motion 3\)"):
        run_campaign(BODIES, louder, store=tmp_path / "b", **given)


def test_what_is_not_a_motion_and_none(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"motions= is empty"):
        run_campaign(BODIES, iter([]), store=tmp_path / "a")
    with pytest.raises(InputError, match=r"motions\[1\] must be a Motion; got int"):
        run_campaign(BODIES, iter([next(some()), 7]), store=tmp_path / "a")
    assert not (tmp_path / "a").exists()


def test_a_folder_of_records_is_never_held_as_a_whole(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Read for the first time, and from the cache of folders."""
    monkeypatch.setattr("shaketable.records.cached.user_cache_path", lambda _: tmp_path / "cache")
    records = tmp_path / "records"
    records.mkdir()
    count = 3 * AT_HAND
    for motion in some(count):
        rows = "\n".join(f"{x:.6f}" for x in motion.horizontal)
        name = f"RSN{int(motion.name.split()[1]):04d}.AT2"
        (records / name).write_text(f"UNITS OF M/S/S\nNPTS= 50, DT= .02 SEC\n{rows}\n")
    path = tmp_path / "campaign.toml"
    path.write_text(
        "[bodies.grid]\nbase_m = 0.2\nheight_m = 1.0\n"
        f'[motions]\nof = "records"\n[plan]\nblock = {2 * BLOCK}\n'
    )
    gc.collect()
    alive = Alive(monkeypatch)
    works: list[Simulations] = []
    for _ in range(2):
        work = read_campaign(path)
        assert isinstance(work, Simulations)
        works.append(work)
        assert 0 < alive.most <= 4
        assert len(works[-1].motions) == count
    run(works[0], tmp_path / "store", progress=False)
    assert 0 < alive.most <= MOST
    run(works[1], tmp_path / "store", progress=False)  # nothing is left to do
    found = open_campaign(tmp_path / "store")
    assert found["motion"].values[7] == "RSN0007"
    assert dict(found.sizes)["motion"] == count
