"""Motions that were not recorded: pulses, spectrum-compatible motions and floor motions."""

from shaketable.synthesis.asce_7_22 import FloorProfile, profile_motions
from shaketable.synthesis.compatible import ENVELOPES, spectrum_compatible
from shaketable.synthesis.floors import ShearBuilding, floor_motions
from shaketable.synthesis.matching import match_spectrum
from shaketable.synthesis.pulses import (
    half_sine,
    mavroeidis_papageorgiou,
    one_cosine,
    one_sine,
    rectangular,
    ricker,
)
from shaketable.synthesis.targets import asce_7, eurocode_8, read_spectrum
from shaketable.synthesis.torsion import EdgeMotion, TorsionalBuilding, corner_motions, edge_motions

__all__ = [
    "ENVELOPES",
    "EdgeMotion",
    "FloorProfile",
    "ShearBuilding",
    "TorsionalBuilding",
    "asce_7",
    "corner_motions",
    "edge_motions",
    "eurocode_8",
    "floor_motions",
    "half_sine",
    "match_spectrum",
    "mavroeidis_papageorgiou",
    "one_cosine",
    "one_sine",
    "profile_motions",
    "read_spectrum",
    "rectangular",
    "ricker",
    "spectrum_compatible",
]
