"""`shaketable study`: what its options hand to the studies, which are tested by themselves."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from shaketable.errors import InputError
from shaketable.study import StudyInput, installed_studies
from tests.support.command import shaketable
from tests.support.record_files import write_at2

#: Words that are given beside the plain call, and what of the study's input they change.
SHARED = {
    "--motions": ("--motions other/bare.csv", "motions"),
    "--vertical": ("--vertical", "vertical"),
    "--units": ("--units m/s2", "motions"),
    "--time-step-s": ("--time-step-s 0.02", "time_step"),
    "--seed": ("--seed 5", "seed"),
}
OWN = {
    "boroschek-iruretagoyena-2006": {"--model": ("--model both", "options")},
    "boroschek-romo-2004": {},
    "cimellaro-2020": {
        "--building": ("--building house.toml", "options"),
        "--n": ("--n 7", "options"),
    },
    "shaketable-2026-solids": {},
    "shaketable-2026-surroundings": {},
}


@pytest.fixture
def given() -> Iterator[list[StudyInput]]:
    """What the studies are given; they do nothing with it."""
    found: list[StudyInput] = []

    def do(study_input: StudyInput) -> None:
        found.append(study_input)
        raise InputError("that is all")

    kept = {name: published.do for name, published in installed_studies().items()}
    for published in installed_studies().values():
        object.__setattr__(published, "do", do)
    yield found
    for name, published in installed_studies().items():
        object.__setattr__(published, "do", kept[name])


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    t = 0.01 * np.arange(200)
    for name, size in (("some", 1.0), ("other", 2.0)):
        (tmp_path / name).mkdir()
        for code in ("090", "UP"):
            write_at2(tmp_path / name, f"RSN1_A-{code}.AT2", code, size * np.sin(5 * t))
        rows = "\n".join(f"{size * x:.6f}" for x in np.sin(5 * t))
        (tmp_path / name / "bare.csv").write_text(f"acceleration\n{rows}\n")
    (tmp_path / "house.toml").write_text('name = "House"\nstoreys = 2\nfirst_period_s = 0.3\n')
    return tmp_path


def parts(study_input: StudyInput) -> dict[str, object]:
    motions = study_input.motions
    return {
        "motions": [abs(motion.horizontal).max() for motion in motions],
        "vertical": [motion.vertical is not None for motion in motions],
        "time_step": [motion.time_step for motion in motions],
        "seed": study_input.seed,
        "options": {name: str(value) for name, value in study_input.options.items()},
    }


@pytest.mark.parametrize(
    ("name", "option"),
    [
        (name, option)
        for name, published in installed_studies().items()
        for option in (*SHARED, *OWN[name])
        if option != "--vertical" or published.takes_verticals
    ],
)
def test_its_options_reach_the_study(
    folder: Path, given: list[StudyInput], name: str, option: str
) -> None:
    words, changes = (SHARED | OWN[name])[option]
    records = "some" if option == "--vertical" else "some/bare.csv"
    plain = {"--motions": records, "--units": "g", "--time-step-s": "0.01"}
    before = " ".join(f"{flag} {value}" for flag, value in plain.items())
    after = {flag: value for flag, value in plain.items() if flag != option}
    shaketable("study", name, "--out", "out", *before.split(), cwd=folder)
    rest = " ".join(f"{flag} {value}" for flag, value in after.items())
    shaketable("study", name, "--out", "out", *rest.split(), *words.split(), cwd=folder)
    one, other = map(parts, given)
    assert one["motions"]
    assert {part for part in one if one[part] != other[part]} == {changes}
