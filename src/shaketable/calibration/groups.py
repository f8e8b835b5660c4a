"""Tests that belong together: their motions are scaled copies of one another."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from shaketable.motion import Motion

ALIKE = 0.8  # correlation, at the best shift, of motions that are copies of one another
STEP = 0.1  # s: coarse enough to be blind to noise of a table at high frequencies
LONGEST_SHIFT = 10.0  # s


def copies(motions: Sequence[Motion]) -> NDArray[np.intp]:
    """A number for each motion, from 0, the same for motions that are scaled copies.

    A shake table's motion is never an exact copy: two motions belong together if their
    accelerations, averaged over STEP, correlate by ALIKE or more at the best shift in time and with
    either sign, directly or by way of others.
    """
    from scipy.fft import irfft, next_fast_len, rfft
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    unique = list(dict.fromkeys(motions))
    series = [_coarse(motion) for motion in unique]
    count = next_fast_len(max(one.size for one in series) + int(LONGEST_SHIFT / STEP), real=True)
    spectra = rfft(np.stack([np.pad(one, (0, count - one.size)) for one in series]), axis=1)
    shifts = int(LONGEST_SHIFT / STEP)
    pairs = []
    for k in range(len(series)):
        found = irfft(spectra[k] * spectra[k:].conj(), count, axis=1)
        best = np.abs(np.concatenate([found[:, : shifts + 1], found[:, -shifts:]], axis=1)).max(1)
        pairs += [(k, k + int(other)) for other in np.flatnonzero(best >= ALIKE)]
    rows, columns = np.array(pairs).T if pairs else np.empty((2, 0), np.intp)
    linked = coo_array((np.ones(rows.size), (rows, columns)), shape=(len(series), len(series)))
    _, label = connected_components(linked, directed=False)
    number = dict(zip(unique, label.tolist(), strict=True))
    found_of = [number[motion] for motion in motions]
    in_order = {old: new for new, old in enumerate(dict.fromkeys(found_of))}
    return np.array([in_order[old] for old in found_of], np.intp)


def _coarse(motion: Motion) -> NDArray[np.float64]:
    """Acceleration averaged over STEP, of unit norm; zeros for a motion that is at rest."""
    ends = np.arange(0.0, motion.duration + STEP, STEP)
    sums = np.concatenate([[0.0], np.cumsum(motion.horizontal)]) * motion.time_step
    times = np.arange(sums.size) * motion.time_step
    means = np.diff(np.interp(ends, times, sums))
    size = np.linalg.norm(means)
    return np.asarray(means / size if size else means)
