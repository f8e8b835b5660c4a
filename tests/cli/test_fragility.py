"""`shaketable fragility` as a user meets it."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure

from shaketable import Body, suite
from shaketable.fragility import efficiency
from tests.support.command import refused, shaketable, undrawn

ONE = ("--base-m", 0.32, "--height-m", 1.8)


def test_one_object(tmp_path: Path) -> None:
    run = shaketable(
        "fragility", *ONE, "--out", "found", "--export", "nrml, pelicun",
        "--limit-states", "rocks 0.5 alpha, overturns", "--motions", "far-field", cwd=tmp_path,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert "2 functions, from 44 motions of 22 recordings of 14 earthquakes" in run.stdout
    table = pd.read_csv(tmp_path / "found" / "functions.csv")
    assert table["limit_state"].tolist() == ["rocks 0.5 α", "overturns"]
    assert table["median"].iloc[1] == pytest.approx(0.427, rel=0.02)  # as fragility() finds it
    median = f"PGV {100 * table['median'].iloc[1]:.3g} cm/s"
    assert median in run.stdout
    page = (tmp_path / "found" / "index.html").read_text()
    assert median in page
    assert "What was not considered" in page
    assert "Which measure tells most" in page
    files = {path.name for path in (tmp_path / "found").iterdir()}
    assert {
        "fragility.xml", "fragility.csv", "fragility.json", "consequence_repair.csv", "run.json",
        "curve_1.png", "measures.png", "measures.csv", "functions.parquet",
    } <= files  # fmt: skip
    told = json.loads((tmp_path / "found" / "run.json").read_text())
    assert told["settings"]["limit_states"] == "rocks 0.5 alpha, overturns"
    again = shaketable("fragility", *ONE, "--out", "found", cwd=tmp_path)
    assert again.returncode == 2


def test_which_measure_tells_most_is_asked_on_the_tilt_that_was_given(tmp_path: Path) -> None:
    """The dispersions of measures.csv are those of `efficiency` on a support of 3°."""
    run = shaketable("fragility", *ONE, "--tilt-deg", 3, "--motions", "near-field-pulse",
                     "--out", "found", cwd=tmp_path)  # fmt: skip
    assert run.returncode == 0, run.stderr
    told = pd.read_csv(tmp_path / "found" / "measures.csv").set_index("measure")["beta"]
    motions = suite("fema-p695-near-field-pulse")
    body = Body.rectangle(0.32, 1.8)
    on_tilt, level = (
        efficiency([body], motions, tilt=tilt).set_index("measure")["beta"]
        for tilt in (math.radians(3.0), 0.0)
    )
    for name in ("PGA", "PGV"):
        assert told[name] == pytest.approx(on_tilt[name], rel=1e-4)
        assert abs(told[name] - level[name]) > 0.01


@pytest.mark.slow
def test_other_methods(tmp_path: Path) -> None:
    """Levels are told in the units of the page."""
    for given, method in (
        (("--method", "stripes", "--levels", "20, 40, 80", "--geometric-mean"), "20, 40, 80 cm/s"),
        (("--method", "truncated-ida", "--highest", 50), "only that is known"),
    ):
        run = shaketable("fragility", *ONE, "--out", "found", "--overwrite", *given, cwd=tmp_path)
        assert run.returncode == 0, run.stderr
        assert method in (tmp_path / "found" / "index.html").read_text()
    known = pd.read_csv(tmp_path / "found" / "residuals.csv")
    assert known["magnitude"].between(6.5, 7.9).all()  # FEMA P-695, tables
    assert (tmp_path / "found" / "residuals.png").exists()
    for given, said in (
        (("--method", "stripes"), "--method stripes needs --levels, in cm/s for PGV"),
        (("--method", "truncated-ida", "--highest", -5), "--highest must be above 0, in cm/s"),
        (("--levels", "20"), "--method cloud takes no --levels"),
        (("--limit-states", "rocks 1.5 alpha"), "write 'overturns', or a share below 1"),
        (("--measure", "CAV", "--export", "pelicun"), "pelicun knows no measure CAV"),
    ):
        assert said in refused("fragility", *ONE, "--out", "other", *given, cwd=tmp_path)


def test_what_was_filled_in_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Costs that a user has written are not overwritten, and nothing is simulated before that."""
    monkeypatch.setattr(Figure, "savefig", undrawn)
    once = (
        "fragility", *ONE, "--out", "found", "--export", "pelicun", "--measure", "pgv",
        "--motions", "near-field-pulse",
    )  # fmt: skip
    assert shaketable(*once, "--export", "nrml,pelicun", cwd=tmp_path).returncode == 0
    assert (tmp_path / "found" / "fragility.xml").exists()
    assert shaketable(*once, "--overwrite", cwd=tmp_path).returncode == 0
    assert not (tmp_path / "found" / "fragility.xml").exists()
    path = tmp_path / "found" / "consequence_repair.csv"
    table = pd.read_csv(path)
    table.loc[0, ["Incomplete", "DS1-Theta_0"]] = [0, 1500.0]
    table.to_csv(path, index=False)
    said = refused(*once, "--overwrite", cwd=tmp_path)
    assert "holds costs or times that were filled in" in said
    assert pd.read_csv(path).loc[0, "DS1-Theta_0"] == 1500.0


def test_a_body_that_never_falls_has_a_page(tmp_path: Path) -> None:
    run = shaketable(
        "fragility", "--base-m", 3, "--height-m", 0.5, "--out", "found", "--export", "nrml",
        cwd=tmp_path,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert "none of 1 function" in run.stdout
    assert "not exported for nrml: nothing can be exported" in run.stderr
    assert (tmp_path / "found" / "index.html").exists()
    assert not (tmp_path / "found" / "fragility.xml").exists()


def test_records_of_one_earthquake(tmp_path: Path) -> None:
    """Nothing is told of chance over earthquakes, and the page is there."""
    (tmp_path / "records").mkdir()
    for k, motion in enumerate(suite("far-field")[:4]):
        rows = [f"{step:.3f},{a:.6f}" for step, a in zip(
            motion.time_step * np.arange(motion.horizontal.size), motion.horizontal, strict=True
        )]  # fmt: skip
        (tmp_path / "records" / f"{k}.csv").write_text("\n".join(["time,acc_m/s2", *rows]))
    run = shaketable(
        "fragility", *ONE, "--out", "found", "--motions", "records", "--tilt-deg", 2,
        "--more-beta", 0.25, cwd=tmp_path,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    page = (tmp_path / "found" / "index.html").read_text()
    assert "on a support tilted by 2°" in page
    table = pd.read_csv(tmp_path / "found" / "functions.csv").iloc[0]
    assert table["tilt_deg"] == pytest.approx(2.0)
    assert table["beta"] > 0.25


@pytest.mark.slow
def test_an_inventory(tmp_path: Path) -> None:
    (tmp_path / "rooms.csv").write_text(
        "name,depth_m,width_m,height_m,castors,anchored\n"
        "shelf,0.3,0.9,1.8,,\ncart,0.5,0.5,1.0,free,\nbolted,0.3,0.9,1.8,,yes\n"
    )
    run = shaketable(
        "fragility", "--inventory", "rooms.csv", "--out", "found", "--method", "ida",
        "--measure", "SA(1.0)", cwd=tmp_path,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert "1 objects on castors are taken as if they did not roll" in run.stderr
    table = pd.read_csv(tmp_path / "found" / "functions.csv")
    assert table["body"].tolist() == [
        "1: shelf, front to back", "1: shelf, side to side", "2: cart",
    ]  # fmt: skip
    page = (tmp_path / "found" / "index.html").read_text()
    assert "θ: SA(1.0) [g]" in page
    assert "sample of the lognormal" in page


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ((), "give --inventory, or --base-m and --height-m"),
        (("--base-m", 0.3), "give both of them"),
        ((*ONE, "--inventory", "x.csv"), "give --inventory, or --base-m"),
        ((*ONE, "--export", "hazus"), "--export: unknown 'hazus'; accepted: nrml, pelicun"),
        ((*ONE, "--scales", "1,x"), "--scales: numbers with commas, got '1,x'"),
        ((*ONE, "--scales", "0,1"), "--scales: numbers above 0"),
        ((*ONE, "--measure", "PGW"), "unknown intensity measure 'PGW'"),
        ((*ONE, "--limit-states", "slides 0.1 m"), "the rocking model knows no slip"),
        ((*ONE, "--measure", "CAV", "--export", "nrml"), "OpenQuake knows no measure CAV"),
        ((*ONE, "--tilt-deg", 20), "falls by itself"),
    ],
)
def test_what_is_refused(tmp_path: Path, given: tuple[object, ...], said: str) -> None:
    assert said in refused("fragility", *given, "--out", "found", cwd=tmp_path)
    assert not (tmp_path / "found").exists()
