"""A box on a moving support: cases with known answers, and software that is held against them.

`cases.json` holds the cases in SI units, for any software; `make` writes it, `cases` reads it.
`sliding` is the closed form of what only slides. `ours`, `with_mujoco`, `with_warp` and
`with_drake` run a case each in one software; `python -m benchmarks.moving_support` prints the table
that docs/reference/moving_support.md explains.
"""
