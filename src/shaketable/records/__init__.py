"""Motions from files and suites, with one reader per format."""

from shaketable.records.component import Component
from shaketable.records.motion_list import Suite
from shaketable.records.motions import read_motion
from shaketable.records.read import read_components
from shaketable.records.suites import SUITES, suite

__all__ = ["SUITES", "Component", "Suite", "read_components", "read_motion", "suite"]
