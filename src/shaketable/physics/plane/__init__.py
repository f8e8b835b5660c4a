"""The physics, once, as compiled scalar functions that any engine can drive.

A kernel is a function of scalars or NamedTuples that uses `math` only. `@kernel` inlines it, so
that loops over it vectorise: no branches on the hot path. `@routine` is for the rare paths, which
LLVM may still inline. Neither may make or return an array; `@driver_part` is for what drivers
share that does. A file opens with its table of symbols and equations.

- A driver links what it calls, which is then optimised and emitted once (`compiled.linking`).
  Drivers write into arrays and allocate nothing in a body's run, so that the same functions run
  on a GPU: `tests/engine/test_devices.py` compiles all of them to PTX, `test_uncompiled.py` runs
  them as plain Python.
- Tables of bodies are rows of numbers with the names of a NamedTuple: `layout` gives the columns
  to compiled code and a structured view to Python.
- Two ways through the same interval (`step` and `bounce` of `rocking`, `cross_interval` of
  `events`; `sliding` and `crossing`) must agree, which tests hold.
- The loops over vector lanes (`engine.lane_loop`), over a body of a batch by itself, as a thread
  of a GPU does it (`engine.single_lane`), and over one body with its history (`engine.one_loop`)
  are shared; a model gives them its own functions.
- Machine code on disk is named after a hash of the sources (`compiled.sources`): an edit
  here or in `engine` compiles both anew.

`phases` is the table of the general model: phases, the guards that end them, what may follow. A
guard is a row of the series table that `phase_series.expand` writes, in the table's order,
positive while the phase holds. What happens when it fires is in `resets`; forces decide in
`complementarity`, impulses in `impact`. `tests/physics/plane/test_phases.py` runs hundreds of cases
and holds every transition against the table. Lanes know only bodies that rock without slip, and
`sticking` must prove that of every interval; all else goes through `crossing`.
"""
