"""Some thousand damaged files of every kind; `make fuzz` takes a million."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.fuzz.readers import readers
from tests.fuzz.run import Outcome, fuzz


def test_whole_files_are_read(tmp_path: Path) -> None:
    for reader in readers(tmp_path):
        path = tmp_path / reader.name
        path.write_bytes(reader.raw)
        assert reader.read(path) is not None, reader.name


@pytest.mark.parametrize("seed", range(4))
def test_damaged_files_are_read_or_refused(seed: int) -> None:
    found: Outcome = fuzz(seed, 0, 400)
    assert not found.failures, found.failures[0].said
    assert {how for _, how in found.counts} == {"read", "refused"}
