"""`shaketable calibrate` as a user meets it."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from shaketable import Body, Motion, simulate
from tests.support.command import refused, shaketable

BODY = Body.rectangle(0.2, 1.0)


@pytest.fixture(scope="module")
def laboratory(tmp_path_factory: pytest.TempPathFactory, p695: list[Motion]) -> Path:
    """A folder with motions, tests of six recordings at three levels, and others to predict."""
    folder = tmp_path_factory.mktemp("laboratory")
    (folder / "table").mkdir()
    rows, others = [], []
    for k, motion in enumerate(p695[::12][:6]):
        np.savetxt(
            folder / "table" / f"m{k}.csv",
            np.column_stack([motion.time, motion.horizontal]),
            delimiter=",",
            header="time_s,acceleration_m/s2",
            comments="",
        )
        for scale in (0.5, 1.0, 1.6):
            fell = "yes" if simulate(BODY, motion.scaled(scale)).outcome else "no"
            rows.append(f"{k}-{scale},m{k}.csv,{scale},{fell}")
        others.append(f"new {k},m{k}.csv,1.3")
    (folder / "tests.csv").write_text("test,motion,scale,fell\n" + "\n".join(rows) + "\n")
    (folder / "others.csv").write_text("test,motion,scale\n" + "\n".join(others) + "\n")
    return folder


def test_all_its_files(laboratory: Path) -> None:
    run = shaketable(
        "calibrate", "tests.csv", "--motions", "table", "--predict", "others.csv", "--members", 128,
        "--base-m", 0.2, "--height-m", 1.0, "--units", "m/s2", "--out", "out", cwd=laboratory,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert "of 18 tests, made from 6 recordings (as no records are named" in run.stdout
    out = laboratory / "out"
    with (out / "predictions.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0])[:4] == ["test", "probability", "low", "high"]
    assert [row["test"] for row in rows] == [f"new {k}" for k in range(6)]
    assert rows[0]["motion"] == "m0.csv"  # as in the table
    assert all(0.0 <= float(row["low"]) <= float(row["high"]) <= 1.0 for row in rows)
    with (out / "posterior.csv").open() as file:
        members = list(csv.DictReader(file))
    assert len(members) == 128
    # weights are written with six digits
    assert sum(float(row["weight"]) for row in members) == pytest.approx(1.0, abs=1e-4)
    page = (out / "index.html").read_text()
    assert "nearly scaled copies of each other" in page
    assert "What was not considered" in page
    for name in ("outcomes", "reliability", "settings", "residuals", "ways", "posterior"):
        assert (out / f"{name}.png").stat().st_size > 5000
    told = json.loads((out / "run.json").read_text())
    assert len(told["motions"]) == 6
    assert {len(each) for each in told["motions"].values()} == {64}  # SHA-256
    assert told["setting"].keys() == {
        "noise", "error", "memory",
    }  # fmt: skip


def test_earlier_results_are_kept(laboratory: Path) -> None:
    (laboratory / "kept").mkdir()
    (laboratory / "kept" / "thesis.txt").write_text("mine")
    said = refused(
        "calibrate", "tests.csv", "--motions", "table", "--out", "kept", "--overwrite",
        cwd=laboratory,
    )  # fmt: skip
    assert "holds 'thesis.txt'" in said


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--base-m", "0.2"], "--base-m and --height-m: give both of them, or none"),
        (["--base-m", "-1", "--height-m", "1"], "--base-m must be a positive"),
        (["--prior", "tests.csv"], "accepted columns: parameter"),
        (["--predict", "gone.csv"], "gone.csv: no such file"),
        ([], "'m0.csv'"),
    ],
)
def test_what_is_refused(laboratory: Path, options: list[str], message: str) -> None:
    units = ["--units", "m/s2"] if options else ["--units", "g", "--time-step-s", "7"]
    said = refused(
        "calibrate", "tests.csv", "--motions", "table", "--out", "refused", *options, *units,
        cwd=laboratory,
    )  # fmt: skip
    assert message in said
    assert not (laboratory / "refused").exists()
