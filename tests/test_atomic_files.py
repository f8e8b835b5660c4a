"""Outputs are whole or not there, and earlier results survive what ends a run."""

from __future__ import annotations

import contextlib
import errno
import os
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest

from shaketable import InputError, atomic_files
from shaketable.atomic_files import (
    appearing_file,
    require_writable,
    results_folder,
    write_csv,
    write_table,
)
from tests.support import record_files
from tests.support.command import shaketable

FILES = ("a.txt", "b.txt")
ENDED = 2**22 - 1  # a process number that hardly any system gives, and none here


def written(folder: Path, text: str, overwrite: bool = True) -> None:
    with results_folder(folder, overwrite, FILES) as fresh:
        for name in FILES:
            (fresh / name).write_text(text)


def held(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def test_a_file_is_whole_or_as_it_was(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    with appearing_file(path) as fresh:
        fresh.write_text("first")
    with contextlib.suppress(RuntimeError), appearing_file(path) as fresh:
        fresh.write_text("half")
        raise RuntimeError
    assert path.read_text() == "first"
    assert held(tmp_path) == {"a.txt"}


def test_what_fails_to_be_written_is_named(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    with pytest.raises(OSError, match="No space left") as error, appearing_file(path):
        raise OSError(errno.ENOSPC, "No space left on device")  # as libraries raise it
    assert error.value.filename == str(path)
    other = tmp_path / "other"
    with pytest.raises(FileNotFoundError) as error, appearing_file(path):
        other.read_text()
    assert error.value.filename == str(other)


def test_a_link_is_written_through(tmp_path: Path) -> None:
    target, link = tmp_path / "target.txt", tmp_path / "link.txt"
    target.write_text("old")
    link.symlink_to(target)
    with appearing_file(link) as fresh:
        fresh.write_text("new")
    assert link.is_symlink()
    assert target.read_text() == "new"


def test_results_are_replaced_whole(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    written(folder, "first")
    with pytest.raises(InputError, match="exists and is not empty"):
        written(folder, "second", overwrite=False)
    with contextlib.suppress(RuntimeError), results_folder(folder, True, FILES) as fresh:
        (fresh / "a.txt").write_text("half")
        raise RuntimeError
    assert (folder / "a.txt").read_text() == "first"
    written(folder, "second")
    assert {(folder / name).read_text() for name in FILES} == {"second"}
    assert held(tmp_path) == {"out"}


@pytest.mark.parametrize("step", [1, 2, 3])
def test_an_interrupt_while_results_are_replaced_loses_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, step: int
) -> None:
    # Ctrl-C just before, between and after the two renames
    folder = tmp_path / "out"
    written(folder, "first")
    rename, calls = Path.rename, []

    def interrupted(path: Path, target: Path) -> Path:
        calls.append(path)
        if len(calls) == step:
            raise KeyboardInterrupt
        moved = rename(path, target)
        if len(calls) == 2 and step == 3:
            raise KeyboardInterrupt
        return moved

    monkeypatch.setattr(Path, "rename", interrupted)
    with pytest.raises(KeyboardInterrupt):
        written(folder, "second")
    monkeypatch.undo()
    assert {(folder / name).read_text() for name in FILES} == {"second" if step == 3 else "first"}
    assert held(tmp_path) == {"out"}


def left_by(process: int, folder: Path) -> Path:
    return folder.parent / f".{folder.name}-{atomic_files._machine()}-{process}-abc"


@pytest.mark.skipif(os.name != "posix", reason="asks whether a process runs")
def test_what_killed_runs_left_is_cleared(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    folder = tmp_path / "out"
    written(folder, "first")
    dead, running = left_by(ENDED, folder), left_by(os.getpid(), folder)
    for left in (dead, running):
        (left / "new").mkdir(parents=True)
    written(folder, "second")
    assert held(tmp_path) == {"out", running.name}
    # killed between the two renames
    folder.rename(tmp_path / "moved")
    dead.mkdir()
    (tmp_path / "moved").rename(dead / "old")
    with pytest.raises(InputError, match="exists and is not empty"):
        require_writable(folder, False, FILES)
    assert (folder / "a.txt").read_text() == "second"
    assert "an interrupted run had moved these results; they are back" in caplog.text
    assert held(tmp_path) == {"out", running.name}


def test_of_another_machine_only_what_is_old_is_cleared(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    fresh, old = tmp_path / ".out-elsewhere-12-a", tmp_path / ".out-elsewhere-13-b"
    for left in (fresh, old):
        left.mkdir()
    os.utime(old, (0, 0))
    written(folder, "first")
    assert held(tmp_path) == {"out", fresh.name}


def test_no_cell_is_a_formula(tmp_path: Path) -> None:
    names = ["=cmd|' /C calc'!A0", "+1", "@x", "-H1", "shelf", "a=b", ""]
    table = pd.DataFrame({"name": names, "tilt": [-1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]})
    write_csv(table, tmp_path / "a.csv")
    again = pd.read_csv(tmp_path / "a.csv", keep_default_na=False)
    assert list(again["name"]) == ["'=cmd|' /C calc'!A0", "'+1", "'@x", "'-H1", "shelf", "a=b", ""]
    assert again["tilt"][0] == -1.5


FULL = (
    "import resource, signal, sys\n"
    "from shaketable.cli import main\n"
    "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
    "resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))\n"
    "main()\n"
)


@pytest.mark.skipif(os.name != "posix", reason="limits the size of files")
@pytest.mark.parametrize("command", ["simulate", "animate", "records"])
def test_a_full_disk_leaves_no_half_picture(tmp_path: Path, command: str) -> None:
    # files of at most 2 kB stand for a disk that fills while a picture is written
    record = tmp_path / "a.AT2"
    record.write_text(record_files.at2())
    out = tmp_path / "out"
    out.mkdir()
    thing = ["--base-m", "0.3", "--height-m", "1.8", "--record", str(record)]
    arguments = {
        "simulate": ["simulate", *thing, "--plot", str(out / "a.png")],
        "animate": ["simulate", *thing, "--animate", str(out / "a.gif")],
        "records": ["records", str(record), "--out", str(out / "new")],
    }[command]
    run = subprocess.run(
        [sys.executable, "-c", FULL, *arguments], capture_output=True, text=True, check=False
    )
    assert run.returncode == 1, run.stderr
    assert f"error: {out}" in run.stderr
    assert "Traceback" not in run.stderr
    assert held(out) == set()


def test_names_cannot_command_a_terminal_or_a_spreadsheet(tmp_path: Path) -> None:
    things = tmp_path / "things.csv"
    things.write_text("name,width_m,height_m,note\n=1+1 \x1b[31mred,0.3,1.8,@x\nplain,0.3,1.8,\n")
    code = "import sys\nfrom shaketable.cli import main\nmain()\n"
    motions = tmp_path / "\x1b[2Jmotions.csv"
    motions.write_text(record_files.csv(), encoding="utf-8")
    arguments = ["assess", str(things), "--motions", str(motions), "--out", str(tmp_path / "out")]
    run = subprocess.run(
        [sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stderr
    assert "\x1b" not in run.stdout + run.stderr
    assert r"\x1b[31m" in run.stdout
    rows = pd.read_csv(tmp_path / "out" / "results.csv")
    assert rows["name"].str.startswith(("'=1+1", "plain")).all()


def test_no_cell_begins_a_row(tmp_path: Path) -> None:
    names = ["a\r=1+1", "b\nc", "d\x1b[31m", "\ufeff=1", "\uff1d1+1"]
    write_csv(pd.DataFrame({"name": names}), tmp_path / "a.csv")
    again = pd.read_csv(tmp_path / "a.csv")["name"]
    assert list(again) == [r"a\r=1+1", r"b\nc", r"d\x1b[31m", r"\ufeff=1", "'\uff1d1+1"]


def test_a_long_name_leaves_room_for_what_is_added(tmp_path: Path) -> None:
    folder = tmp_path / ("x" * 250)
    written(folder, "first")
    written(folder, "second")
    assert (folder / "a.txt").read_text() == "second"
    assert held(tmp_path) == {folder.name}


@pytest.mark.skipif(os.name != "posix", reason="links, and names of any bytes")
def test_places_that_cannot_be_named(tmp_path: Path) -> None:
    loop = tmp_path / "loop"
    loop.symlink_to(loop)
    with pytest.raises(InputError, match="loop"):
        require_writable(loop, False, FILES)
    record = tmp_path / os.fsdecode(b"m\xff.csv")
    record.write_text(record_files.csv())
    run = shaketable("records", record)
    assert run.returncode == 2
    assert "the name is not in UTF-8" in run.stderr
    run = shaketable("records", tmp_path)  # it is in the folder
    assert run.returncode == 2
    assert "the name is not in UTF-8" in run.stderr


def test_a_picture_does_not_take_the_place_of_the_record(tmp_path: Path) -> None:
    record = tmp_path / "a.svg"
    record.write_text(record_files.csv())
    run = shaketable(
        "simulate", "--base-m", 0.3, "--height-m", 1.8, "--record", record, "--plot", record
    )
    assert run.returncode == 2
    assert "is the record" in run.stderr
    assert record.read_text() == record_files.csv()


def test_tables_are_csv_alone_without_pyarrow(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    table = pd.DataFrame({"name": ["shelf"], "width_m": [0.123456789]})
    assert write_table(table, tmp_path, "both") == ["both.csv", "both.parquet"]
    pd.testing.assert_frame_equal(pd.read_parquet(tmp_path / "both.parquet"), table)
    assert not caplog.text
    monkeypatch.setitem(sys.modules, "pyarrow", None)  # as if it were not installed
    assert write_table(table, tmp_path, "one") == ["one.csv"]
    assert (tmp_path / "one.csv").read_text() == (tmp_path / "both.csv").read_text()
    assert not (tmp_path / "one.parquet").exists()
    assert "pip install 'shaketable[parquet]'" in caplog.text
