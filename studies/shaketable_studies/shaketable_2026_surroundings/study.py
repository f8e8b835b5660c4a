"""The study from motions to tables."""

from __future__ import annotations

from collections.abc import Sequence

from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.study import Study, records_in_words, table_of
from shaketable_studies.shaketable_2026_solids.setting import pairs_of
from shaketable_studies.shaketable_2026_surroundings import cases, lips
from shaketable_studies.shaketable_2026_surroundings.claims import claims
from shaketable_studies.shaketable_2026_surroundings.setting import MODEL, shaken


def run(
    motions: Sequence[Motion],
    *,
    description: str = "",
    seed: int = 0,
    progress: Progress = True,
) -> Study:
    """Shake a bookcase in surroundings by the pairs among `motions`, in both directions.

    Args:
        motions: horizontal components; those of one recording are paired by their azimuths.
        description: what to call them.
        seed: of the bootstrap over events and their recordings.
        progress: as for simulate_many.

    Raises:
        InputError: there is no pair.
    """
    pairs = pairs_of(motions, seed)
    count = len(pairs.motions)
    with meter("study", cases.count_all(count) + lips.count_lips(count), progress) as done:
        free = shaken(pairs, None, done)
        walls = cases.walls(pairs, free, done)
        straps = cases.straps(pairs, free, done)
        weak = cases.weak_straps(pairs, done)
        tilts = cases.tilts(pairs, done)
        edges = lips.lips(pairs, done)
    said = records_in_words(count, count, description, pairs.events) + ", both components together"
    return Study(
        records=said,
        tables={
            "walls": walls,
            "straps": straps,
            "weak_straps": weak,
            "tilts": tilts,
            "lips": edges,
            "claims": table_of(claims(walls, straps, weak, tilts, edges), said),
        },
        inputs={"model": repr(MODEL), "pairs": [motion.name for motion in pairs.motions]},
    )
