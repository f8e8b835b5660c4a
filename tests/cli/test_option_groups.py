"""Groups of options."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import pytest
import typer
from typer.testing import CliRunner

from shaketable.cli.option_groups import settings_of, with_groups
from shaketable.cli.options import ContactOfShapeOptions, ContactOptions, ModelWord
from shaketable.errors import InputError
from shaketable.models import General, Rocking


@dataclass(frozen=True)
class Sizes:
    width: Annotated[float, typer.Option(help="Its width.")]
    height: Annotated[float, typer.Option(help="Its height.")] = 2.0


def command(*, first: int = 1, sizes: Sizes, last: str = "z") -> None:
    """What it does."""
    typer.echo(f"{settings_of(locals())}")


def test_options_of_a_group_stand_where_it_does() -> None:
    app = typer.Typer()
    app.command()(with_groups(command))
    said = CliRunner().invoke(app, ["--width", "3", "--last", "y"])
    assert said.exit_code == 0
    assert said.stdout == "{'first': 1, 'height': 2.0, 'last': 'y', 'width': 3.0}\n"
    helped = CliRunner().invoke(app, ["--help"]).stdout
    places = [helped.index(f"--{name}") for name in ("first", "width", "height", "last")]
    assert places == sorted(places)
    assert "What it does." in helped
    assert CliRunner().invoke(app, []).exit_code == 2  # the width has no default


def test_contact_options_make_a_model() -> None:
    assert ContactOptions().contact() == Rocking()
    slides = ContactOptions(model=ModelWord.GENERAL, static_friction=0.4, kinetic_friction=0.3)
    assert slides.contact() == General(static_friction=0.4, kinetic_friction=0.3)
    assert ContactOfShapeOptions().contact(solid=True) == General()
    assert ContactOfShapeOptions().contact(solid=False) == Rocking()
    for name in ("static_friction", "kinetic_friction", "normal_restitution"):
        option = f"--{name.replace('_', '-')}"
        with pytest.raises(InputError, match=f"{option}: only --model general slides"):
            ContactOptions(**{name: 0.1}).contact()
