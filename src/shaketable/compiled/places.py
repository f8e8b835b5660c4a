"""Where this user's machine code is kept: a folder into which nobody else may write."""

from __future__ import annotations

import logging
import os
import stat
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import numba.core.config
from platformdirs import user_cache_path

log = logging.getLogger(__name__)

config: Any = numba.core.config


@cache
def cache_directory(name: str) -> Path | None:
    """A writable folder of that name, or None: each process then compiles anew.

    It is in NUMBA_CACHE_DIR if that is set, otherwise in the user's cache folder. What lies there
    is executed, so a folder into which others may write will not do.
    """
    root = Path(config.CACHE_DIR) if config.CACHE_DIR else user_cache_path("shaketable")
    directory = root / name
    try:
        make_private(directory)
        others = writable_by_others(directory)
        if others is not None:
            log.warning(
                "%s: others may write there, so that no compiled code is kept in %s and each run "
                "compiles anew: chmod go-w, or set NUMBA_CACHE_DIR to a folder of your own",
                others,
                root,
            )
            return None
        with tempfile.TemporaryFile(dir=directory):
            return directory
    except OSError:
        return None


def make_private(directory: Path) -> None:
    """Make a folder, with those above it that are missing, for its owner alone."""
    if directory.is_dir():
        return
    make_private(directory.parent)
    directory.mkdir(mode=0o700, exist_ok=True)


def writable_by_others(directory: Path) -> Path | None:
    """The folder itself, or one above it, into which others than the user and root may write.

    None if there is none. Above it one with the sticky bit, as the temporary one has it, will do:
    what lies in it is its owner's alone.
    """
    if not hasattr(os, "getuid"):  # Windows keeps users' folders apart
        return None
    place = directory.resolve()
    for each in (place, *place.parents):
        status = each.stat()
        if status.st_uid not in (0, os.getuid()):
            return each
        kept = each != place and status.st_mode & stat.S_ISVTX
        if status.st_mode & (stat.S_IWGRP | stat.S_IWOTH) and not kept:
            return each
    return None
