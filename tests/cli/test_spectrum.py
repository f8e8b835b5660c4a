"""`shaketable overturning-spectrum` as a user meets it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tests.support.command import refused, shaketable

ONE = ("--base-m", 0.32, "--height-m", 1.8)


def test_pulses_on_one_body(tmp_path: Path) -> None:
    run = shaketable("overturning-spectrum", *ONE, "--points", 12, "--out", "found", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert "α = 10.08°" in run.stdout  # atan(0.32/1.8)
    table = pd.read_csv(tmp_path / "found" / "spectrum.csv")
    assert len(table) == 144
    fallen = table["fate"].str.startswith("overturns")
    assert f"{100 * fallen.mean():.0f} % of the sine pulses" in run.stdout
    assert (table.loc[table["amplitude"] < 1.0, "fate"] == "rests").all()
    borders = pd.read_csv(tmp_path / "found" / "borders.csv")
    uplift = borders[borders["below"] == "rests"]["amplitude"]
    assert uplift.to_numpy() == pytest.approx(1.0, rel=2e-6)  # a_p = g tan α
    assert (tmp_path / "found" / "spectrum.png").stat().st_size > 10_000


def test_blocks_under_one_record(tmp_path: Path) -> None:
    time = np.arange(0.0, 6.0, 0.01)
    samples = 5.0 * np.sin(5.0 * time) * np.exp(-0.3 * time)
    lines = (f"{t:.2f},{a:.6f}" for t, a in zip(time, samples, strict=True))
    (tmp_path / "one.csv").write_text("time_s,acceleration_m_s2\n" + "\n".join(lines) + "\n")
    run = shaketable(
        "overturning-spectrum", "--record", "one.csv", "--slenderness-deg", "10, 20", "--points", 9,
        "--units", "m/s2", "--out", "found", cwd=tmp_path,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    table = pd.read_csv(tmp_path / "found" / "spectrum.csv")
    assert sorted(set(table["slenderness_deg"].round(6))) == [10.0, 20.0]
    assert f"{int(table['overturns'].sum())} of 18 blocks overturn" in run.stdout
    assert 0 < table["overturns"].sum() < 18


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ((), "give --base-m and --height-m of a body, or --record"),
        ((*ONE, "--pulse", "square"), "unknown pulse 'square'; accepted: sine"),
        ((*ONE, "--record", "x.csv"), "--record is for blocks of all sizes"),
        (("--record", "x.csv"), "x.csv"),
    ],
)
def test_what_is_refused(tmp_path: Path, given: tuple[object, ...], said: str) -> None:
    assert said in refused("overturning-spectrum", *given, "--out", "found", cwd=tmp_path)
    assert not (tmp_path / "found").exists()
