"""Solids in three dimensions: compiled scalar physics, and the drivers around it.

The rules are those of `physics.plane`. A solid and what its run writes to are records (SOLID_RECORD
and WORKSPACE of `workspace`): one pointer at every call, where a NamedTuple of many numbers would
be copied. `run` takes a solid through a motion, `interval` through one sample of it, event by
event; `choice` finds the contact mode, `constraints` and `complementarity` the reactions, `impact`
what a landing does, `settling` what time stepping does where nothing else goes on.
"""
