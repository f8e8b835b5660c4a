"""Cimellaro G.P., Domaneschi M., Qu B. (2020) Overturning risk of furniture in earthquake-affected
areas, J. Vibration and Control 26(5-6):362-374: the study with the floors at hand in place of the
paper's monitored buildings.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from shaketable.study import Option, PublishedStudy, Study, StudyInput

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _run(given: StudyInput) -> Study:
    from shaketable_studies.cimellaro_2020.floors import recorded_channels, stand_ins
    from shaketable_studies.cimellaro_2020.study import run

    channels = stand_ins()
    building = given.options["building"]
    if building is not None:
        channels += recorded_channels(building, given.units, given.time_step)
    n = given.options["n"]
    return run(channels, recorded=given.motions, n=n, seed=given.seed, progress=given.progress)


def _figures(study: Study) -> Iterable[tuple[str, Figure]]:
    from shaketable_studies.cimellaro_2020.figures import figures

    return figures(study)


STUDY = PublishedStudy(
    name="cimellaro-2020",
    reference="Cimellaro G.P., Domaneschi M., Qu B. (2020) Overturning risk of furniture in "
    "earthquake-affected areas, J. Vibration and Control 26(5-6):362-374",
    summary="""Overturning risk of furniture on floors: tables 1-3, figures 2 and 5-8.

    The floors of three linear shear buildings stand in place of the paper's, beside those of a
    recorded building. Kaneko and Hayashi's formula, direct integration and the paper's surface
    are compared, the surface as printed and fitted anew. The surfaces are judged on --motions.
    """,
    run=_run,
    figures=_figures,
    options=(
        Option(
            name="building",
            kind=Path | None,
            default=None,
            help="A building besides the three: folder of floor motions, or TOML file.",
        ),
        Option(name="n", kind=int, default=100, help="Compatible motions for each floor motion."),
    ),
    takes_verticals=False,
)
