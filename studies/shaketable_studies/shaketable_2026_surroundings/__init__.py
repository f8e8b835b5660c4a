"""What walls and straps change: a bookcase alone, at a wall, held by straps that hold or break, and
tilted toward a wall that catches it.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from shaketable.study import PublishedStudy, Study, StudyInput

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _run(given: StudyInput) -> Study:
    from shaketable_studies.shaketable_2026_surroundings.study import run

    return run(
        given.motions,
        description=given.description,
        seed=given.seed,
        progress=given.progress,
    )


def _figures(study: Study) -> Iterable[tuple[str, Figure]]:
    from shaketable_studies.shaketable_2026_surroundings.figures import figures

    return figures(study)


STUDY = PublishedStudy(
    name="shaketable-2026-surroundings",
    reference="shaketable (2026), a study of this package: what walls and straps change for a "
    "bookcase, and the idea of Boroschek & Iruretagoyena (2006) with the wall really there",
    summary="""A bookcase beside a wall, in straps, and tilted toward the wall.

    A bookcase of 0.32 x 0.90 x 1.80 m under pairs of components: whether a wall helps, by its gap
    and restitution; what force straps bear, by stiffness and slack; whether a strap that breaks
    does harm; and how many are caught by a wall toward which the bookcase is tilted.
    """,
    run=_run,
    figures=_figures,
)
