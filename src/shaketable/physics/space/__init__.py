"""Solids in three dimensions: compiled scalar physics, and the drivers around it.

The rules are those of `physics.plane`. A solid is one record, what its run writes to another
(SOLID_RECORD and WORKSPACE): one pointer at every call, where a NamedTuple of many numbers would be
copied. `workspace` says of each field its unit, what it means and who writes it; read it first.

`run.run` takes a solid through a motion and on until it rests, has fallen or is given up;
`interval.cross_interval` takes it through one sample:

    at rest --- the ground moves it (rest_ends) ---> choose ---> step ---> no guard: step on
       ^                                               ^           |
       |                                               |           +--> a force ends, the edge is
       |                                               |           |    passed: choose
       +--- comes_to_rest                              +--- land <-+--> a gap closes, a wall is met
                                                                   +--> it has fallen: the end

All that a solid touches is one list: points on the support first, then on walls and at the edge of
the support; what is closed is an index set of it. `choice.choose_on_support` finds the contact mode
of those on the support. It takes the first of these that is admissible: all as they move
(`try_simple`), a flat base that begins to slide (`try_slide`), a side that does (`try_side_slip`),
points of unlike friction (`try_grip`), all of them as one complementarity problem
(`solve_together`). Where walls, or the edge of the support, may be touched `beside` asks likewise
of the whole list.

A question writes nothing. What answers yes or no and writes begins with a verb that says what:
`try_...` the mode that it asks about, `judge_...` reactions and `judged`, `gather_...` a list.

| files | what they find |
|---|---|
| `touches`, `closing` | the list, and what of it is closed |
| `contacts`, `walls`, `edge` | what is near: gaps, levers, velocities |
| `modes`, `constraints`, `short_ways`, `flat_slip`, `walled` | reactions and rates in a mode |
| `cones`, `bracing` | how much friction is left, where touches press against one another as well |
| `complementarity` | reactions of all touches together: forces and impulses |
| `choice`, `grip` | which mode follows on the support alone |
| `beside`, `tries`, `holding` | which mode follows with all that is touched |
| `step`, `rates` | one step, and the rates that it needs |
| `guards`, `events` | what ends a mode, and when within a step |
| `impact` | velocities after a landing, or a blow on a wall |
| `landing` | what touches when something lands, is struck or passes the edge |
| `rest`, `rest_flat`, `rest_beside` | whether pressure and friction bear it at rest, how long |
| `settling` | time stepping, where no mode is admissible |
| `noting` | what is noted after a step: peaks, turns, how far it came |
| `in_plane` | what a deep body that stands for a planar one keeps |
| `straps`, `pads`, `losses` | pulls, glue, rolling and turning |
| `ground` | the motion as a force, seen from a tilted support |
| `ending`, `found`, `telling` | how a run ends; the record of what is told, and who writes it |
"""
