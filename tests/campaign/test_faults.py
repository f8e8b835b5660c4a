"""Campaigns that are killed, cut off or run twice: afterwards nothing is lost or counted twice."""

from __future__ import annotations

import json
import os
import platform
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from shaketable import InputError, Motion, SimulationError, simulate_many
from shaketable.campaign import blocks, cluster, run_campaign
from shaketable.campaign.blocks import do_block
from shaketable.campaign.lock import LOCK, locked
from shaketable.campaign.objects import Objects

DRIVER = """
import sys
import numpy as np
from shaketable import suite
from shaketable.campaign import run_campaign
from tests.campaign.conftest import BODIES, TILTS
run_campaign(BODIES, suite("fema-p695")[:12], tilts=TILTS, block=2,
             store=sys.argv[1], progress=False)
"""


@pytest.mark.slow
def test_a_killed_driver_is_gone_on_from(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path
) -> None:
    store = tmp_path / "store"
    process = subprocess.Popen([sys.executable, "-c", DRIVER, str(store)])
    done = store / "campaign" / "done"
    until = time.monotonic() + 60.0
    while time.monotonic() < until and not (done.is_dir() and len(list(done.iterdir())) > 3):
        time.sleep(0.002)
    process.kill()
    process.wait()
    before = {path.name: path.stat().st_mtime_ns for path in done.glob("0*.json")}
    assert 3 <= len(before) < 60
    found = run_campaign(**(small | {"block": 2}), store=store)
    after = {path.name: path.stat().st_mtime_ns for path in done.glob("0*.json")}
    assert len(after) == 60
    assert all(after[name] == when for name, when in before.items())  # not done again
    xr.testing.assert_identical(found.load(), known)


@pytest.fixture
def tiny_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system of 3 MiB: some hundred small files."""
    place = tmp_path / "disk"
    place.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=3m", "tmpfs", str(place)]
    if platform.system() != "Linux" or subprocess.run(mount, capture_output=True).returncode:
        pytest.skip("a small file system can be mounted by root on Linux only")
    yield place
    subprocess.run(["umount", "-l", str(place)], check=True)


def test_a_full_disk_that_is_freed(
    small: dict[str, Any], known: xr.Dataset, tiny_disk: Path
) -> None:
    """What was written before the disk was full is kept; the error names no line of Python."""
    ballast = tiny_disk / "campaign"
    store = tiny_disk / "store"
    given = small | {"motions": [_short(m) for m in small["motions"]], "block": 2}
    ballast.write_bytes(bytes(2 * 1024**2 + 512 * 1024))
    with pytest.raises(SimulationError, match=r"No space.* the same command goes on"):
        run_campaign(**given, store=store)
    ballast.unlink()
    found = run_campaign(**given, store=store)
    wanted = {name: value for name, value in given.items() if name != "block"}
    xr.testing.assert_identical(found.load(), simulate_many(**wanted))


def _short(motion: Motion) -> Motion:
    """The strongest half second."""
    at = int(np.abs(motion.horizontal).argmax())
    return replace(motion, horizontal=motion.horizontal[max(0, at - 25) : at + 25])


def test_two_drivers_on_one_store(small: dict[str, Any], tmp_path: Path) -> None:
    with locked(Objects(tmp_path)):
        said = rf"is being written by process {os.getpid()} on .*, which was heard \d s ago"
        with pytest.raises(InputError, match=said):
            run_campaign(**small, store=tmp_path)
    run_campaign(**small, store=tmp_path)  # the lock is given back
    assert not (tmp_path / LOCK).exists()


@pytest.mark.parametrize(
    ("holder", "passes"),
    [
        ({"host": "elsewhere", "process": 1, "heartbeat": 0.0}, True),
        ({"host": "elsewhere", "process": 1, "heartbeat": 2e12}, False),
        ({"host": platform.node(), "process": 2**22 + 1, "heartbeat": 2e12}, True),  # ended
    ],
)
def test_a_lock_that_was_left(
    small: dict[str, Any], tmp_path: Path, holder: dict[str, Any], passes: bool,
    caplog: pytest.LogCaptureFixture,
) -> None:  # fmt: skip
    (tmp_path / "campaign").mkdir()
    (tmp_path / LOCK).write_text(json.dumps(holder))
    if not passes:
        with pytest.raises(InputError, match="by process 1 on elsewhere"):
            run_campaign(**small, store=tmp_path)
        return
    run_campaign(**small, store=tmp_path)
    assert "held the lock and was not heard" in caplog.text


@pytest.fixture(scope="module")
def client() -> Iterator[Any]:
    pytest.importorskip("distributed", reason="the extra cluster is not installed")
    from shaketable.campaign.cluster import local

    with local(2) as client:
        yield client


@pytest.mark.filterwarnings("default")
def test_a_cluster_gives_the_same(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path, client: Any
) -> None:
    found = run_campaign(**small, store=tmp_path, client=client)
    xr.testing.assert_identical(found.load(), known)


@pytest.mark.filterwarnings("default")
def test_a_killed_worker_loses_nothing(
    small: dict[str, Any],
    known: xr.Dataset,
    tmp_path: Path,
    client: Any,
    caplog: pytest.LogCaptureFixture,
) -> None:
    done = tmp_path / "campaign" / "done"
    killed = []

    def kill() -> None:
        while not done.is_dir() or not list(done.iterdir()):
            time.sleep(0.001)
        pids = client.run(os.getpid)
        killed.append(next(iter(pids.values())))
        os.kill(killed[0], signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    found = run_campaign(**(small | {"block": 1}), store=tmp_path, client=client)
    killer.join()
    assert killed
    assert "a worker is gone; blocks that it had at hand: " in caplog.text
    xr.testing.assert_identical(found.load(), known)


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize("faults", [2, 5])
def test_what_nobody_foresaw_is_tried_again(
    faults: int,
    small: dict[str, Any],
    known: xr.Dataset,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Three times; then the block fails with its reason, and the others are done."""
    distributed = pytest.importorskip("distributed", reason="the extra cluster is not installed")
    raised = tmp_path / "raised"  # the function goes to the worker as a copy
    raised.mkdir()

    def flaky(place: str, begun: str, number: int) -> tuple[int, str]:
        if number == 1 and len(list(raised.iterdir())) < faults:
            (raised / str(time.monotonic_ns())).touch()
            raise RuntimeError("cosmic ray")
        return do_block(place, begun, number)

    monkeypatch.setattr(blocks, "do_block", flaky)
    given = small | {"store": tmp_path / "store"}
    with distributed.Client(processes=False, n_workers=1, dashboard_address=":0") as client:
        if faults == 2:
            found = run_campaign(**given, client=client)
            xr.testing.assert_identical(found.load(), known)
        else:
            with pytest.raises(SimulationError, match=r"1 of .* RuntimeError: cosmic ray"):
                run_campaign(**given, client=client)
    assert len(list(raised.iterdir())) == min(faults, 1 + cluster.RETRIES)


@pytest.mark.filterwarnings("default")
def test_a_block_that_kills_its_workers_takes_no_other_with_it(
    small: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Dask blames all that a dead worker had at hand."""
    distributed = pytest.importorskip("distributed", reason="the extra cluster is not installed")
    import dask

    def deadly(place: str, begun: str, number: int) -> tuple[int, str]:
        if number == 1:
            os.kill(os.getpid(), signal.SIGKILL)
        return do_block(place, begun, number)

    monkeypatch.setattr(blocks, "do_block", deadly)
    given: dict[str, Any] = {"n_workers": 1, "threads_per_worker": 2, "dashboard_address": ":0"}
    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 0}),
        distributed.Client(**given) as client,
        pytest.raises(SimulationError, match=r"1 of 4 blocks failed.*KilledWorker"),
    ):
        run_campaign(**small, store=tmp_path, client=client)
    assert len(list((tmp_path / "campaign" / "done").iterdir())) == 3


@pytest.mark.filterwarnings("default")
@pytest.mark.slow
def test_a_scheduler_that_is_gone_ends_the_run(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path
) -> None:
    distributed = pytest.importorskip("distributed", reason="the extra cluster is not installed")
    file, store = tmp_path / "scheduler.json", tmp_path / "store"
    run = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--port", "0"]
    scheduler = subprocess.Popen(
        [*run, "--scheduler-file", str(file), "--dashboard-address", ":0"],
        stderr=subprocess.DEVNULL,
    )
    worker = subprocess.Popen(
        [sys.executable, "-m", "distributed.cli.dask_worker", "--scheduler-file", str(file),
         "--no-dashboard", "--nthreads", "1", "--death-timeout", "2"],
        stderr=subprocess.DEVNULL,
    )  # fmt: skip
    done = store / "campaign" / "done"

    def kill() -> None:
        while not done.is_dir() or not list(done.iterdir()):
            time.sleep(0.001)
        scheduler.kill()

    try:
        while not file.exists():
            time.sleep(0.05)
        threading.Thread(target=kill).start()
        with (
            distributed.Client(scheduler_file=str(file), set_as_default=False) as client,
            pytest.raises(SimulationError, match="the scheduler is gone; the same command goes on"),
        ):
            run_campaign(**(small | {"block": 1}), store=store, client=client)
    finally:
        for process in (scheduler, worker):
            process.kill()
            process.wait()
    found = run_campaign(**(small | {"block": 1}), store=store)
    xr.testing.assert_identical(found.load(), known)


@pytest.mark.filterwarnings("default")
def test_ctrl_c_on_a_cluster_stops_soon(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path, client: Any
) -> None:
    """Blocks that wait are not begun; those at work are kept."""
    done = tmp_path / "campaign" / "done"

    def interrupt() -> None:
        while not done.is_dir() or not list(done.iterdir()):
            time.sleep(0.001)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=interrupt).start()
    with pytest.raises(KeyboardInterrupt):
        run_campaign(**(small | {"block": 1}), store=tmp_path, client=client)
    # of 240 a few before the signal, and those of two threads and their queues at most
    assert len(list(done.iterdir())) < 60
    found = run_campaign(**(small | {"block": 1}), store=tmp_path, client=client)
    xr.testing.assert_identical(found.load(), known)


@pytest.mark.filterwarnings("default")
def test_a_worker_with_other_versions_is_refused(
    small: dict[str, Any], tmp_path: Path, client: Any
) -> None:
    """The plan's hash of versions is changed as if the driver had another NumPy."""
    from shaketable.campaign import fingerprint, simulations

    real = fingerprint.environment()
    changed = {**real, "numpy": "0.1"}
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(simulations, "environment", lambda: changed)
        with pytest.raises(Exception, match=r"has numpy \d.* in place of 0\.1"):
            run_campaign(**small, store=tmp_path, client=client)


def test_a_scheduler_that_does_not_answer(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed", reason="the extra cluster is not installed")
    from shaketable.campaign import cluster

    monkeypatch.setattr(cluster, "TIMEOUT", 0.2)
    with pytest.raises(InputError, match=r"--scheduler tcp://127.0.0.1:9: no answer within"):
        cluster.connect("tcp://127.0.0.1:9")
