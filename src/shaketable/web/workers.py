"""How a worker process begins."""

from __future__ import annotations

import logging
import os
import tempfile
import threading
from multiprocessing import parent_process
from multiprocessing.connection import wait
from pathlib import Path

from shaketable.web.limits import WORKER_MEMORY

READY = "ready"  # a file in a worker's folder
ROOM = """
outline_m = [[0, 0], [3, 0], [3, 3], [0, 3]]
[[door]]
at_m = [2, 0]
[[thing]]
name = "shelf"
at_m = [1, 0.2]
depth_m = 0.3
width_m = 0.9
height_m = 1.8
"""


def warm(scratch: str) -> None:
    """Prepare a worker: its limits, its folder, the suites and the compiled kernels."""
    threading.Thread(target=_end_with_server, daemon=True).start()
    own = Path(scratch) / str(os.getpid())
    own.mkdir(mode=0o700, exist_ok=True)
    tempfile.tempdir = str(own)
    told = logging.getLogger("shaketable")  # has the names of visitors' files: for reports alone
    told.addHandler(logging.NullHandler())
    told.propagate = False
    _compute()
    _limit_memory()  # what has been mapped by now is not counted
    (own / READY).touch()


def _compute() -> None:
    """Answer one question of each kind."""
    from shaketable.web import rooms, space, work
    from shaketable.web.questions import (
        Many,
        ManyInSpace,
        Pulse,
        Shake,
        ShakeInSpace,
        Thing,
        Upright,
    )
    from shaketable.web.room_answers import ShakeRoom

    pulse = Pulse(period_s=0.5, peak_g=0.3)
    for friction in (0.5, None):
        thing = Thing(base_m=0.3, height_m=1.8, friction=friction)
        work.shake(Shake(thing=thing, shaking=pulse))
        work.many(Many(thing=thing))
    for sizes in ({"depth_m": 0.3, "width_m": 0.3}, {"shape": "cylinder", "base_m": 0.3}):
        solid = Upright.model_validate({**sizes, "height_m": 1.8})
        space.shake(ShakeInSpace(thing=solid, shaking=pulse))
        space.many(ManyInSpace(thing=solid, scale=0.1, curve=False))
    rooms.shake(ShakeRoom(text=ROOM, shaking=pulse))


def _end_with_server() -> None:
    """A server that is killed leaves no worker that goes on computing."""
    if (server := parent_process()) is not None:
        wait([server.sentinel])
        os._exit(1)


def _limit_memory() -> None:
    """Let a worker take so much memory beside what it has mapped; on Linux."""
    mapped = Path("/proc/self/statm")
    if not mapped.exists():
        return
    import resource

    _, most = resource.getrlimit(resource.RLIMIT_AS)
    wanted = int(mapped.read_text().split()[0]) * resource.getpagesize() + WORKER_MEMORY
    if most == resource.RLIM_INFINITY or wanted < most:
        resource.setrlimit(resource.RLIMIT_AS, (wanted, most))
