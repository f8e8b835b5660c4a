"""Cimellaro G.P., Domaneschi M., Qu B. (2020) Overturning risk of furniture in earthquake-affected
areas, J. Vibration and Control 26(5-6):362-374: the study with the floors at hand in place of the
paper's monitored buildings.
"""

from shaketable.studies.cimellaro_2020.floors import Channel, channels_in, channels_of, stand_ins
from shaketable.studies.cimellaro_2020.whole import run

__all__ = ["Channel", "channels_in", "channels_of", "run", "stand_ins"]
