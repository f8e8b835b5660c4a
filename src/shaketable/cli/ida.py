"""`shaketable ida`: the lowest level of each motion that overturns an object."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from shaketable.cli.bodies import BodyOptions
from shaketable.cli.console import say
from shaketable.cli.options import ContactOptions, Overwrite
from shaketable.cli.shaking import MotionOptions

MOST_DRAWN = 8


def ida(
    *,
    out: Annotated[Path, typer.Option(help="Folder for the table and the picture.")],
    body_options: BodyOptions,
    motion_options: MotionOptions,
    measure: Annotated[str, typer.Option(help="PGA, PGV, SA(1.0), AvgSA(1.0), ...")] = "PGV",
    precision: Annotated[float, typer.Option(help="Relative precision of the levels.")] = 0.01,
    contact_options: ContactOptions,
    overwrite: Overwrite = False,
) -> None:
    """Run an incremental dynamic analysis: the lowest level of each motion that overturns it.

    An incremental dynamic analysis (Vamvatsikos and Cornell 2002) on a level support.
    """
    import numpy as np

    from shaketable.drawing.files import figure_of
    from shaketable.fragility import ida as analysed
    from shaketable.fragility.shown import unit_shown
    from shaketable.plot import plot_capacities
    from shaketable.report.results_folder import Picture, require_folder, write_folder
    from shaketable.report.run_log import RunLog
    from shaketable.signal import measure_named

    run_log = RunLog()
    require_folder(out, overwrite, run_log)
    contact = contact_options.contact()
    bodies = body_options.bodies()
    shaking = motion_options.required()
    runs = analysed(
        bodies, shaking.motions, measure, model=contact, precision=precision, progress=True
    )
    unit = unit_shown(measure_named(measure))
    drawn = plot_capacities(runs.isel(body=slice(0, MOST_DRAWN)), unit.factor, unit.name)
    write_folder(
        out,
        run_log.entries(),
        overwrite=overwrite,
        tables={"capacities": runs.to_dataframe().reset_index()},
        pictures=[Picture("capacities", "", figure_of(drawn))],
    )
    if len(bodies) > MOST_DRAWN:
        say(f"the first {MOST_DRAWN} of {len(bodies)} bodies; all of them are in the table")
    for k, body in enumerate(bodies[:MOST_DRAWN]):
        level = runs["capacity"].values[k].ravel()
        known = level[np.isfinite(level)]
        again = 100 * float((runs["survived"].values[k] > 0).mean())
        if known.size == 0:
            say(f"{body.name}: no motion overturns it at any level that was tried")
            continue
        low, middle, high = (unit.factor * q for q in np.quantile(known, (0.16, 0.5, 0.84)))
        say(f"{body.name}: {known.size} of {level.size} shakings overturn it, half of them from "
            f"{runs.attrs['measure']} {middle:.3g} {unit.name} on (16 to 84 %: {low:.3g} to "
            f"{high:.3g}); in {again:.0f} % it survives something stronger")  # fmt: skip
    say(f"table: {out / 'capacities.csv'} in SI; picture: {out / 'capacities.png'}")
