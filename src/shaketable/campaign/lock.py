"""One driver at a time on a store: a lock that says who holds it, and that goes stale.

In a folder it is made by an operation that only one process can succeed in. An object store
promises no such thing: there it is best effort, and two drivers that begin in the same second may
both go on. They would do work twice, and write the same results: a block's result depends on its
inputs alone.
"""

from __future__ import annotations

import json
import logging
import os
import platform
import threading
import time
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from shaketable.campaign.objects import Objects
from shaketable.errors import InputError

log = logging.getLogger(__name__)

LOCK = "campaign/lock.json"
HEARTBEAT = 10.0  # s
STALE = 60.0  # s without a heartbeat


@contextmanager
def locked(objects: Objects) -> Iterator[None]:
    """Hold the lock of a store.

    Raises:
        InputError: another driver holds it.
    """
    mine = {
        "host": platform.node(),
        "process": os.getpid(),
        "token": uuid.uuid4().hex,
        "started": time.time(),
    }
    _take(objects, mine)
    stop = threading.Event()
    beat = threading.Thread(target=_beat, args=(objects, mine, stop), daemon=True)
    beat.start()
    try:
        yield
    finally:
        stop.set()
        beat.join()
        if (holder_of(objects) or {}).get("token") == mine["token"]:
            objects.remove(LOCK)


def _take(objects: Objects, mine: dict[str, Any]) -> None:
    for _ in range(3):
        if objects.create(LOCK, _content(mine)):
            return
        holder = holder_of(objects)
        if holder is None:
            continue
        age = time.time() - holder.get("heartbeat", 0.0)
        if not _is_over(holder, age):
            raise InputError(
                f"{objects.place}: is being written by process {holder.get('process')} on "
                f"{holder.get('host')}, which was heard {max(0.0, age):.0f} s ago; it is taken for "
                f"dead after {STALE:.0f} s"
            )
        log.warning(
            "%s: process %s on %s held the lock and was not heard for %.0f s; going on",
            objects.place,
            holder.get("process"),
            holder.get("host"),
            age,
        )
        objects.remove(LOCK)
    raise InputError(f"{objects.place}: another process took the lock at the same time; try again")


def _is_over(holder: dict[str, Any], age: float) -> bool:
    """Whether the process that holds a lock has ended, as far as one can know."""
    if holder.get("host") == platform.node() and os.name == "posix":
        try:
            os.kill(int(holder["process"]), 0)  # asks only
        except ProcessLookupError:
            return True
        except (OSError, KeyError, ValueError):
            pass
    return age > STALE


def holder_of(objects: Objects) -> dict[str, Any] | None:
    """What the lock says; {} where it cannot be read, None where there is none."""
    content = objects.get(LOCK)
    if content is None:
        return None
    try:
        found = json.loads(content)
    except ValueError:
        return {}  # being written, or left by a killed process: it goes stale
    return found if isinstance(found, dict) else {}


def _content(mine: dict[str, Any]) -> bytes:
    return json.dumps({**mine, "heartbeat": time.time()}).encode()


def _beat(objects: Objects, mine: dict[str, Any], stop: threading.Event) -> None:
    while not stop.wait(HEARTBEAT):
        try:
            objects.put(LOCK, _content(mine))
        except OSError as error:  # a full disk: the next one may pass
            log.info("the lock's heartbeat could not be written (%s)", error)
