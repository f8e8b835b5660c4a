"""Published studies done again with the motions at hand: one paper a room, one result a table."""

from shaketable.studies.study import Study

__all__ = ["Study"]
