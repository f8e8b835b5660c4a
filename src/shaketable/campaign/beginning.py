"""A store before its blocks are done: whose it is, what it was begun with, what is missing."""

from __future__ import annotations

import json
import logging
import shutil
import time
import uuid
from collections import deque
from collections.abc import Mapping
from typing import Any

from shaketable.campaign import kinds
from shaketable.campaign.as_json import to_json
from shaketable.campaign.blocks import BEGUN
from shaketable.campaign.fingerprint import differences, key_of, thing_hash
from shaketable.campaign.lock import LOCK, TAKING
from shaketable.campaign.notes import DONE, done_name, faults_of, notes_of, numbers_in
from shaketable.campaign.objects import Objects
from shaketable.campaign.work import PLAN, RESULTS, Work
from shaketable.errors import InputError, SimulationError
from shaketable.lazy_motions import heads_of
from shaketable.motion_file import bytes_of as bytes_of_samples
from shaketable.progress import size

log = logging.getLogger(__name__)


PARTS = ("campaign", RESULTS)


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


def begin(work: Work, objects: Objects, fresh: bool) -> dict[str, Any]:
    """Prepare a store, and return the fingerprint of all that the results depend on.

    A store with the same campaign is kept. In a new store, or with `fresh`, the contents are
    deleted and the plan is written.

    Raises:
        InputError: the store holds a campaign that differs from this one, or whose plan is lost.
    """
    made = work.fingerprint()
    if not fresh and objects.get(BEGUN) is not None:
        told = _told(objects)
        if told is not None:
            _require_alike(work, told, objects)
            changed = differences(told.get("fingerprint", {}), made, work.named)
            if changed:
                raise InputError(
                    f"{objects.place}: was begun with another campaign ({'; '.join(changed)}); "
                    "go on with what it was begun with, give another store, or --fresh to delete "
                    "what is done and begin anew"
                )
            _mend(work, made, told, objects)
            others = _otherwise(told, _plain(work.told()))
            if others:
                # what the results do not depend on, as limit states that are told of them
                log.warning(
                    "%s: its plan now has another %s; what is done is kept",
                    objects.place, ", ".join(others),
                )  # fmt: skip
                kinds.save_plan(work, made, objects)
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
    work.create(objects)
    kinds.save(work, made, objects)
    return made


def _require_alike(work: Work, told: dict[str, Any], objects: Objects) -> None:
    """InputError if a plan is of another format, or of another kind of work."""
    try:
        kinds.require_format(told, objects)
    except SimulationError as error:
        raise InputError(str(error)) from None
    if told.get("kind") != work.kind:
        raise InputError(
            f"{objects.place}: was begun with another campaign ({told.get('kind')} → {work.kind}); "
            "give another store, or --fresh to delete what is done and begin anew"
        )


def _otherwise(told: Mapping[str, Any], made: Mapping[str, Any]) -> list[str]:
    """The names of what a plan says otherwise, such as "library.title"."""
    found = []
    for name, value in made.items():
        before = told.get(name)
        if isinstance(value, dict) and isinstance(before, dict):
            found += [f"{name}.{part}" for part in _otherwise(before, value)]
        elif before != value:
            found.append(name)
    return found


def _plain(told: Mapping[str, Any]) -> dict[str, Any]:
    """As JSON gives it back."""
    return dict(json.loads(json.dumps(told)))


def _told(objects: Objects) -> dict[str, Any] | None:
    """What the plan of a store says; None where it is lost or damaged."""
    try:
        return objects.get_json(PLAN)
    except SimulationError:
        return None


def _mend(work: Work, made: dict[str, Any], told: dict[str, Any], objects: Objects) -> None:
    """Rewrite a damaged plan or damaged motions.

    If arrays are missing or damaged, all results are deleted and the arrays are created again.
    """
    try:
        stored = kinds.load(objects, told)
        deque(stored.motions, maxlen=0)  # each is read, and held against its hash
    except SimulationError as error:
        log.warning("%s; written again", error)
        kinds.save(work, made, objects)
    if work.is_there(objects):
        return
    log.warning("%s: arrays are missing or damaged; all blocks are done again", objects.place)
    objects.remove(DONE)
    objects.remove(RESULTS)
    work.create(objects)


def missing(work: Work, made: Mapping[str, Any], objects: Objects) -> list[int]:
    """The numbers of the blocks to do, the longest first.

    Removes the notes of blocks that are damaged, or were done with other inputs.
    """
    there, notes = set(numbers_in(DONE, objects)), notes_of(work, objects)
    faults = faults_of(notes, objects, whole=True)
    found, damaged = [], 0
    for number in work.longest_first():
        note = notes.get(number)
        mine = note is not None and note["key"] == key_of(made, work.parts_of(number, made))
        if mine and number not in faults:
            continue
        found.append(number)
        if number in there:
            damaged += 1
            objects.remove(done_name(number))
    if damaged:
        log.warning("%d of the blocks that were done are damaged, and are done again", damaged)
    return found


def require_room(work: Work, blocks: int, objects: Objects) -> None:
    """InputError if a folder's disk may not hold what is missing."""
    if objects.folder is None:
        return
    place = objects.folder
    while not place.exists():
        place = place.parent
    begun = objects.get_json(PLAN) is not None
    need = work.size * blocks / work.blocks
    need += 0 if begun else bytes_of_inputs(work)
    free = shutil.disk_usage(place).free
    if need > free:
        raise InputError(
            f"{objects.place}: up to {size(need)} are needed and {size(free)} are free; use "
            'a larger disk, or for simulations keep = "summary"'
        )


def bytes_of_inputs(work: Work) -> int:
    """Bytes of the motions, before compression, and of what the plan says of each body, about."""
    motions = sum(map(bytes_of_samples, heads_of(work.motions)))
    return motions + sum(
        len(things) * len(json.dumps([to_json(things[0]), thing_hash(things[0])], indent=1))
        for name, things in work.named.items()
        if name != "motions"
    )
