"""Which sources machine code is made of.

Numba's disk cache notices an edit in the file of the function that was called, but not in the
files of the functions that it calls. Folders of machine code are therefore named after a hash of
every source that it may be made of: an edit in any of them opens a new, empty folder. The rooms in
one entry of `COMPILED_TOGETHER` share a hash; an edit in the room of the oscillators does not
compile the contact kernels anew.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1]

#: Rooms that hold compiled code, grouped by what is compiled together.
COMPILED_TOGETHER = {
    "engine": ("physics/plane", "engine"),
    "oscillators": ("oscillators",),
    "space": ("physics/space",),
}
SHARED_SOURCES = ("compiled/*.py", "physics/dormand_prince.py", "physics/hermite.py", "units.py")


def source_hash(room: str, package: Path = PACKAGE) -> str:
    """Hash of the sources that a room's drivers are made of."""
    digest = hashlib.sha256()
    patterns = [f"{each}/*.py" for each in COMPILED_TOGETHER[room]]
    sources = {path for each in (*patterns, *SHARED_SOURCES) for path in package.glob(each)}
    for path in sorted(sources):
        digest.update(f"\0{path.relative_to(package).as_posix()}\0".encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def folder_of(function: Callable[..., object]) -> str:
    """What the folder of a driver's machine code is called."""
    group = group_of(function)
    if group is None:
        raise ValueError(f"{function.__code__.co_filename} is in no room that is compiled")
    return f"{group}-{_hash_here(group)}"


def group_of(function: Callable[..., object]) -> str | None:
    """The entry of COMPILED_TOGETHER with the room that the function stands in, if there is one."""
    folder = Path(function.__code__.co_filename).resolve().parent
    for group, rooms in COMPILED_TOGETHER.items():
        if any(folder == PACKAGE / room for room in rooms):
            return group
    return None


_hash_here = cache(source_hash)
