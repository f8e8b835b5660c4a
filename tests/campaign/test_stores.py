"""Stores that are odd, damaged or somebody else's: nothing is deleted, mixed or read wrong."""

from __future__ import annotations

import json
import os
import platform
import shutil
import subprocess
import sys
import time
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from shaketable import Body, InputError, Motion, SimulationError, simulate_many
from shaketable.campaign import open_campaign, run_campaign
from shaketable.campaign.blocks import BEGUN, do_block, site_of
from shaketable.campaign.kinds import work_of
from shaketable.campaign.lock import LOCK, locked
from shaketable.campaign.motions import StoredMotions
from shaketable.campaign.objects import Objects
from shaketable.campaign.simulations import Simulations
from shaketable.campaign.status import status_of


@pytest.mark.parametrize("part", ["results", "campaign"])
def test_folders_of_the_same_names_are_kept(
    small: dict[str, Any], tmp_path: Path, part: str
) -> None:
    (tmp_path / part).mkdir()
    (tmp_path / part / "thesis.csv").write_text("mine")
    with pytest.raises(InputError, match=rf"holds '{part}/thesis.csv', which is no part"):
        run_campaign(**small, store=tmp_path, fresh=True)
    assert (tmp_path / part / "thesis.csv").read_text() == "mine"


def test_a_lost_plan_deletes_no_blocks(small: dict[str, Any], tmp_path: Path) -> None:
    run_campaign(**small, store=tmp_path)
    plan = tmp_path / "campaign" / "plan.json"
    for content in (None, "", "{"):
        plan.unlink() if content is None else plan.write_text(content)
        with pytest.raises(InputError, match="blocks are done, but the plan is lost or damaged"):
            run_campaign(**small, store=tmp_path)
        assert list((tmp_path / "campaign" / "done").iterdir())
    run_campaign(**small, store=tmp_path, fresh=True)
    open_campaign(tmp_path).load()


def test_a_store_of_another_format_is_told(small: dict[str, Any], tmp_path: Path) -> None:
    run_campaign(**small, store=tmp_path)
    plan = tmp_path / "campaign" / "plan.json"
    plan.write_text(plan.read_text().replace('"format": 6', '"format": 1'))
    assert '"format": 1' in plan.read_text()
    with pytest.raises(SimulationError, match=r"its format is 1, this version reads 6"):
        open_campaign(tmp_path)


def test_a_store_of_another_format_is_not_gone_on_with(
    small: dict[str, Any], tmp_path: Path
) -> None:
    """Nor by a worker that sees one; hashes of another format would say what is wrong."""
    run_campaign(**small, store=tmp_path)
    plan = tmp_path / "campaign" / "plan.json"
    plan.write_text(plan.read_text().replace('"format": 6', '"format": 2').replace('"kind"', '"k"'))
    with pytest.raises(InputError, match=r"its format is 2, this version reads 6"):
        run_campaign(**small, store=tmp_path)
    with pytest.raises(SimulationError, match=r"its format is 2, this version reads 6"):
        site_of(str(tmp_path), "a beginning")


def test_how_far_it_is_is_told_without_reading_motions(
    small: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run_campaign(**small, store=tmp_path)
    monkeypatch.setattr(StoredMotions, "read", lambda self, k: pytest.fail("a motion was read"))
    told = status_of(Objects(tmp_path))
    work = work_of(Objects(tmp_path))
    assert told.count == told.count_done == sum(map(work.count, range(work.blocks))) == 240


def test_bodies_of_a_class_of_ones_own_are_opened(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path
) -> None:
    class Shelf(Body):
        """A body by another name."""

    bodies = [Shelf(**asdict(body)) for body in small["bodies"]]
    run_campaign(**small | {"bodies": bodies}, store=tmp_path)
    xr.testing.assert_identical(open_campaign(tmp_path).load(), known)


def test_motions_of_another_campaign_are_not_used(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    run_campaign(**small, store=tmp_path / "a")
    louder = [motion.scaled(2.0) for motion in small["motions"]]
    run_campaign(**(small | {"motions": louder}), store=tmp_path / "b")
    motions = "campaign/motions/000000.npz"
    for harm in ("other", "empty", "gone"):
        if harm == "other":
            shutil.copy(tmp_path / "b" / motions, tmp_path / "a" / motions)
        elif harm == "empty":
            (tmp_path / "a" / motions).write_bytes(b"")
        else:
            (tmp_path / "a" / motions).unlink()
        with pytest.raises(SimulationError, match=r"damaged|missing|holds other motions"):
            list(work_of(Objects(tmp_path / "a")).motions)
        found = run_campaign(**small, store=tmp_path / "a")  # written again
        xr.testing.assert_identical(found.load(), known)
    assert "written again" in caplog.text


@pytest.mark.parametrize("lost", ["results", "results/zarr.json", "results/outcome/zarr.json"])
def test_lost_arrays_are_made_again(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path, lost: str
) -> None:
    run_campaign(**small, store=tmp_path)
    place = tmp_path / lost
    shutil.rmtree(place) if place.is_dir() else place.unlink()
    with pytest.raises(SimulationError, match="run the campaign again"):
        open_campaign(tmp_path)
    found = run_campaign(**small, store=tmp_path)
    xr.testing.assert_identical(found.load(), known)


def test_notes_that_say_nothing_are_no_notes(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path
) -> None:
    run_campaign(**small, store=tmp_path)
    done = tmp_path / "campaign" / "done"
    first, second, third, *_ = sorted(done.iterdir())
    first.write_text("{}")
    second.write_text(second.read_text()[:-20])
    told = json.loads(third.read_text())
    third.write_text(json.dumps({**told, "key": "of another"}))
    (done / "desktop.ini").write_text("x")
    (tmp_path / "campaign" / "failed").mkdir()
    (tmp_path / "campaign" / "failed" / ".00000001.json.77").write_text("x")
    status = status_of(Objects(tmp_path))
    assert status.blocks_done == status.blocks - 2
    with pytest.raises(InputError, match="blocks are done"):
        open_campaign(tmp_path)
    found = run_campaign(**small, store=tmp_path)
    xr.testing.assert_identical(found.load(), known)


def test_a_late_worker_of_an_older_campaign_writes_nothing(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path
) -> None:
    """Its block is simulated before the store is begun anew, and would be written after it."""
    louder = small | {"scales": (3.0,)}
    run_campaign(**louder, store=tmp_path)
    token = json.loads((tmp_path / BEGUN).read_text())["token"]
    do = Simulations.do

    def slow(work: Simulations, number: int, progress: Any) -> Any:
        result = do(work, number, progress)
        if work.plan.ensemble.scales.tolist() == [3.0]:
            run_campaign(**small, store=tmp_path, fresh=True)
        return result

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Simulations, "do", slow)
        with pytest.raises(SimulationError, match="this block is of an older campaign"):
            do_block(str(tmp_path), token, 0)
    xr.testing.assert_identical(open_campaign(tmp_path).load(), known)


def test_a_lock_that_is_taken_away_ends_the_run(
    small: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from shaketable.campaign import lock

    monkeypatch.setattr(lock, "HEARTBEAT", 0.01)
    do = Simulations.do

    def taken(*given: Any) -> Any:
        (tmp_path / LOCK).write_text(json.dumps({"token": "another"}))
        import time

        time.sleep(0.2)
        return do(*given)

    monkeypatch.setattr(Simulations, "do", taken)
    with pytest.raises(SimulationError, match="another process took the lock"):
        run_campaign(**small, store=tmp_path)
    assert json.loads((tmp_path / LOCK).read_text()) == {"token": "another"}  # not removed


def test_only_one_of_many_gets_a_stale_lock(tmp_path: Path) -> None:
    """Threads stand for processes; each sees the stale lock at once."""
    from concurrent.futures import ThreadPoolExecutor
    from threading import Barrier

    for _ in range(20):
        (tmp_path / LOCK).parent.mkdir(exist_ok=True)
        stale = {"host": "elsewhere", "process": 1, "heartbeat": 0.0, "token": "old"}
        (tmp_path / LOCK).write_text(json.dumps(stale))
        barrier, inside = Barrier(4), []

        def enter(k: int, barrier: Barrier = barrier, inside: list[int] = inside) -> None:
            barrier.wait()
            try:
                with locked(Objects(tmp_path)):
                    inside.append(k)
                    try:
                        assert len(inside) == 1
                    finally:
                        barrier.wait()
            except InputError:
                barrier.wait()

        with ThreadPoolExecutor(4) as pool:
            for future in [pool.submit(enter, k) for k in range(4)]:
                future.result()
        assert len(inside) == 1


@pytest.mark.parametrize("name", ["a::b", "", " ", "/", "zip://x.zip::file://y"])
def test_names_that_are_no_store(small: dict[str, Any], name: str) -> None:
    with pytest.raises(InputError):
        run_campaign(**small, store=name)


def test_odd_names_are_plain_folders(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("memory:x", "file:z", "a[1]*?#%20", "~x"):
        found = run_campaign(**small, store=name)
        assert (tmp_path / name / "campaign" / "plan.json").exists()
        xr.testing.assert_identical(found.load(), known)


def test_numbers_of_numpy(p695: list[Motion], tmp_path: Path) -> None:
    """They are the same campaign as Python's numbers."""
    plain = Body.rectangle(0.25, 1.0)
    of_numpy = replace(plain, base=np.float64(0.25), left=np.float64(0.125))
    motion = replace(p695[0], time_step=np.float64(p695[0].time_step))
    run_campaign([of_numpy], [motion], store=tmp_path / "a", progress=False)
    found = run_campaign([plain], p695[:1], store=tmp_path / "a", progress=False)
    xr.testing.assert_identical(found.load(), simulate_many([plain], p695[:1], progress=False))
    single = Body.rectangle(np.float32(0.25), np.float32(1.0))
    run_campaign([single], p695[:1], store=tmp_path / "b", progress=False)
    with pytest.raises(InputError, match="block must be a positive whole number"):
        run_campaign([plain], p695[:1], store=tmp_path / "c", block=1e3, progress=False)  # type: ignore[arg-type]


def test_a_summary_is_whole_or_nothing(small: dict[str, Any], tmp_path: Path) -> None:
    run_campaign(**small, store=tmp_path, keep="summary")
    next((tmp_path / "campaign" / "done").iterdir()).unlink()
    with pytest.raises(InputError, match=r"blocks are done.*a summary is whole or nothing"):
        open_campaign(tmp_path, partial=True)


def test_a_killed_driver_is_told(small: dict[str, Any], tmp_path: Path) -> None:
    run_campaign(**small, store=tmp_path)
    ended = subprocess.Popen([sys.executable, "-c", ""])
    ended.wait()
    for process, gone in ((ended.pid, True), (os.getpid(), False)):
        holder = {"host": platform.node(), "process": process, "heartbeat": time.time()}
        (tmp_path / "campaign" / "lock.json").write_text(json.dumps(holder))
        assert status_of(Objects(tmp_path)).gone is gone


def test_partial_says_what_is_done_when_all_is(small: dict[str, Any], tmp_path: Path) -> None:
    run_campaign(**small, store=tmp_path)
    assert open_campaign(tmp_path, partial=True)["done"].all()


@pytest.mark.parametrize("package", ["zarr", "fsspec"])
def test_without_the_extra_it_is_told(
    small: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, package: str
) -> None:
    import sys

    monkeypatch.setitem(sys.modules, package, None)  # as if it were not installed
    said = rf"a campaign needs the package {package}: pip install 'shaketable\[campaign\]'"
    with pytest.raises(InputError, match=said):
        run_campaign(**small, store=tmp_path)


def test_without_dask_it_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    from shaketable.campaign import cluster

    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InputError, match=r"pip install 'shaketable\[cluster\]'"), cluster.local(2):
        pass


def test_without_a_gpu_nothing_is_begun(small: dict[str, Any], tmp_path: Path) -> None:
    from shaketable.engine import cuda

    try:
        cuda.require_gpu()
    except InputError:
        pass
    else:
        pytest.skip("a GPU is here")
    with pytest.raises(InputError, match="device='cuda'"):
        run_campaign(**small, store=tmp_path / "s", device="cuda")
    assert not (tmp_path / "s").exists()
