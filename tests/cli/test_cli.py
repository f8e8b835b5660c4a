"""The command line, as a user meets it: output, files, exit codes."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from shaketable import Body, General, Support, __version__, read_motion, simulate
from shaketable.cli import _spread
from tests.support.command import refused, shaketable


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory) -> Path:
    rng = np.random.default_rng(5)
    samples = np.convolve(rng.normal(0, 0.5, 600), np.ones(20) / 8, "same")
    path = tmp_path_factory.mktemp("records") / "shaking.csv"
    rows = [f"{0.01 * n:.2f},{a:.6f}" for n, a in enumerate(samples)]
    path.write_text("\n".join(["time_s,acceleration_g", *rows]))
    return path


@pytest.fixture(scope="module")
def inventory(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("inventory") / "things.csv"
    path.write_text("name,width_m,height_m,quantity\nshelf & co,0.32,1.8,3\nbox,0.5,0.4,1\n")
    return path


@pytest.fixture(scope="module")
def assessed(record: Path, inventory: Path, tmp_path_factory: pytest.TempPathFactory):
    out = tmp_path_factory.mktemp("out") / "result"
    run = shaketable("assess", inventory, "--motions", record, "near-field-pulse", "--out", out)
    return run, out


def test_assess_prints_a_table_and_the_report(assessed) -> None:
    run, out = assessed
    assert run.returncode == 0, run.stderr
    assert "shelf & co" in run.stdout
    assert run.stdout.splitlines()[-1] == f"report: {out / 'report.html'}"


def test_assess_writes_results(assessed, inventory: Path, record: Path) -> None:
    _, out = assessed
    expected = {"results.parquet", "results.csv", "report.html", "run.json"}
    assert {path.name for path in out.iterdir()} == expected
    parquet, text = pd.read_parquet(out / "results.parquet"), pd.read_csv(out / "results.csv")
    assert list(parquet["name"]) == list(text["name"]) == ["shelf & co", "box"]
    assert parquet["fall_share"].values == pytest.approx(text["fall_share"].values, rel=1e-5)
    run = json.loads((out / "run.json").read_text())
    assert run["versions"]["shaketable"] == __version__
    assert run["command"].startswith("shaketable assess ")
    assert str(record) in run["command"]
    assert run["motions"]["count"] == 29
    assert len(run["inventory"]["sha256"]) == 64
    assert {len(source["sha256"]) for source in run["motions"]["sources"]} == {64}


def test_run_can_be_repeated_from_its_log(assessed, tmp_path: Path) -> None:
    _, out = assessed
    import shlex

    words = shlex.split(json.loads((out / "run.json").read_text())["command"])[1:]
    words[words.index("--out") + 1] = str(tmp_path / "again")
    assert shaketable(*words).returncode == 0
    again = pd.read_parquet(tmp_path / "again" / "results.parquet")
    pd.testing.assert_frame_equal(again, pd.read_parquet(out / "results.parquet"))


def test_report_is_self_contained(assessed) -> None:
    _, out = assessed
    page = (out / "report.html").read_text(encoding="utf-8")
    assert "shelf &amp; co" in page
    assert not re.search(r"(src|href)=[\"'](?!data:|#)", page)
    assert "http" not in re.sub(r"data:image/svg\+xml;base64,[A-Za-z0-9+/=]+", "", page)
    words, numbers = page.index("Thing by thing"), page.index("What simple criteria say")
    assert words < numbers < page.index("Method</h3>")
    assert "nan" not in re.sub(r"<[^>]*>", "", page).split()


def test_existing_results_are_kept(assessed, inventory: Path, record: Path) -> None:
    _, out = assessed
    before = (out / "report.html").read_bytes()
    again = shaketable("assess", inventory, "--motions", record, "--out", out)
    assert again.returncode == 2
    assert "--overwrite" in again.stderr
    assert (out / "report.html").read_bytes() == before


def test_overwrite_replaces_results_and_nothing_else(
    inventory: Path, record: Path, tmp_path: Path
) -> None:
    arguments = ("assess", inventory, "--motions", record, "--overwrite", "--out")
    (tmp_path / "precious.txt").write_text("mine")
    kept = shaketable(*arguments, tmp_path)
    assert kept.returncode == 2
    assert "precious.txt" in kept.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["precious.txt"]
    out = tmp_path / "out"
    assert shaketable(*arguments, out).returncode == 0
    first = json.loads((out / "run.json").read_text())["started"]
    assert shaketable(*arguments, out).returncode == 0
    assert json.loads((out / "run.json").read_text())["started"] >= first
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out", "precious.txt"]


def test_nothing_is_written_where_it_fails(
    inventory: Path, record: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from shaketable.assess import assess
    from shaketable.inventory import read_inventory
    from shaketable.report import assessment_folder

    found = assess(read_inventory(inventory), [read_motion(record)], progress=False)

    def fail(*_: object) -> str:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(assessment_folder, "render", fail)
    with pytest.raises(OSError, match="No space"):
        assessment_folder.write_results(found, {}, tmp_path / "out")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["none.csv"], "none.csv: no such file"),
        (["bad.csv"], "bad.csv, line 2, width_m: expected a positive number, found '-1'"),
        (["--motions", "nothing"], "'nothing' is neither a file, a folder nor a suite"),
        (["--motions", "none.at2"], "'none.at2' is neither a file"),
        (["--motions", "bare.txt"], "bare.txt: has no column 'time'"),
        (["--motions", "far-field", "far-field"], "named 2 times"),
        (["--downhill-share", "2"], "control must lie between"),
        (["--scale", "0"], "scale must be"),
        (["--tilt-deg", "80"], "falls by itself"),
        (["--tilt-deg", "-3"], "tilt"),
        (["--out", "bad.csv"], "bad.csv: is a file"),
        (["--units", "furlong"], "furlong"),
        (["--no-such-option"], "no-such-option"),
        (["--motions"], "--motions"),
    ],
)
def test_bad_input_ends_with_2(arguments: list[str], message: str, tmp_path: Path) -> None:
    (tmp_path / "bad.csv").write_text("name,width_m,height_m\na,-1,2\n")
    (tmp_path / "bare.txt").write_text("1\n2\n3\n")
    assert message in refused("assess", *arguments, cwd=tmp_path)
    assert not (tmp_path / "assessment").exists()


def test_names_are_shown_as_they_are(record: Path, tmp_path: Path) -> None:
    (tmp_path / "odd.csv").write_text(
        "name,width_m,height_m\nRack $_5$ a,0.3,1.8\n[/] b [bold],0.3,1.8\n<i>c</i> é,0.2,1\n"
    )
    run = shaketable("assess", "odd.csv", "--motions", record, "--out", "out", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert "[/] b [bold]" in run.stdout
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "&lt;i&gt;c&lt;/i&gt; é" in page


def test_the_current_folder_is_not_replaced(inventory: Path, tmp_path: Path) -> None:
    run = shaketable("assess", inventory, "--out", ".", cwd=tmp_path)
    assert run.returncode == 2
    assert "current folder" in run.stderr


def test_a_link_to_a_folder_stays(inventory: Path, record: Path, tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to(tmp_path / "real")
    run = shaketable("assess", inventory, "--motions", record, "--out", tmp_path / "link")
    assert run.returncode == 0, run.stderr
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real" / "report.html").exists()


def test_all_faults_of_an_inventory_are_shown(tmp_path: Path) -> None:
    (tmp_path / "bad.csv").write_text("name,width_m,height_m\na,-1,2\nb,1,x\n")
    run = shaketable("assess", "bad.csv", cwd=tmp_path)
    assert len(run.stderr.splitlines()) == 2
    assert all(line.startswith("error: bad.csv, line") for line in run.stderr.splitlines())


@pytest.mark.parametrize("outcome", ["falls", "stands"])
def test_simulate_json(record: Path, outcome: str) -> None:
    width = 0.2 if outcome == "falls" else 0.55
    run = shaketable(
        "simulate", "--base-m", width, "--height-m", 1.0, "--record", record, "--scale", 1.2,
        "--tilt-deg", 2, "--eccentricity", 0.45, "--json",
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    found = json.loads(run.stdout)
    assert list(found) == ["outcome", "overturning_time_s", "peak_rotation_rad", "impacts"]
    response = simulate(
        Body.rectangle(width, 1.0, eccentricity=0.45),
        read_motion(record).scaled(1.2),
        Support(tilt=np.radians(2)),
    )
    assert found["outcome"] == response.outcome.name.lower()
    assert found["peak_rotation_rad"] == response.peak_rotation
    assert found["impacts"] == response.impacts
    assert (found["overturning_time_s"] is None) == (outcome == "stands")


def test_simulate_says_it_in_words_and_pictures(record: Path, tmp_path: Path) -> None:
    run = shaketable(
        "simulate", "--base-m", 0.5, "--height-m", 1.5, "--record", record, "--vertical", record,
        "--plot", tmp_path / "run.png", "--animate", tmp_path / "run.gif",
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert "under shaking:" in run.stdout
    assert (tmp_path / "run.png").stat().st_size > 10_000
    assert (tmp_path / "run.gif").read_bytes()[:3] == b"GIF"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--base-m", "0", "--height-m", "1"], "base [m] must be a positive"),
        (["--height-m", "1"], "--base-m"),
        (["--base-m", "1", "--height-m", "1", "--eccentricity", "1"], "eccentricity"),
        (["--base-m", "1", "--height-m", "1", "--plot", "x.docx"], "x.docx: the name must end in"),
        (["--base-m", "1", "--height-m", "1", "--plot", "none/x.png"], "there is no folder"),
        (
            ["--base-m", "1", "--height-m", "1", "--animate", "x.avi"],
            "x.avi: the name must end in",
        ),
    ],
)
def test_simulate_bad_input(
    record: Path, arguments: list[str], message: str, tmp_path: Path
) -> None:
    assert message in refused("simulate", "--record", record, *arguments, cwd=tmp_path)


def test_version_and_suites() -> None:
    # in a process of its own, as installed
    process = subprocess.run(
        [Path(sys.executable).with_name("shaketable"), "--version"], capture_output=True, text=True
    )
    assert process.returncode == 0
    assert process.stdout == f"shaketable {__version__}\n"
    assert "fema-p695-far-field" in shaketable("suites").stdout
    assert "assess" in shaketable("--help").stdout


def test_motions_option_takes_several() -> None:
    spread = _spread(["assess", "a.csv", "--motions", "x", "y", "--out", "z"])
    assert spread == ["assess", "a.csv", "--motions", "x", "--motions", "y", "--out", "z"]
    same = ["assess", "--motions", "x", "--motions", "y"]
    assert _spread(same) == same


def test_simulate_general(record: Path, tmp_path: Path) -> None:
    size = ("--base-m", 0.4, "--height-m", 0.6, "--record", record, "--scale", 2)
    grip = ("--static-friction", 0.25, "--kinetic-friction", 0.2, "--normal-restitution", 0.1)
    run = shaketable("simulate", *size, "--model", "general", *grip, "--json")
    assert run.returncode == 0, run.stderr
    found = json.loads(run.stdout)
    model = General(static_friction=0.25, kinetic_friction=0.2, normal_restitution=0.1)
    motion = read_motion(record).scaled(2)
    expected = simulate(Body.rectangle(0.4, 0.6), motion, model=model)
    for name in ("displacement_x", "slip_downhill", "slip_uphill", "max_lift"):
        assert found[f"{name}_m"] == pytest.approx(getattr(expected, name), rel=1e-9)
    assert [step["phase"] for step in found["phases"]] == [p.name.lower() for p in expected.phases]
    picture = tmp_path / "run.png"
    run = shaketable("simulate", *size, "--model", "general", *grip, "--plot", picture)
    assert "slides by up to" in run.stdout
    assert picture.stat().st_size > 10_000


def test_friction_needs_the_general_model(record: Path) -> None:
    size = ("--base-m", 0.4, "--height-m", 0.6, "--record", record)
    run = shaketable("simulate", *size, "--static-friction", 0.3)
    assert run.returncode == 2
    assert "--static-friction: only --model general" in run.stderr
    run = shaketable("simulate", *size, "--model", "general", "--static-friction", -1)
    assert run.returncode == 2
    assert "must not be negative" in run.stderr
    run = shaketable("simulate", *size, "--model", "sliding")
    assert run.returncode == 2
    assert "'sliding'" in run.stderr


def test_assess_general(record: Path, tmp_path: Path) -> None:
    things = tmp_path / "things.csv"
    things.write_text("name,width_m,height_m,support_length_m\nbox,0.5,0.4,0.52\nshelf,0.3,1.8,\n")
    out = tmp_path / "out"
    grip = ("--model", "general", "--static-friction", 0.15)
    run = shaketable("assess", things, "--motions", record, *grip, "--scale", 2, "--out", out)
    assert run.returncode == 0, run.stderr
    table = pd.read_csv(out / "results.csv")
    assert table["slides_share"][0] > 0
    assert table["walks_off_share"].notna().tolist() == [True, False]
    settings = json.loads((out / "run.json").read_text())["settings"]
    assert (settings["model"], settings["static_friction"]) == ("general", 0.15)


def test_modes(tmp_path: Path) -> None:
    size = ("--base-m", 0.4, "--height-m", 1.0, "--eccentricity", 0.4)
    picture = tmp_path / "map.png"
    run = shaketable("initial-modes", *size, "--static-friction", 0.5, "--out", picture)
    assert run.returncode == 0, run.stderr
    # b_R = 0.24 m, b_L = 0.16 m, h = 0.5 m
    assert "toward +x: rests, then rocks above 0.48 g" in run.stdout
    assert "toward -x: rests, then rocks above 0.32 g" in run.stdout
    assert picture.stat().st_size > 10_000
    run = shaketable("initial-modes", *size, "--static-friction", 0.0, "--out", picture)
    assert run.returncode == 2
    assert "positive" in run.stderr


def test_a_word_longer_than_any_name_is_refused_in_short() -> None:
    said = refused("suites", "9" * 6000)
    assert "longer than the 4096 letters" in said
    assert len(said) < 200


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
@pytest.mark.parametrize(
    "words",
    [
        ["suites"],
        ["initial-modes", "--base-m", "0.3", "--height-m", "1.8", "--static-friction", "0.5"],
    ],
)
def test_a_stream_that_takes_no_more_is_named(words: list[str], tmp_path: Path) -> None:
    """`suites` tells line by line, `modes` by a table."""
    with Path("/dev/full").open("w") as full:
        run = subprocess.run(
            [sys.executable, "-m", "shaketable", *words],
            stdout=full, stderr=subprocess.PIPE, text=True, check=False, cwd=tmp_path,
        )  # fmt: skip
    assert run.returncode == 1
    assert run.stderr.startswith("error: standard output: No space left on device")
    assert "Traceback" not in run.stderr
