"""One driver at a time on a store: a lock that says who holds it, and that goes stale.

In a folder it is made by an operation that only one process can succeed in. An object store
promises no such thing: there it is best effort, and two drivers that begin in the same second may
both go on. They would do work twice, and write the same results: a block's result depends on its
inputs alone.
"""

from __future__ import annotations

import json
import logging
import math
import os
import platform
import threading
import time
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from shaketable.campaign.objects import Objects
from shaketable.errors import InputError, SimulationError

log = logging.getLogger(__name__)

LOCK, TAKING = "campaign/lock.json", "campaign/lock-taking.json"
HEARTBEAT = 10.0  # s
STALE = 60.0  # s without a heartbeat


@contextmanager
def locked(objects: Objects) -> Iterator[threading.Event]:
    """Hold the lock of a store; the event is set if another driver took it.

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
    stop, lost = threading.Event(), threading.Event()
    beat = threading.Thread(target=_beat, args=(objects, mine, stop, lost), daemon=True)
    beat.start()
    try:
        yield lost
    finally:
        stop.set()
        beat.join()
        if (holder_of(objects) or {}).get("token") == mine["token"]:
            objects.remove(LOCK)


def require_held(lost: threading.Event, objects: Objects) -> None:
    """SimulationError if another driver took the lock."""
    if lost.is_set():
        raise SimulationError(
            f"{objects.place}: another process took the lock, as this one was not heard for "
            f"{STALE:.0f} s; it goes on with the campaign"
        )


def _take(objects: Objects, mine: dict[str, Any]) -> None:
    for _ in range(3):
        if objects.create(LOCK, _content(mine)):
            return
        holder = holder_of(objects)
        if holder is None:
            continue
        age = age_of(holder)
        if not is_over(holder, age):
            raise InputError(
                f"{objects.place}: is being written by process {holder.get('process')} on "
                f"{holder.get('host')}, which was heard {age:.0f} s ago; it is taken for dead "
                f"after {STALE:.0f} s"
            )
        if _put_away(objects, holder):
            log.warning(
                "%s: process %s on %s held the lock and was not heard for %.0f s; going on",
                objects.place,
                holder.get("process"),
                holder.get("host"),
                age,
            )
    raise InputError(f"{objects.place}: another process took the lock at the same time; try again")


def _put_away(objects: Objects, stale: dict[str, Any]) -> bool:
    """Remove a stale lock, unless another process does so; whether it was done."""
    if not objects.create(TAKING, _content({})):
        if age_of(_read(objects.get(TAKING) or b"")) > STALE:  # its process was killed
            objects.remove(TAKING)
        return False
    try:
        if holder_of(objects) != stale:
            return False
        objects.remove(LOCK)
        return True
    finally:
        objects.remove(TAKING)


def age_of(holder: dict[str, Any]) -> float:
    """Seconds since a holder was heard; the clocks of its machine and of this one should agree."""
    heard = holder.get("heartbeat")
    return max(0.0, time.time() - heard) if isinstance(heard, (int, float)) else math.inf


def is_over(holder: dict[str, Any], age: float) -> bool:
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
    return None if content is None else _read(content)


def _read(content: bytes) -> dict[str, Any]:
    try:
        found = json.loads(content)
    except ValueError:
        return {}  # a lock appears whole: this one was damaged
    return found if isinstance(found, dict) else {}


def _content(mine: dict[str, Any]) -> bytes:
    return json.dumps({**mine, "heartbeat": time.time()}).encode()


def _beat(
    objects: Objects, mine: dict[str, Any], stop: threading.Event, lost: threading.Event
) -> None:
    while not stop.wait(HEARTBEAT):
        try:
            if (holder_of(objects) or {}).get("token") != mine["token"]:
                lost.set()
                return
            objects.put(LOCK, _content(mine))
        except OSError as error:  # a full disk: the next one may pass
            log.info("the lock's heartbeat could not be written (%s)", error)
