"""What becomes of the workers of a server that is killed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

#: A parent that has a child watch it while it computes, and says the child's number.
PARENT = """
import time
from multiprocessing import get_context
from threading import Thread

def compute():
    from shaketable.web.workers import _end_with_server
    Thread(target=_end_with_server, daemon=True).start()
    print("ready", flush=True)
    while True:
        sum(range(10_000))

if __name__ == "__main__":
    child = get_context("spawn").Process(target=compute)
    child.start()
    print(child.pid, flush=True)
    time.sleep(600.0)
"""


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="processes are looked at in /proc")
def test_a_worker_that_computes_ends_with_its_server(tmp_path: Path) -> None:
    script = tmp_path / "parent.py"
    script.write_text(PARENT)
    with subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE, text=True) as parent:
        assert parent.stdout is not None
        said = {parent.stdout.readline().strip(), parent.stdout.readline().strip()}
        assert "ready" in said
        (child,) = (int(word) for word in said - {"ready"})
        parent.kill()
        parent.wait()
        until = time.monotonic() + 10.0  # it waits for nothing but a core
        try:
            while _lives(child):
                assert time.monotonic() < until, "it computes on for nobody"
                time.sleep(0.05)
        finally:
            if _lives(child):
                os.kill(child, signal.SIGKILL)


def _lives(process: int) -> bool:
    try:
        status = Path(f"/proc/{process}/stat").read_text()
    except OSError:
        return False
    return status.rsplit(")", 1)[1].split()[0] != "Z"
