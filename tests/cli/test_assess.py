"""`shaketable assess` on what people have: spreadsheets, levels, narrow terminals, few motions."""

from __future__ import annotations

import io
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from openpyxl import Workbook
from rich.console import Console

from shaketable import InputError, Motion, simulate_many, suite
from shaketable.assess import Assessment, assess
from shaketable.building import Building
from shaketable.cli.assess import example_inventory
from shaketable.cli.levels import scaling_of
from shaketable.inventory import read_inventory
from shaketable.origin import Origin
from shaketable.report.terminal import print_assessment
from shaketable.signal import spectral_acceleration, spectral_acceleration_at, spectral_ratio_to
from shaketable.signal.scaling import peak_ground_acceleration
from shaketable.signal.spectra import Spectrum
from shaketable.units import STANDARD_GRAVITY
from tests.support.command import refused, shaketable

ROWS = [
    ["Item", "Depth (cm)", "Width (cm)", "Height (cm)", "Qty", "Castors", "Note"],
    ["Bookcase", 32, 90, 180, 8, None, None],
    ["Crash cart", 50, 70, 110, 2, None, None],
    ["Trolley", 50, 70, 110, 2, "free", None],
]


@pytest.fixture
def rooms(tmp_path: Path) -> Path:
    book = Workbook()
    for row in ROWS:
        book.worksheets[0].append(row)
    book.save(tmp_path / "rooms.xlsx")
    return tmp_path


def test_a_spreadsheet_and_its_warnings(rooms: Path) -> None:
    run = shaketable("assess", "rooms.xlsx", "--planar", "--out", "out", cwd=rooms)
    assert run.returncode == 0, run.stderr
    # what was understood is told before the run
    assert re.search(r"Depth \(cm\)\s+depth in cm", run.stderr)
    assert re.search(r"Qty\s+quantity", run.stderr)
    table = pd.read_csv(rooms / "out" / "results.csv").set_index("name")
    assert table.loc["Bookcase", "base_along_direction_m"] == 0.32
    assert table.loc["Crash cart", "risk"] == "not classed"
    page = (rooms / "out" / "report.html").read_text(encoding="utf-8")
    log = json.loads((rooms / "out" / "run.json").read_text())
    # every warning of the run stands in the report, in its words
    assert len(log["messages"]) == run.stderr.count("WARNING: ") == 1
    assert "&#39;Crash cart&#39; may stand on castors. Say none, free or locked" in page
    assert "nothing is needed" not in page.lower()


def test_two_records_decide_nothing(rooms: Path) -> None:
    time = 0.01 * np.arange(500)
    for name, rate in (("a", 6.0), ("b", 7.0)):
        values = 0.01 * np.sin(rate * time)
        pairs = zip(time, values, strict=True)
        text = "\n".join(f"{t:.2f},{a:.5f}" for t, a in pairs)
        (rooms / f"{name}.csv").write_text(f"time_s,acceleration_g\n{text}\n")
    run = shaketable("assess", "rooms.xlsx", "--motions", "a.csv", "b.csv", "--out", "o", cwd=rooms)
    assert run.returncode == 0, run.stderr
    assert run.stdout.splitlines()[1].startswith("This decides nothing")
    table = pd.read_csv(rooms / "o" / "results.csv")
    assert set(table["risk"]) == {"not classed"}
    page = (rooms / "o" / "report.html").read_text(encoding="utf-8")
    assert page.index("This decides nothing") < page.index("What to do first")
    assert "intervals over so few recordings (2) mean little" in page
    assert 'class="card low"' not in page


def told(text: str) -> str:
    """A text without the ends of its lines."""
    return " ".join(text.split())


def test_three_dimensions(tmp_path: Path) -> None:
    """Where both components of a recording are known; `--planar` leaves them out."""
    (tmp_path / "store.csv").write_text(
        "name,depth_m,width_m,diameter_m,height_m\nshelf,0.3,0.9,,1.8\nbottle,,,0.2,1.2\n"
        "unknown,0.3,,,1.8\n"
    )
    given = ("assess", "store.csv", "--motions", "near-field-pulse", "--sa-levels", "1.0s:0.3g",
             "--advise", 0)  # fmt: skip
    run = shaketable(*given, "--out", "out", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert "in three dimensions by both horizontal components of 14 recordings" in told(run.stdout)
    assert "In a plane alone" in run.stdout
    table = pd.read_csv(tmp_path / "out" / "results.csv").set_index("name")
    assert table.loc["bottle", "shape"] == "cylinder"
    assert table.loc["shelf", "simulations"] == 14 * 2 * 4
    assert table["dimensions"].to_list() == [3, 3, 2]
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "Shaken in both horizontal directions at once, it fall" in page
    assert "shaking in both horizontal directions at once and supports" not in page
    quick = shaketable(*given, "--planar", "--out", "quick", cwd=tmp_path)
    assert quick.returncode == 0, quick.stderr
    page = (tmp_path / "quick" / "report.html").read_text(encoding="utf-8")
    assert "three dimensions" not in page
    assert "shaking in both horizontal directions at once and supports" in page
    planar = pd.read_csv(tmp_path / "quick" / "results.csv").set_index("name")
    assert planar["dimensions"].to_list() == [2, 2, 2]
    assert planar["plane_safe_base_m"].notna().all()
    lossy = shaketable(*given, "--restitution-factor", 0.9, "--out", "lossy", cwd=tmp_path)
    assert lossy.returncode == 0, lossy.stderr
    fewer = pd.read_csv(tmp_path / "lossy" / "results.csv").set_index("name")
    assert fewer.loc["shelf", "falls"] < table.loc["shelf", "falls"]


def test_levels(rooms: Path) -> None:
    options = ("--planar", "--motions", "far-field", "--pga-levels", "0.4g,0.2g", "--out", "out")
    run = shaketable("assess", "rooms.xlsx", *options, cwd=rooms)
    assert run.returncode == 0, run.stderr
    assert "scaled to PGA 0.4 g, peaks of 0.40 g" in run.stdout.splitlines()[0]
    assert run.stdout.index("PGA 0.2 g ") < run.stdout.index("PGA 0.4 g ")
    table = pd.read_csv(rooms / "out" / "results.csv").set_index("name")
    (item, *_) = read_inventory(rooms / "rooms.xlsx")
    motions = suite("fema-p695-far-field")
    for level in (0.2, 0.4):
        scaled = [m.scaled(level * STANDARD_GRAVITY / m.peak_ground_acceleration) for m in motions]
        outcome = simulate_many([item.body], scaled, progress=False).outcome.values
        assert table.loc["Bookcase", f"share_at_PGA_{level}_g"] == pytest.approx(
            (outcome != 0).mean(), rel=1e-5
        )
    # the cards are for the strongest
    assert table.loc["Bookcase", "fall_share"] == table.loc["Bookcase", "share_at_PGA_0.4_g"]
    page = (rooms / "out" / "report.html").read_text(encoding="utf-8")
    assert "Each horizontal component is scaled by itself" in page
    assert "peak accelerations of 0.40 g" in page


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--pga-levels", "much"), "--pga-levels: expected levels such as 0.2g,0.4g, found 'much'"),
        (("--pga-levels", "0.2furlong"), "unknown unit of acceleration 'furlong'"),
        (("--pga-levels", "0.2g,0.2g"), "named more than once"),
        (
            ("--pga-levels", "0.2g", "--sa-levels", "1s:0.3g"),
            "--pga-levels and --sa-levels: give one of them",
        ),
        (("--pga-levels", "0.2g", "--scale", "2"), "leave out --scale"),
        (("--sa-levels", "0.3g"), "--sa-levels: expected a period and levels, such as 1.0s:0.3g"),
        (("--target-spectrum", "nothing.csv"), "nothing.csv: no such file"),
        (("--weights", "critical"), "expected name=number"),
        (("--weights", "exit=3"), "expected name=number"),
        (("--weights", "critical=-1"), "expected name=number"),
        (("--building", "."), "--building: .: is a folder"),
        (("--building", "no.toml"), "--building: no.toml: no such file"),
        (("--rolling-resistance", "-0.1"), "friction of free castors must be a positive"),
        (("--pga-levels", "0.2,0.4m/s2"), "give every level its unit"),
        (("--pga-levels", "1,5g"), "give every level its unit"),
        (("--pga-levels", "200gal,0.203943g"), "named more than once"),
        (("--pga-levels", "40g"), "at most 5 g are accepted"),
    ],
)
def test_mistakes(rooms: Path, options: tuple[str, ...], said: str) -> None:
    assert said in refused("assess", "rooms.xlsx", *options, "--out", "out", cwd=rooms)
    assert not (rooms / "out").exists()


def test_scaling_is_what_it_says(tmp_path: Path) -> None:
    motions = suite("fema-p695-far-field")[:3]
    periods = np.geomspace(0.1, 2.0, 20)
    target = Spectrum(periods, np.full(20, 3.0), name="flat")
    for motion in motions:
        one = motion.scaled(spectral_acceleration_at(1.0).factor(motion))
        at = spectral_acceleration(one.horizontal, one.time_step, [1.0])[0]
        assert at == pytest.approx(1.0)
        fit = motion.scaled(spectral_ratio_to(target).factor(motion))
        own = spectral_acceleration(fit.horizontal, fit.time_step, periods)
        # the least squares of logarithms: their mean difference is zero
        assert np.log(own / 3.0).mean() == pytest.approx(0.0, abs=1e-12)
    with pytest.raises(InputError, match="its PGA is zero"):
        peak_ground_acceleration().factor(Motion(np.zeros(5), 0.01, name="still"))
    (tmp_path / "s.csv").write_text("period_s,sa_g\n0.1,0.5\n1.0,0.5\n2.0,0.2\n")
    scaling = scaling_of(None, None, tmp_path / "s.csv", 1.0)
    assert scaling is not None
    assert [level.scale for level in scaling.levels] == [1.0]


def test_floors_are_scaled_with_their_ground() -> None:
    ground, roof = (Motion(scale * np.array([0.0, 1.0, -2.0]), 0.01) for scale in (1.0, 3.0))
    house = Building(name="h", floors={"0": [ground], "1": [roof]}, told="", computed=True)
    scaled = house.scaled_to(peak_ground_acceleration())
    assert scaled.floors["0"][0].peak_ground_acceleration == pytest.approx(1.0)
    assert scaled.floors["1"][0].peak_ground_acceleration == pytest.approx(3.0)
    # recorded: by earthquake, so that the largest component of the lowest floor has the level
    named = Origin(event="Kobe")
    ground, roof = (replace(motion, origin=named) for motion in (ground, roof))
    recorded = Building(name="h", floors={"0": [ground, ground.scaled(2.0)], "1": [roof]}, told="")
    found = recorded.scaled_to(peak_ground_acceleration()).floors
    assert [m.peak_ground_acceleration for m in found["0"]] == pytest.approx([0.5, 1.0])
    assert found["1"][0].peak_ground_acceleration == pytest.approx(6.0 / 4.0)
    # two earthquakes without a name cannot be told apart
    nameless = replace(recorded, floors={"0": [Motion(np.ones(3), 0.01)] * 2})
    with pytest.raises(InputError, match="do not name their earthquake"):
        nameless.scaled_to(peak_ground_acceleration())
    other = replace(roof, origin=Origin(event="Tokachi"))
    with pytest.raises(InputError, match="did not record the earthquakes of 1: "):
        replace(recorded, floors={"0": [ground], "1": [other]}).scaled_to(
            peak_ground_acceleration()
        )


@pytest.fixture(scope="module")
def example() -> Assessment:
    items = read_inventory(example_inventory())
    return assess(items, suite("fema-p695-far-field")[:24], progress=False)


@pytest.mark.parametrize("width", [50, 60, 80, 140])
def test_narrow_terminals_say_what_they_left_out(example: Assessment, width: int) -> None:
    console = Console(file=io.StringIO(), width=width)
    print_assessment(example, console, Path("out"), "24 motions")
    text = console.file.getvalue()
    assert all(len(line) <= width for line in text.splitlines())
    assert "Bookcase 1.80 m" in text
    assert not re.search(r"…\s*$", text, re.MULTILINE)  # a long name may be cut, a number not
    said = re.sub(r"\s+", " ", text)
    assert ("left out for want of room" in said) == (width < 140)
    if width < 140:
        assert "see out/report.html" in said
    # no number is cut: the interval of every share is whole
    # of every object, and of all pieces
    assert len(re.findall(r"\d+ \(\d+–\d+\)", text)) == len(example.results) + 1


@pytest.mark.slow
def test_the_example_building(tmp_path: Path) -> None:
    folder = example_inventory().parent
    if not (folder / "clinic.toml").exists():
        pytest.skip("the package is not in its source tree")
    run = shaketable(
        "assess",
        folder / "clinic.csv",
        "--building",
        folder / "clinic.toml",
        "--out",
        tmp_path / "o",
    )
    assert run.returncode == 0, run.stderr
    assert "Not simulated, as anchored by the inventory: Switchboard" in re.sub(
        r"\s+", " ", run.stdout
    )
    table = pd.read_csv(tmp_path / "o" / "results.csv")
    assert set(table["floor"]) == {0, 1, 2, 3, 4}
    assert "Switchboard" not in set(table["name"])
    page = (tmp_path / "o" / "report.html").read_text(encoding="utf-8")
    assert "Switchboard" in page
    assert "under fema-p695-far-field" in page


@pytest.mark.parametrize(
    "command",
    [
        "assess",
        "simulate",
        "tilt",
        "criteria",
        "initial-modes",
        "records",
        "template",
        "suites",
        "study",
    ],
)
def test_help_has_two_examples(command: str) -> None:
    for words in ((command, "--help"), (command, "-h"), ("help", command)):
        run = shaketable(*words)
        assert run.returncode == 0
        lines = run.stdout.partition("Examples:\n")[2].splitlines()
        assert len([line for line in lines if line.strip().startswith("shaketable ")]) == 2


def test_short_ways() -> None:
    assert shaketable("-V").stdout == shaketable("--version").stdout
    assert "Commands:" in shaketable("-h").stdout
    assert "assess" in shaketable("help").stdout
    assert shaketable("help", "nothing").returncode == 2


def test_examples_in_help_have_known_options() -> None:
    from shaketable.cli.examples import EXAMPLES

    for examples in EXAMPLES.values():
        for example in examples:
            words = example.split()
            told = shaketable(*words[1:2], "-h").stdout if words[1:2] != ["help"] else "--"
            for option in re.findall(r"--[a-z-]+", example):
                assert option in told, (example, option)
