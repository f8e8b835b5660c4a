"""Published studies done again with the motions at hand: a room per paper, a table per result.

Each room has its `STUDY`, a `shaketable.study.PublishedStudy`; `pyproject.toml` names them as entry
points, by which `shaketable study` finds them.
"""
