"""Results are those that are stored: words, names, counts and outcomes exactly, numbers nearly.

Whoever means to change one stores it anew (`python -m tests.golden.make`) and says why.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from matplotlib.figure import Figure

from tests.golden.commands import CALLS, called
from tests.golden.datasets import CASES, written
from tests.golden.make import STORED, file_of
from tests.support.command import undrawn
from tests.support.small_files import write_small_files

#: A number that is no whole one.
REAL = re.compile(r"-?\d+\.\d+(?:[eE][-+]?\d+)?|-?\d+[eE][-+]?\d+")
NEAR = 1e-9  # relative: other processors and libraries round otherwise
NOTHING = 1e-12  # what is nothing but round-off


def same(expected: str, found: str) -> None:
    """AssertionError at the first line that is told otherwise."""
    ours, theirs = found.splitlines(), expected.splitlines()
    for number, (one, other) in enumerate(zip(ours, theirs, strict=False), 1):
        if one != other:
            assert REAL.sub("#", one) == REAL.sub("#", other), f"line {number}"
            numbers = [list(map(float, REAL.findall(line))) for line in (one, other)]
            assert numbers[0] == pytest.approx(numbers[1], rel=NEAR, abs=NOTHING), f"line {number}"
    assert len(ours) == len(theirs)


@pytest.mark.parametrize("name", CASES)
def test_datasets_runs_and_answers(name: str) -> None:
    same((STORED / file_of(name)).read_text("utf-8"), written(name))


@pytest.mark.filterwarnings("ignore::ResourceWarning")  # pygmm leaves its files open
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize("name", CALLS)
def test_commands(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Figure, "savefig", undrawn)
    write_small_files(tmp_path)
    same((STORED / file_of(f"{name} said")).read_text("utf-8"), called(name, tmp_path))


def test_a_change_is_seen() -> None:
    same("a 1.0 b\n", "a 1.0000000001 b\n")
    for found in ("a 1.00001 b\n", "a 1.0 c\n", "a 1.0 b\nc\n", "a 1 b\n"):
        with pytest.raises(AssertionError):
            same("a 1.0 b\n", found)
