"""The command line on records: what a folder holds, which component, which vertical."""

from __future__ import annotations

import csv
import json
import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from shaketable import InputError, Motion
from shaketable.plot import plot_record, plot_spectra
from shaketable.signal import Spectrum
from tests.support.command import shaketable


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two horizontal components and their vertical one as AT2, a file of two, and a letter."""
    folder = tmp_path_factory.mktemp("network") / "records"
    folder.mkdir()
    rng = np.random.default_rng(3)
    for code, size in (("021", 0.4), ("111", 0.3), ("-UP", 0.2)):
        series = np.convolve(rng.normal(0, size, 800), np.ones(20) / 8, "same")
        rows = "\n".join(f"{value:15.7E}" for value in series)
        title = f"PEER\nA Town, 1/2/1990, A Station, {code.strip('-')}\n"
        text = f"{title}UNITS OF G\nNPTS= 800, DT= .01 SEC\n{rows}\n"
        (folder / f"RSN1_TOWN_{code}.AT2").write_text(text)
    pair = np.convolve(rng.normal(0, 0.5, 600), np.ones(20) / 8, "same")
    table = [f"{0.01 * n:.2f},{a:.6f},{-a:.6f}" for n, a in enumerate(pair)]
    (folder / "two.csv").write_text("\n".join(["time_s,NS_g,EW_g", *table]))
    (folder / "letter.txt").write_text("Dear Sir,\nhere are the records.\n")
    return folder


def test_records_lists_a_folder(folder: Path, tmp_path: Path) -> None:
    out = tmp_path / "listed"
    run = shaketable("records", folder, "--out", out)
    assert run.returncode == 0, run.stderr
    assert "RSN1_TOWN_021.AT2" in run.stdout
    assert "no records of acceleration: letter.txt" in run.stdout
    with (out / "records.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["component"] for row in rows] == ["UP", "021", "111", "NS", "EW"]
    assert rows[1]["station"] == "A Station"
    assert rows[1]["format"] == "PEER AT2"
    assert float(rows[1]["azimuth_deg"]) == 21.0
    shown = re.search(r"_021\.AT2 +021 +21 +800 +0\.01 +(\S+)", run.stdout)
    assert float(shown.group(1)) == pytest.approx(float(rows[1]["pga_g"]), abs=6e-4)
    pictures = sorted(out.glob("*.png"))
    assert len(pictures) == 5
    with Image.open(pictures[0]) as picture:
        assert picture.size == (1000, 540)
        assert len(picture.getcolors(10**6)) > 50


def test_records_names_what_it_cannot_read(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "cut.AT2").write_text("UNITS OF G\nNPTS= 800, DT= .01 SEC\n.1 .2\n")
    run = shaketable("records", folder / "RSN1_TOWN_021.AT2", tmp_path)
    assert run.returncode == 2
    assert "RSN1_TOWN_021.AT2" in run.stdout
    assert "cut.AT2: cut short" in run.stderr
    assert shaketable("records", folder / "letter.txt").returncode == 2
    assert "no such file or folder" in shaketable("records", tmp_path / "none").stderr
    busy = shaketable("records", folder, "--out", folder)
    assert busy.returncode == 2
    assert "is not empty" in busy.stderr


def test_simulate_takes_a_component_and_its_vertical(folder: Path) -> None:
    thing = ("simulate", "--base-m", 0.3, "--height-m", 1.8, "--json", "--scale", 0.8)
    level = shaketable(*thing, "--record", folder / "RSN1_TOWN_021.AT2")
    both = shaketable(*thing, "--record", folder / "RSN1_TOWN_021.AT2", "--vertical", "auto")
    assert level.returncode == both.returncode == 0, both.stderr
    assert json.loads(level.stdout) != json.loads(both.stdout)
    choice = ("--record", folder / "two.csv", "--component", "E-W")
    assert shaketable(*thing, *choice).returncode == 0
    unsure = shaketable(*thing, "--record", folder / "two.csv")
    assert unsure.returncode == 2
    assert "2 horizontal components (NS, 0°; EW, 90°)" in unsure.stderr
    alone = shaketable(*thing, *choice, "--vertical", "auto")
    assert alone.returncode == 2
    assert "no vertical component in it or beside it" in alone.stderr


def test_assess_takes_a_folder_with_verticals(folder: Path, tmp_path: Path) -> None:
    things = tmp_path / "things.csv"
    things.write_text("name,width_m,height_m\nshelf,0.32,1.8\n")
    out = tmp_path / "result"
    run = shaketable("assess", things, "--motions", folder, "--vertical", "--out", out)
    assert run.returncode == 0, run.stderr
    assert "left out, not records: letter.txt" in run.stderr
    assert "2 of 4 motions have no vertical component" in run.stderr
    told = json.loads((out / "run.json").read_text())
    assert told["settings"]["vertical"] is True
    assert told["motions"]["names"] == [
        "RSN1_TOWN_021", "RSN1_TOWN_111", "two NS", "two EW",
    ]  # fmt: skip
    first = told["motions"]["origins"][0]
    assert first["horizontal"]["event"] == "A Town 1/2/1990"
    assert first["vertical"]["file"].endswith("RSN1_TOWN_-UP.AT2")
    refused = shaketable("assess", things, "--vertical", "--out", tmp_path / "none")
    assert refused.returncode == 2
    assert "have no vertical components" in refused.stderr


def test_a_picture_has_units() -> None:
    motion = Motion(np.sin(np.arange(500) / 20), 0.01, name="a $wave$")
    figure = plot_record(motion)
    labels = [ax.get_ylabel() for ax in figure.axes]
    assert labels[:3] == ["acceleration [g]", "velocity [cm/s]", "displacement [cm]"]
    assert "5 % damping" in labels[3]
    ax = plot_spectra([Spectrum(np.array([0.1, 1.0]), np.array([2.0, 1.0]))], color="red")
    assert ax.get_xlabel() == "period [s]"
    with pytest.raises(InputError):
        Spectrum(np.array([]), np.array([]))
