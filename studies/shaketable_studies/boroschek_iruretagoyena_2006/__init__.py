"""Boroschek R., Iruretagoyena A. (2006) Controlled overturning of unanchored rigid bodies,
Earthquake Engng Struct. Dyn. 35(6):695-711: the whole study, with the motions at hand in place of
the paper's 314 records.
"""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum
from typing import TYPE_CHECKING

from shaketable.study import Option, PublishedStudy, Study, StudyInput

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Models(StrEnum):
    """Which of the paper's two models."""

    ROCKING = "rocking"
    GENERAL = "general"
    BOTH = "both"


def _run(given: StudyInput) -> Study:
    from shaketable_studies.boroschek_iruretagoyena_2006.study import run

    asked = Models(given.options["model"])
    models = ("rocking", "general") if asked is Models.BOTH else (asked.value,)
    return run(
        given.motions,
        description=given.description,
        models=models,
        seed=given.seed,
        progress=given.progress,
    )


def _figures(study: Study) -> Iterable[tuple[str, Figure]]:
    from shaketable_studies.boroschek_iruretagoyena_2006.figures import figures

    return figures(study)


STUDY = PublishedStudy(
    name="boroschek-iruretagoyena-2006",
    reference="Boroschek R., Iruretagoyena A. (2006) Controlled overturning of unanchored rigid "
    "bodies, Earthquake Engng Struct. Dyn. 35(6):695-711",
    summary="""Controlled overturning by tilting: tables I, II, III, V, VI and figures 2-10, 13.

    Twelve bodies stand on supports tilted by 0 to 7°, under every motion in both directions. The
    curves GCOR and SCOR are shown as printed and fitted anew, and what the paper says stands
    beside what is found.
    """,
    run=_run,
    figures=_figures,
    options=(Option(name="model", kind=Models, default=Models.ROCKING, help="Model, or both."),),
)
