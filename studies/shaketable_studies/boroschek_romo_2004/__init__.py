"""Boroschek R., Romo D. (2004) Overturning criteria for non-anchored non-symmetric rigid bodies,
13th WCEE, paper 295: the whole study, with the motions at hand in place of its 288 records.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from shaketable.study import PublishedStudy, Study, StudyInput

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _run(given: StudyInput) -> Study:
    from shaketable_studies.boroschek_romo_2004.study import run

    return run(
        given.motions,
        description=given.description,
        seed=given.seed,
        progress=given.progress,
    )


def _figures(study: Study) -> Iterable[tuple[str, Figure]]:
    from shaketable_studies.boroschek_romo_2004.figures import figures

    return figures(study)


STUDY = PublishedStudy(
    name="boroschek-romo-2004",
    reference="Boroschek R., Romo D. (2004) Overturning criteria for non-anchored non-symmetric "
    "rigid bodies, 13th World Conference on Earthquake Engineering, paper 295",
    summary="""Overturning criteria for bodies with the centre of gravity off centre: figures 4-8.

    48 symmetric bodies and 144 off centre stand under every motion in both directions. Tables tell
    how often each criterion calls safe what falls and warns of what stands, and a rule is fitted
    to what happens.
    """,
    run=_run,
    figures=_figures,
)
