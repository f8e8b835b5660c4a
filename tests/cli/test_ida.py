"""`shaketable ida` as a user meets it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from shaketable import Body, ida, suite
from tests.support.command import refused, shaketable

ONE = ("--base-m", 0.32, "--height-m", 1.8)


def test_one_object(tmp_path: Path) -> None:
    run = shaketable(
        "ida", *ONE, "--motions", "near-field-pulse", "--measure", "PGA", "--out", "found",
        cwd=tmp_path,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    table = pd.read_csv(tmp_path / "found" / "capacities.csv")
    known = ida(Body.rectangle(0.32, 1.8), suite("near-field-pulse"), "PGA")
    levels = known["capacity"].values.ravel()
    assert table["capacity"].to_numpy() == pytest.approx(levels, rel=1e-5)  # as printed
    middle = float(np.median(table["capacity"])) / 9.80665
    assert f"half of them from PGA {middle:.3g} g on" in run.stdout
    assert (tmp_path / "found" / "capacities.png").stat().st_size > 10_000


def test_what_is_refused(tmp_path: Path) -> None:
    for given, said in (
        ((), "give --inventory, or --base-m and --height-m"),
        ((*ONE, "--measure", "Tm"), "does not grow with the motion"),
        ((*ONE, "--precision", 0), "precision must lie between"),
    ):
        assert said in refused("ida", *given, "--out", "found", cwd=tmp_path)
    assert not (tmp_path / "found").exists()
