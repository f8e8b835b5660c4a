"""Some thousand damaged files of every kind; `make fuzz` takes a million."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.fuzz import run
from tests.fuzz.readers import Reader, readers
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


@pytest.mark.skipif(not Path("/proc/self/clear_refs").exists(), reason="only Linux tells it anew")
def test_what_takes_too_much_is_found_every_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A second time too, of less: the most that a process ever had would hide it."""
    monkeypatch.setattr(run, "MOST_MEMORY", 50_000_000)

    def taking(size: int) -> Reader:
        return Reader("made", "made", b"", lambda path: bytes(bytearray(b"1") * size))

    for size, how in ((200_000_000, "failed"), (100_000_000, "failed"), (1_000_000, "read")):
        assert run.outcome(taking(size), tmp_path / "made")[0] == how
