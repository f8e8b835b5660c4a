"""By what the objects of one place are shaken: both horizontal components at once, or one."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from typing import NamedTuple

from shaketable.assess.classes import FEWEST_RECORDINGS
from shaketable.errors import named, quoted
from shaketable.motion import Motion
from shaketable.resampling import recordings_of
from shaketable.simulate import listed

log = logging.getLogger(__name__)

MOST_NAMED = 10


class Shaking(NamedTuple):
    """The motions of one place.

    Attributes:
        pairs: those with both horizontal components, by which solids are shaken; empty where
            everything is shaken in a plane.
        components: each horizontal component by itself: of the pairs, if there are any, so that
            solids and planar bodies are shaken by the same recordings.
    """

    pairs: Sequence[Motion]
    components: Sequence[Motion]

    @classmethod
    def of(cls, motions: Sequence[Motion], planar: bool) -> Shaking:
        """What of some motions is used.

        Where both components are known of FEWEST_RECORDINGS independent recordings or more, or of
        all that there are, motions with one component are left out.

        Args:
            motions: some.
            planar: whether everything is to be shaken in a plane.

        Raises:
            InputError: no motions.
        """
        every = list(listed("motions", motions, Motion))
        pairs = [] if planar else [each for each in every if each.transverse is not None]
        if pairs and len(pairs) < len(every):
            there, known = _recordings(every), _recordings(pairs)
            if known < min(FEWEST_RECORDINGS, there):
                log.warning(
                    "shaken in a plane alone: both horizontal components are known of %d of %d "
                    "independent recordings, and %d are needed to decide",
                    known, there, FEWEST_RECORDINGS,
                )  # fmt: skip
                pairs = []
            else:
                alone = [quoted(each.name) for each in every if each.transverse is None]
                log.warning(
                    "%d motions are left out, as the second component of their recording, or its "
                    "direction, is not known: %s",
                    len(alone), named(alone, MOST_NAMED),
                )  # fmt: skip
        parts = [part for motion in pairs or every for part in motion.components()]
        return cls(pairs, parts)


def _recordings(motions: Sequence[Motion]) -> int:
    return int(recordings_of(motions).max()) + 1
