"""`shaketable campaign`: run, go on, status, collect."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pandas as pd
import pytest

from shaketable import SimulationError
from tests.support.command import refused, shaketable

pytest.importorskip("zarr", reason="the extra campaign is not installed: pip install '.[campaign]'")

TOML = """
[bodies.grid]
base_m = [0.2, 0.3, 0.4]
height_m = [1.0, 1.5]
[motions]
of = ["fema-p695-near-field-pulse"]
[shaking]
tilts_deg = [0, 2]
[plan]
block = {block}
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "c.toml").write_text(TOML.format(block=200))
    return tmp_path


def test_run_status_and_collect(folder: Path) -> None:
    dry = shaketable("campaign", "run", "c.toml", "--dry-run", cwd=folder)
    assert dry.returncode == 0, dry.stderr
    assert "672 in 4 blocks" in dry.stdout
    assert "/s by a sample of them" in dry.stdout
    run = shaketable("campaign", "run", "c.toml", "--store", "s", cwd=folder)
    assert run.returncode == 0, run.stderr
    assert "4 of 4 done, 0 failed" in run.stdout
    status = shaketable("campaign", "status", "s", cwd=folder)
    assert "672 of 672" in status.stdout
    collect = shaketable("campaign", "collect", "s", "--out", "out", cwd=folder)
    assert collect.returncode == 0, collect.stderr
    table = pd.read_csv(folder / "out" / "falls.csv")
    assert len(table) == 12
    assert table["falls"].sum() == pd.read_parquet(folder / "out" / "falls.parquet")["falls"].sum()
    told = json.loads((folder / "out" / "run.json").read_text())
    assert told["simulations"] == 672
    assert told["environment"] == told["environment_of_this_table"]


def test_it_begins_anew_and_replaces_where_it_is_told_to(folder: Path) -> None:
    """`--fresh` alone takes a store of another campaign, `--overwrite` alone earlier tables."""
    run = shaketable("campaign", "run", "c.toml", "--store", "s", "--workers", 1, cwd=folder)
    assert run.returncode == 0, run.stderr
    (folder / "d.toml").write_text(TOML.format(block=200).replace("[0, 2]", "[0]"))
    assert "another campaign" in refused("campaign", "run", "d.toml", "--store", "s", cwd=folder)
    fresh = shaketable("campaign", "run", "d.toml", "--store", "s", "--fresh", cwd=folder)
    assert fresh.returncode == 0, fresh.stderr
    assert "336 of 336" in shaketable("campaign", "status", "s", cwd=folder).stdout
    words = ("campaign", "collect", "s", "--out", "out")
    assert shaketable(*words, cwd=folder).returncode == 0
    assert "--overwrite" in refused(*words, cwd=folder)
    assert shaketable(*words, "--overwrite", cwd=folder).returncode == 0


def test_what_is_refused(folder: Path) -> None:
    assert "--store: name a folder" in refused("campaign", "run", "c.toml", cwd=folder)
    both = ("--scheduler", "tcp://a:1", "--workers", 2)
    assert "give one of them" in refused(
        "campaign", "run", "c.toml", "--store", "s", *both, cwd=folder
    )
    gpu = ("--device", "tpu")
    assert "unknown device 'tpu'" in refused("campaign", "run", "c.toml", *gpu, cwd=folder)
    assert "no campaign is there" in refused("campaign", "status", "s", cwd=folder)
    assert "no campaign is there" in refused("campaign", "collect", "s", "--out", "o", cwd=folder)
    shaketable("campaign", "run", "c.toml", "--store", "s", cwd=folder)
    (folder / "c.toml").write_text(TOML.format(block=100))
    said = refused("campaign", "run", "c.toml", "--store", "s", cwd=folder)
    assert "was begun with another campaign (blocks: cut otherwise)" in said


def test_a_damaged_chunk_is_told_in_a_line(folder: Path) -> None:
    (folder / "c.toml").write_text(TOML.format(block=200))
    shaketable("campaign", "run", "c.toml", "--store", "s", cwd=folder)
    chunks = (folder / "s" / "results" / "outcome" / "c").rglob("0")
    chunk = next(path for path in chunks if path.is_file())
    chunk.write_bytes(chunk.read_bytes()[:-1] + b"x")
    run = shaketable("campaign", "collect", "s", "--out", "out", cwd=folder)
    assert run.returncode == 1
    assert "is damaged, or that of another block; run the campaign again" in run.stderr
    assert "Traceback" not in run.stderr
    assert not (folder / "out").exists()


def test_ctrl_c_keeps_what_is_done(folder: Path) -> None:
    (folder / "c.toml").write_text(TOML.format(block=4))
    main = "from shaketable.cli import main; main()"
    command = [sys.executable, "-c", main, "campaign", "run", "c.toml", "--store", "s"]
    process = subprocess.Popen(command, cwd=folder, stderr=subprocess.PIPE, text=True)
    done = folder / "s" / "campaign" / "done"
    until = time.monotonic() + 60.0
    while time.monotonic() < until and not (done.is_dir() and len(list(done.iterdir())) > 5):
        time.sleep(0.002)
    os.kill(process.pid, signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 1
    assert "stops at the end of this block" in said
    assert "s: stopped; the same command goes on" in said
    assert "Traceback" not in said
    again = shaketable("campaign", "run", "c.toml", "--store", "s", cwd=folder)
    assert again.returncode == 0, again.stderr


def test_ctrl_c_before_anything_is_written(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from shaketable.campaign import kinds
    from shaketable.cli.campaign import run

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(kinds, "save", interrupted)
    with pytest.raises(SimulationError, match="stopped; the same command goes on"):
        run(folder / "c.toml", store=str(folder / "k"))


def test_what_hangs_in_its_straps_is_said(tmp_path: Path) -> None:
    """It did not fall, and is counted by itself: it is no place to stand under."""
    (tmp_path / "c.toml").write_text(
        "[bodies.grid]\ndepth_m = 0.32\nwidth_m = 0.8\nheight_m = 1.2\n"
        '[motions]\nof = "fema-p695-near-field-pulse"\n'
        '[model]\nname = "general"\nstatic_friction = 0.6\n'
        "[surroundings]\n"
        'straps = ["top:slack=300mm,stiffness=50kN/m,damping=3kNs/m,strength=3kN"]\n'
        'mass_kg = 100\n[results]\nkeep = "summary"\n'
    )
    run = shaketable("campaign", "run", "c.toml", "--store", "s", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    said = shaketable("campaign", "collect", "s", "--out", "out", cwd=tmp_path).stdout
    (row,) = pd.read_csv(tmp_path / "out" / "falls.csv").to_dict("records")
    assert 0 < row["held_up"] < 28 - row["falls"]
    told = f"{row['falls']} of 28 simulations overturn their body ({100 * row['falls'] / 28:.3g} %)"
    assert f"{told}; {row['held_up']} leave it held up by its wall or strap alone" in said
    about = json.loads((tmp_path / "out" / "run.json").read_text())
    assert "stiffness=50000.0" in about["surroundings_of_the_first"]


def test_a_wall_alone_is_told(tmp_path: Path) -> None:
    """`held_up` is counted without a strap, too, and run.json says what stood there."""
    (tmp_path / "c.toml").write_text(
        "[bodies.grid]\ndepth_m = 0.32\nwidth_m = 0.8\nheight_m = 1.2\n"
        '[motions]\nof = "fema-p695-near-field-pulse"\n'
        '[model]\nname = "general"\nstatic_friction = 0.4\n'
        "[surroundings]\nwall_gap_mm = 10\nwall_restitution = 0.3\n"
    )
    run = shaketable("campaign", "run", "c.toml", "--store", "s", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert shaketable("campaign", "collect", "s", "--out", "out", cwd=tmp_path).returncode == 0
    (row,) = pd.read_csv(tmp_path / "out" / "falls.csv").to_dict("records")
    about = json.loads((tmp_path / "out" / "run.json").read_text())
    assert "gap=0.01" in about["surroundings_of_the_first"]
    assert "held_up" in row
