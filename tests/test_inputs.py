"""Files that users give."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from shaketable import InputError, inputs, read_components
from shaketable.building import read_building
from shaketable.inputs import TooLargeError, read_file
from shaketable.inventory import read_inventory
from shaketable.records.text import NoAccelerationError

READERS = [read_file, read_components, read_inventory, read_building]


@pytest.mark.parametrize("read", READERS)
def test_what_is_no_file_is_named(read, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="none: no such file"):
        read(tmp_path / "none")
    with pytest.raises(InputError, match="is a folder"):
        read(tmp_path)
    with pytest.raises(InputError, match="File name too long"):
        read(tmp_path / ("x" * 300))
    with pytest.raises(InputError, match="longer than the 4096 letters"):
        read(tmp_path / ("x" * 5000))
    with pytest.raises(InputError, match="null"):
        read(tmp_path / "a\0b")


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="needs a device that never ends")
@pytest.mark.parametrize("read", READERS)
def test_a_device_or_a_pipe_is_not_read(read, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for path in (Path("/dev/zero"), tmp_path / "pipe"):  # one never ends, one never begins
        with pytest.raises(InputError, match="is a pipe or a device"):
            read(path)


def test_files_are_read_up_to_a_size(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(inputs, "LARGEST_FILE", 1000)
    path = tmp_path / "a"
    path.write_bytes(b"1" * 1000)
    assert len(read_file(path)) == 1000
    path.write_bytes(b"1" * 1001)
    with pytest.raises(TooLargeError, match=r"larger than 0\.001 MB"):
        read_file(path)
    with pytest.raises(InputError, match="larger"):
        read_components(path)
    path.write_bytes(b"\0" * 1001)  # a picture in a folder of records is no fault
    with pytest.raises(NoAccelerationError, match="larger"):
        read_components(path)
