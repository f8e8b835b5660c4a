"""`shaketable criteria`, and the criteria in an assessment and a study, as a user meets them."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from shaketable import Body, simulate_many, suite
from shaketable.criteria.overturning import ISHIYAMA, scores
from shaketable.signal import peaks
from shaketable_studies.boroschek_romo_2004.figures import FIGURES
from tests.support.command import refused, shaketable

SHELF = ("criteria", "--base-m", 0.4, "--height-m", 1.8)


def test_criteria_of_given_peaks(tmp_path: Path) -> None:
    run = shaketable(*SHELF, "--pga-g", 0.3, "--pgv-cm-s", 40, cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    # 0.4/1.8 = 0.222 g; 0.4 of Housner's 77.6 cm/s
    assert "PGA 0.3 of 0.222 g, PGV 40 of 31 cm/s" in run.stdout
    assert "40 of the 77.6 cm/s" in run.stdout
    assert "static friction is above 0.222" in run.stdout
    assert "keeps 86.4 % of its energy" in run.stdout
    # equations stand with their paper, and one line at the end says what to believe
    assert "Boroschek & Romo 2004, eqs. 25, 26 and 38" in run.stdout
    end = run.stdout.partition("Bottom line\n")[2]
    assert "Believe that chance" in end
    assert "Kaneko & Hayashi's 27.1 %" in end
    # A50 = 0.2222·1.2222 g = 0.2716 g, V50 = 49.24 cm/s: Φ(ln(40/49.24)/0.34) = Φ(-0.611)
    assert "27.1 % (medium risk) by Kaneko & Hayashi" in run.stdout
    high = shaketable(*SHELF, "--pga-g", 0.9, "--pgv-cm-s", 40, cwd=tmp_path)
    assert "outside of the range of eq. 9: beyond 7" in high.stdout


@pytest.mark.parametrize(
    ("sizes", "peaks", "said"),
    [
        ((0.4, 1.8), (0.1, 40), "It does not begin to rock: that takes 0.222 g"),
        ((0.4, 1.8), (0.3, 40), "checked on recordings that it was not fitted to"),
        ((0.03, 0.3), (0.4, 40), "By Boroschek & Romo's conditions it may overturn"),
    ],
)
def test_bottom_line(
    sizes: tuple[float, float], peaks: tuple[float, float], said: str, tmp_path: Path
) -> None:
    size = ("criteria", "--base-m", sizes[0], "--height-m", sizes[1])
    run = shaketable(*size, "--pga-g", peaks[0], "--pgv-cm-s", peaks[1], cwd=tmp_path)
    assert said in run.stdout.partition("Bottom line")[2]


def test_criteria_of_a_record(tmp_path: Path) -> None:
    time = 0.005 * np.arange(2400)
    # an acceleration of 0.4 g sin 2πt/1.2 under an envelope, and one with a shifted zero after it
    clean = 0.4 * np.sin(2 * np.pi * time / 1.2) * np.exp(-((time - 5.0) ** 2))
    for name, series in {"clean": clean, "shifted": clean + 0.01 * (time > 5.5)}.items():
        rows = "\n".join(f"{t:.3f},{a:.8f}" for t, a in zip(time, series, strict=True))
        (tmp_path / f"{name}.csv").write_text(f"time_s,acceleration_g\n{rows}\n")
    told = {}
    for name in ("clean", "shifted"):
        run = shaketable(*SHELF, "--record", f"{name}.csv", "--json", cwd=tmp_path)
        assert run.returncode == 0, run.stderr
        told[name] = json.loads(run.stdout)
    assert told["clean"]["source"] == "clean"
    assert told["shifted"]["source"] == "shifted, baseline corrected"
    # the drift of 0.01 g over 6 s is 0.6 m/s; corrected, the peak is the clean one within a tenth
    assert told["shifted"]["pgv_m_s"] == pytest.approx(told["clean"]["pgv_m_s"], rel=0.1)
    assert len(told["clean"]["verdicts"]) == 5
    with_vertical = shaketable(
        *SHELF, "--record", "clean.csv", "--vertical", "shifted.csv", cwd=tmp_path
    )
    assert "keeps contact at rest: the smallest g + a_y is 0.6" in with_vertical.stdout


def test_the_friction_that_rocking_asked_for(tmp_path: Path) -> None:
    """More than at rest, b/h, and no more than the strongest record's own A could ask for."""
    time = np.arange(0.0, 3.0, 0.01)
    rows = "\n".join(f"{a:.6f}" for a in 0.5 * np.sin(2 * np.pi * time))
    (tmp_path / "sine.csv").write_text(f"acceleration_g\n{rows}\n")
    words = (*SHELF, "--record", "sine.csv", "--time-step-s", 0.01)
    told = json.loads(shaketable(*words, "--json", cwd=tmp_path).stdout)
    width, height = (float(SHELF[k + 1]) for k in (1, 3))
    assert width / height < told["friction_while_rocking"] < 1.0
    said = shaketable(*words, cwd=tmp_path).stdout
    assert f"above {told['friction_while_rocking']:.2g} throughout (eq. 20)" in said


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "give both --pga-g and --pgv-cm-s"),
        (["--pga-g", 0.3], "give both --pga-g and --pgv-cm-s"),
        (["--pga-g", -1, "--pgv-cm-s", 3], "--pga-g must be"),
        (["--pga-g", 1, "--pgv-cm-s", "nan"], "--pgv-cm-s must be"),
        (["--record", "x.at2", "--pga-g", 1], "leave out --pga-g"),
        (["--record", "none.at2"], "none.at2"),
    ],
)
def test_criteria_bad_input(arguments: list, message: str, tmp_path: Path) -> None:
    assert message in refused(*SHELF, *arguments, cwd=tmp_path)


def test_assess_shows_the_criteria(tmp_path: Path) -> None:
    (tmp_path / "things.csv").write_text(
        "name,width_m,height_m,eccentricity\nlocker,0.4,1.8,0.5\nleaning,0.4,1.8,0.25\n"
    )
    given = ("assess", "things.csv", "--planar", "--motions", "far-field")
    run = shaketable(*given, "--out", "out", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    table = pd.read_csv(tmp_path / "out" / "results.csv").set_index("name")
    motions = suite("far-field")
    bodies = [Body.rectangle(0.4, 1.8), Body.rectangle(0.4, 1.8, eccentricity=0.25)]
    falls = (simulate_many(bodies, motions, progress=False).outcome.values != 0).reshape(2, 44, 2)
    found = [peaks(motion) for motion in motions]
    pga, pgv = (np.array([each[k] for each in found]) for k in (0, 1))
    for k, name in enumerate(("locker", "leaning")):
        body = bodies[k]
        score = scores(0.4, body.left / 0.4, 0.9, body.gyration_radius, pga, pgv)[ISHIYAMA]
        assert table.loc[name, "ishiyama_share"] == pytest.approx((score > 1).mean())
        assert table.loc[name, "ishiyama_missed"] == falls[k][score <= 1].sum()
    assert table.loc["leaning", "ishiyama_missed"] > 0
    assert table.loc["leaning", "known_eccentricity_missed"] == 0
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "What simple criteria say" in page
    assert "Simple criteria overlook some of its" in page
    tilted = shaketable("assess", "things.csv", "--tilt-deg", 2, "--out", "tilted", cwd=tmp_path)
    assert tilted.returncode == 0, tilted.stderr
    assert "housner_share" not in pd.read_csv(tmp_path / "tilted" / "results.csv")
    assert "imple criteria" not in (tmp_path / "tilted" / "report.html").read_text("utf-8")


@pytest.mark.slow  # the writing of a study is tested with that of tilting
def test_study_writes_every_result(tmp_path: Path) -> None:
    run = shaketable(
        "study", "boroschek-romo-2004", "--motions", "near-field-pulse", "--out", "b", cwd=tmp_path
    )
    assert run.returncode == 0, run.stderr
    names = {path.name for path in (tmp_path / "b").iterdir()}
    assert {f"figure_{number:02d}.png" for number in (4, 5, 6, 7, 8)} <= names
    assert {f"{name}.png" for name in FIGURES} <= names
    assert {"criteria.csv", "violators.csv", "rule.csv", "roc.csv", "study.json"} <= names
    # one page with all of it, that needs nothing but the files beside it
    page = (tmp_path / "b" / "index.html").read_text(encoding="utf-8")
    linked = set(re.findall(r'(?:src|href)="([^"]*)"', page))
    assert linked <= names
    assert {name for name in names if name.endswith(".png")} <= linked
    claims = pd.read_csv(tmp_path / "b" / "claims.csv")
    assert page.count('<td class="text yes">') == (claims["holds"] == "yes").sum()
    told = json.loads((tmp_path / "b" / "study.json").read_text())
    assert told["study"] == "boroschek-romo-2004"
    assert set(json.loads((tmp_path / "b" / "run.json").read_text())["files"]) == names
