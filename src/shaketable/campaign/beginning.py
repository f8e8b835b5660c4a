"""A store before its blocks are done: whose it is, what it was begun with, what is missing."""

from __future__ import annotations

import logging
import shutil
import time
import uuid
from collections import deque
from collections.abc import Mapping
from typing import Any

import numpy as np

from shaketable.campaign import arrays, inputs
from shaketable.campaign.fingerprint import differences, fingerprint, key_of
from shaketable.campaign.lock import LOCK, TAKING
from shaketable.campaign.notes import faults_of, notes_of, numbers_in
from shaketable.campaign.objects import Objects
from shaketable.campaign.plan import Plan
from shaketable.campaign.work import BEGUN, DONE, done_name
from shaketable.errors import InputError, SimulationError
from shaketable.lazy_motions import heads_of
from shaketable.motion_file import bytes_of as bytes_of_samples
from shaketable.progress import size

log = logging.getLogger(__name__)

BODY = 250  # bytes of a body in the plan, with its hash

PARTS = ("campaign", arrays.RESULTS)


def require_store(objects: Objects) -> None:
    """InputError unless a store is new, empty, or holds a campaign and nothing else."""
    if objects.folder is not None and objects.folder.exists() and not objects.folder.is_dir():
        raise InputError(f"{objects.place}: is a file; --store names a folder or a URL")
    foreign = sorted(set(objects.names()) - set(PARTS))
    if not foreign and objects.get(BEGUN) is None:
        # folders of these names may be anybody's
        held = {f"{part}/{name}" for part in PARTS for name in objects.names(part)}
        foreign = sorted(held - {LOCK, TAKING})
    if foreign:
        raise InputError(
            f"{objects.place}: holds {foreign[0]!r}, which is no part of a campaign; give an empty "
            "folder, or a new one"
        )


def begin(plan: Plan, objects: Objects, fresh: bool) -> dict[str, Any]:
    """Make a store ready for a plan, new or begun before; returns what the plan depends on.

    Raises:
        InputError: the store holds a campaign that differs from this one, or whose plan is lost.
    """
    made = fingerprint(plan)
    if not fresh and objects.get(BEGUN) is not None:
        told = _told(objects)
        if told is not None:
            changed = differences(told.get("fingerprint", {}), made, plan)
            if changed:
                raise InputError(
                    f"{objects.place}: was begun with another campaign ({'; '.join(changed)}); "
                    "go on with what it was begun with, give another store, or --fresh to delete "
                    "what is done and begin anew"
                )
            _mend(plan, made, told, objects)
            return made
        if objects.names(DONE):
            raise InputError(
                f"{objects.place}: blocks are done, but the plan is lost or damaged; give another "
                "store, or --fresh to begin anew"
            )
    # first of all: from now on these folders are a campaign's
    objects.put_json(BEGUN, {"token": uuid.uuid4().hex, "time": time.time()})
    for part in PARTS:
        for name in objects.names(part):
            if f"{part}/{name}" not in (LOCK, TAKING, BEGUN):
                objects.remove(f"{part}/{name}")
    arrays.create(plan, objects)
    inputs.save(plan, made, objects)
    return made


def _told(objects: Objects) -> dict[str, Any] | None:
    """What the plan of a store says; None where it is lost or damaged."""
    try:
        return objects.get_json(inputs.PLAN)
    except SimulationError:
        return None


def _mend(plan: Plan, made: dict[str, Any], told: dict[str, Any], objects: Objects) -> None:
    """Write again what is damaged of a store's inputs and arrays; the blocks come later."""
    try:
        stored = inputs.load(objects, told)
        deque(stored.ensemble.motions, maxlen=0)  # each is read, and held against its hash
    except SimulationError as error:
        log.warning("%s; written again", error)
        inputs.save(plan, made, objects)
    if arrays.is_there(plan, objects):
        return
    log.warning("%s: arrays are missing or damaged; all blocks are done again", objects.place)
    objects.remove(DONE)
    objects.remove(arrays.RESULTS)
    arrays.create(plan, objects)


def missing(plan: Plan, made: Mapping[str, Any], objects: Objects) -> list[int]:
    """The blocks that are not done, the strongest first; what is damaged counts as not done."""
    there, notes = set(numbers_in(DONE, objects)), notes_of(plan, objects)
    faults = faults_of(notes, objects, whole=True)
    found, damaged = [], 0
    for number in plan.strongest_first():
        note = notes.get(number)
        mine = note is not None and note["key"] == key_of(plan.block(number), made)
        if mine and number not in faults:
            continue
        found.append(number)
        if number in there:
            damaged += 1
            objects.remove(done_name(number))
    if damaged:
        log.warning("%d of the blocks that were done are damaged, and are done again", damaged)
    return found


def require_room(plan: Plan, blocks: int, objects: Objects) -> None:
    """InputError if a folder's disk may not hold what is missing."""
    if objects.folder is None:
        return
    place = objects.folder
    while not place.exists():
        place = place.parent
    begun = objects.get_json(inputs.PLAN) is not None
    need = bytes_of(plan) * blocks / int(np.prod(plan.grid))
    need += 0 if begun else bytes_of_inputs(plan)
    free = shutil.disk_usage(place).free
    if need > free:
        raise InputError(
            f"{objects.place}: up to {size(need)} are needed and {size(free)} are free; take "
            "another disk, or keep a summary"
        )


def bytes_of_inputs(plan: Plan) -> int:
    """Bytes of the motions, before compression, and of what the plan says of each body, about."""
    motions = sum(map(bytes_of_samples, heads_of(plan.ensemble.motions)))
    return motions + BODY * len(plan.ensemble.bodies)


def bytes_of(plan: Plan) -> int:
    """Bytes of all results before compression, which are more than the store will have."""
    return sum(
        int(np.prod(layout.shape, dtype=object)) * layout.dtype.itemsize
        for layout in arrays.layouts(plan).values()
    )
