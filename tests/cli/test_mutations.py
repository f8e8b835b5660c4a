"""Thousands of damaged command lines: done or refused, and nothing else."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError
from tests.fuzz.asked import line_as_file, run_line, write_beside


@pytest.mark.parametrize(
    ("count", "seed"),
    [
        pytest.param(80, 1, id="some"),
        pytest.param(2_000, 2, id="many", marks=pytest.mark.slow),
    ],
)
@pytest.mark.filterwarnings("error::RuntimeWarning")
def test_damaged_command_lines(tmp_path: Path, count: int, seed: int) -> None:
    write_beside(tmp_path)
    rng, done = np.random.default_rng(seed), 0
    for _ in range(count):
        (tmp_path / "words").write_bytes(line_as_file(rng))
        try:
            run_line(tmp_path / "words")
            done += 1
        except InputError:
            pass
    assert done > count / 20  # some still mean something
