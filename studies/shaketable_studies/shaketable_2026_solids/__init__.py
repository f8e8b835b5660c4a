"""What three dimensions change: the same bodies as rectangles in a plane and as solids, the
direction of the tilt, which measure of two components predicts, cylinders beside squares.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from shaketable.study import PublishedStudy, Study, StudyInput

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _run(given: StudyInput) -> Study:
    from shaketable_studies.shaketable_2026_solids.study import run

    return run(
        given.motions,
        description=given.description,
        seed=given.seed,
        progress=given.progress,
    )


def _figures(study: Study) -> Iterable[tuple[str, Figure]]:
    from shaketable_studies.shaketable_2026_solids.figures import figures

    return figures(study)


STUDY = PublishedStudy(
    name="shaketable-2026-solids",
    reference="shaketable (2026), a study of this package: what the third dimension changes for "
    "the bodies of Boroschek & Iruretagoyena (2006)",
    summary="""Solids under both horizontal components beside rectangles in a plane.

    The twelve bodies of Boroschek & Iruretagoyena (2006) as boxes and cylinders, under pairs of
    components: how many more overturn than in a plane, whether a tilt controls the side of the
    fall in any direction, which measure of a pair tells what falls, and whether cylinders fall
    more than boxes as slender.
    """,
    run=_run,
    figures=_figures,
)
