"""The options of the contact model arrive in the simulations of every command that has them."""

from __future__ import annotations

from pathlib import Path

import pytest
import typer

from shaketable import General
from shaketable.cli import app

BODY = ("--base-m", "0.32", "--height-m", "1.8")
MOTIONS = ("--motions", "fema-p695-near-field-pulse")
#: What each command needs beside them; one that is missing here fails.
NEEDED = {
    "simulate": (*BODY, "--record", "record.csv"),
    "assess": ("list.csv", *MOTIONS, "--planar", "--out", "out"),
    "tilt": (*BODY, *MOTIONS, "--tilt-deg", "2"),
    "fragility": (*BODY, *MOTIONS, "--out", "out"),
    "hazard": ("curve.csv", "list.csv", *MOTIONS, "--out", "out"),
    "scenario": (
        "list.csv", "--magnitude", "7", "--distance-km", "20", "--vs30", "400", *MOTIONS,
        "--out", "out",
    ),
    "ida": (*BODY, *MOTIONS, "--out", "out"),
    "overturning-spectrum": (*BODY, "--points", "2", "--out", "out"),
}  # fmt: skip
OPTIONS = {
    "static_friction": 0.41,
    "kinetic_friction": 0.37,
    "normal_restitution": 0.13,
    "restitution_factor": 0.93,
}


class Reached(Exception):  # noqa: N818  it is no error
    """A simulation was begun with a model."""


def commands_with(option: str) -> list[str]:
    """Commands that have an option, by their own lists."""
    group = typer.main.get_command(app)
    commands = getattr(group, "commands")  # noqa: B009  typer's own type has none
    return [
        name
        for name, command in commands.items()
        if any(parameter.name == option for parameter in getattr(command, "params", ()))
    ]


def test_every_command_with_a_model_is_looked_at() -> None:
    simulating = set(commands_with("model"))
    for option in OPTIONS:  # modes has frictions of its own, and no simulation by a model
        assert set(commands_with(option)) - simulating <= {"initial-modes"}, option
    assert simulating == set(NEEDED)


@pytest.mark.filterwarnings("ignore::ResourceWarning")  # pygmm leaves its files open
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize(
    "command",
    [pytest.param(each, marks=[pytest.mark.slow] * (each == "scenario")) for each in NEEDED],
)
def test_they_arrive(command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "list.csv").write_text("name,depth_m,width_m,height_m\nshelf,0.32,0.9,1.8\n")
    (tmp_path / "curve.csv").write_text("PGV [cm/s],annual rate\n10,0.015\n80,0.0004\n")
    rows = "\n".join(f"{0.01 * k:.2f},{0.3 * (-1) ** (k // 20):.1f}" for k in range(200))
    (tmp_path / "record.csv").write_text(f"time_s,acceleration_g\n{rows}\n")
    monkeypatch.chdir(tmp_path)
    seen: list[General] = []

    def reached(self: General, *_: object) -> None:
        seen.append(self)
        raise Reached

    for name in ("run_one", "run_many"):
        monkeypatch.setattr(General, name, reached)
    given = ["--model", "general"]
    has = [option for option in OPTIONS if command in commands_with(option)]
    assert has, "a command with --model has no option of it"
    for option in has:
        given += [f"--{option.replace('_', '-')}", f"{OPTIONS[option]}"]
    with pytest.raises(Reached):
        app([command, *NEEDED[command], *given], prog_name="shaketable", standalone_mode=False)
    for option in has:
        assert getattr(seen[0], option) == OPTIONS[option], option
