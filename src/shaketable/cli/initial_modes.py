"""`shaketable initial-modes`: how an object at rest begins to move."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from shaketable.body import Body
from shaketable.cli.console import say
from shaketable.cli.options import BaseM, Eccentricity, HeightM, KineticFriction
from shaketable.criteria.psycharis_1990 import StackMode, stack_borders
from shaketable.criteria.shenton_1996 import Mode, shape_of, thresholds
from shaketable.errors import InputError
from shaketable.models import General
from shaketable.units import STANDARD_GRAVITY

STACKED = {
    StackMode.UPPER: "the upper rocks alone",
    StackMode.WHOLE: "both rock as one",
    StackMode.SAME_WAY: "both rock, the upper on the lower the same way",
    StackMode.AGAINST: "both rock, the upper against the lower",
}
WORDS = {Mode.SLIDE: "slides", Mode.ROCK: "rocks", Mode.SLIDE_ROCK: "slides and rocks"}


def initial_modes(
    base_m: BaseM,
    height_m: HeightM,
    static_friction: Annotated[float, typer.Option(help="Static friction of the support.")],
    kinetic_friction: KineticFriction = None,
    eccentricity: Eccentricity = 0.5,
    mass_kg: Annotated[
        float | None, typer.Option(help="Mass [kg], which a stack of two asks for.")
    ] = None,
    upper_base_m: Annotated[
        float | None, typer.Option(help="Base [m] of an object that stands on it.")
    ] = None,
    upper_height_m: Annotated[float | None, typer.Option(help="Its height [m].")] = None,
    upper_mass_kg: Annotated[float | None, typer.Option(help="Its mass [kg].")] = None,
    out: Annotated[Path, typer.Option(help="Picture to write.")] = Path("modes.png"),
) -> None:
    """Find how an object at rest begins to move: it slides, rocks or does both.

    Borders are by Shenton (1996), for an object off centre by Boroschek and Romo (2004), with
    points simulated by the general model over them; level support, no vertical motion. Of a stack
    of two it says how that begins to rock, after Psycharis (1990), without slip.
    """
    from matplotlib.figure import Figure

    from shaketable.modes import map_modes
    from shaketable.plot import plot_modes, require_picture, save

    upper = {
        "--upper-base-m": upper_base_m,
        "--upper-height-m": upper_height_m,
        "--upper-mass-kg": upper_mass_kg,
        "--mass-kg": mass_kg,
    }
    missing = [name for name, value in upper.items() if value is None]
    if 0 < len(missing) < len(upper):
        raise InputError(f"{', '.join(missing)}: a stack of two needs all of {', '.join(upper)}")
    require_picture(out)
    model = General(static_friction=static_friction, kinetic_friction=kinetic_friction)
    kinetic = model.sliding_friction
    body = Body.rectangle(
        base_m, height_m, eccentricity=eccentricity, name=f"{base_m:g} m × {height_m:g} m"
    )
    directions = (1,) if eccentricity == 0.5 else (1, -1)
    ratio = kinetic / static_friction if static_friction else 1.0
    maps = [
        map_modes(body, direction, friction=static_friction, kinetic_ratio=ratio)
        for direction in directions
    ]
    figure = Figure(figsize=(6.6 * len(maps), 5.0), layout="constrained")
    axes = figure.subplots(1, len(maps), squeeze=False)[0]
    for ax, each in zip(axes, maps, strict=True):
        plot_modes(each, static_friction, ax)
    save(axes[0], out)
    for direction in directions:
        toward = "" if len(directions) == 1 else f" toward {'+x' if direction > 0 else '-x'}"
        steps = thresholds(static_friction, kinetic, *shape_of(body, direction))
        said = ", ".join(f"{WORDS[mode]} above {limit:.3g} g" for mode, limit in steps)
        say(f"{body.name} with friction {static_friction:g}{toward}: rests, then {said}")
    if upper_base_m is not None and upper_height_m is not None:
        say(
            stack_sentence(
                Body.rectangle(base_m, height_m, mass=mass_kg, eccentricity=eccentricity),
                Body.rectangle(upper_base_m, upper_height_m, mass=upper_mass_kg),
            )
        )
    say(f"map: {out}")


def stack_sentence(lower: Body, upper: Body) -> str:
    """How a stack of two begins to rock, in words.

    Raises:
        InputError: a lower body off centre.
    """
    said = ", ".join(
        f"{STACKED[mode]} above {border / STANDARD_GRAVITY:.3g} g"
        for mode, border in stack_borders(lower, upper)
    )
    return (
        f"with {upper.base:g} m × {upper.whole_height:g} m, {upper.mass:g} kg, on it, without "
        f"slip: rests, then {said}; how a stack moves on is not simulated"
    )
