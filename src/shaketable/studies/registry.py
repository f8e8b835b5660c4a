"""All studies; the command line makes a command of each."""

from __future__ import annotations

from shaketable.studies.boroschek_iruretagoyena_2006 import (
    STUDY as BOROSCHEK_IRURETAGOYENA_2006,
)
from shaketable.studies.boroschek_romo_2004 import STUDY as BOROSCHEK_ROMO_2004
from shaketable.studies.cimellaro_2020 import STUDY as CIMELLARO_2020
from shaketable.studies.shaketable_2026_solids import STUDY as SHAKETABLE_2026_SOLIDS
from shaketable.studies.study import PublishedStudy

STUDIES: dict[str, PublishedStudy] = {
    study.name: study
    for study in (
        BOROSCHEK_IRURETAGOYENA_2006,
        BOROSCHEK_ROMO_2004,
        CIMELLARO_2020,
        SHAKETABLE_2026_SOLIDS,
    )
}
