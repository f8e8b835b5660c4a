"""The study from motions to tables."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from shaketable.motion import Motion
from shaketable.progress import Progress, meter
from shaketable.study import Study, records_in_words, table_of
from shaketable_studies.shaketable_2026_solids import direction, losses, shares
from shaketable_studies.shaketable_2026_solids.claims import claims
from shaketable_studies.shaketable_2026_solids.measures import areas
from shaketable_studies.shaketable_2026_solids.setting import MODEL, SIZES, pairs_of


def run(
    motions: Sequence[Motion],
    *,
    description: str = "",
    seed: int = 0,
    progress: Progress = True,
) -> Study:
    """Shake solids by the pairs among `motions`, and the same bodies in a plane.

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
    total = sum(part.simulations(count) for part in (direction, shares, losses))
    with meter("study", total, progress) as done:
        by_direction = direction.by_direction(pairs, done)
        cases = shares.all_falls(pairs, done)
        changed = losses.losses(pairs, done)
    controlled = direction.tilts_for_control(by_direction)
    ratios = shares.ratios(cases, pairs.weights)
    square = next(case for case in cases if case.name == "square")
    measured = areas(square, pairs)
    said = records_in_words(count, count, description, pairs.events) + ", both components together"
    return Study(
        records=said,
        tables={
            "bodies": pd.DataFrame(
                {
                    "base_m": [size.base for size in SIZES],
                    "height_m": [size.height for size in SIZES],
                }
            ),
            "direction": by_direction,
            "tilt_for_control": controlled,
            "shares": shares.share_table(cases, pairs.weights),
            "ratios": ratios,
            "losses": changed,
            "measures": measured,
            "claims": table_of(claims(controlled, ratios, measured), said),
        },
        inputs={"model": repr(MODEL), "pairs": [motion.name for motion in pairs.motions]},
    )
