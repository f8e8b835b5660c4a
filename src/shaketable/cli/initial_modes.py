"""`shaketable initial-modes`: how an object at rest begins to move."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from shaketable.body import Body
from shaketable.cli.console import say
from shaketable.cli.options import Eccentricity, HeightM, KineticFriction, WidthM
from shaketable.criteria.shenton_1996 import Mode, shape_of, thresholds
from shaketable.models import General

WORDS = {Mode.SLIDE: "slides", Mode.ROCK: "rocks", Mode.SLIDE_ROCK: "slides and rocks"}


def initial_modes(
    width_m: WidthM,
    height_m: HeightM,
    static_friction: Annotated[float, typer.Option(help="Static friction of the support.")],
    kinetic_friction: KineticFriction = None,
    eccentricity: Eccentricity = 0.5,
    out: Annotated[Path, typer.Option(help="Picture to write.")] = Path("modes.png"),
) -> None:
    """How an object begins to move: it rests, slides, rocks or does both.

    Borders are by Shenton (1996), for an object off centre by Boroschek and Romo (2004), with
    points simulated by the general model over them; level support, no vertical motion.
    """
    from matplotlib.figure import Figure

    from shaketable.modes import map_modes
    from shaketable.plot import plot_modes, require_picture, save

    require_picture(out)
    model = General(static_friction=static_friction, kinetic_friction=kinetic_friction)
    kinetic = model.sliding_friction
    body = Body.rectangle(
        width_m, height_m, eccentricity=eccentricity, name=f"{width_m:g} m × {height_m:g} m"
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
    say(f"map: {out}")
