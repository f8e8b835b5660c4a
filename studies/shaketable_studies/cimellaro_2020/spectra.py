"""A floor's spectrum and those of motions compatible with it (figure 5)."""

from __future__ import annotations

import numpy as np
import pandas as pd

from shaketable.risk import TOLERANCE, compatible_motions
from shaketable.signal import response_spectrum
from shaketable_studies.cimellaro_2020.floors import Channel

PERIODS = np.geomspace(0.04, 3.5, 120)


def spectra_table(channel: Channel, n: int, seed: int) -> pd.DataFrame:
    """Pseudo-acceleration [m/s²] at PERIODS of the floor and of `n` compatible motions."""
    motions = compatible_motions(channel.motion, n, seed, TOLERANCE, lambda more: None)
    columns = {
        "period_s": PERIODS,
        "floor_m_s2": response_spectrum(channel.motion, PERIODS).acceleration,
    }
    for k, motion in enumerate(motions, 1):
        columns[f"compatible_{k}_m_s2"] = response_spectrum(motion, PERIODS).acceleration
    return pd.DataFrame(columns).assign(channel=f"{channel.building}, {channel.name}")
