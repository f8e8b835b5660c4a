"""Motions from files and suites, with one reader per format.

A format is one file with `recognise(text) -> bool` and `read(text) -> list[Component]`, entered in
FORMATS of `read`, the most particular first.

- Single numbers and errors come from RecordText (`text.number`, `text.step`, `text.search`,
  `text.fault(message, line)`), series of numbers from `numbers` (`fixed`, `free`, `table`), headers
  of keys and values from `header`.
- All that a file states of itself is checked by `stated`: a count, a peak, a duration.
- `read` turns what arithmetic and indexing raise on a damaged file into an InputError, so that a
  reader needs no guard against that. A file of another quantity raises `text.no_acceleration`, so
  that folders may hold it.
- A reader gives the file's own values; offsets, signs and pairs are the business of `motions`.
- Tests build small files of every layout (`tests/support/record_files.py`): a new one is entered in
  its `examples()`, and damaged at random with the others.
"""

from shaketable.records.component import Component
from shaketable.records.motion_list import Suite
from shaketable.records.motions import read_motion
from shaketable.records.read import read_components
from shaketable.records.suites import DEFAULT_SUITE, SUITES, is_packaged, suite

__all__ = [
    "DEFAULT_SUITE",
    "SUITES",
    "Component",
    "Suite",
    "is_packaged",
    "read_components",
    "read_motion",
    "suite",
]
