"""A question writes nothing: what answers yes or no and writes is named by a verb that says so."""

from __future__ import annotations

from tests.support.writers import functions, writes

#: How functions begin that answer and write; `physics.space` says what the first three do.
WRITING = (
    "try_", "judge_", "gather_", "arrest", "balance", "close_", "drop_", "keep_", "push_",
    "respond", "share_", "slip_", "solve", "turn_",
)  # fmt: skip


def test_a_question_writes_nothing() -> None:
    found = functions("physics/space")
    written = writes(found)
    assert written["put"] == {"numbers"}
    assert written["cross_interval"] == {"work", "impact_times"}
    assert written["velocity"] == set()
    asked = {name for name, each in found.items() if each.answers}
    assert len(asked) > 50
    writing = {name for name in asked if written[name]}
    assert len(writing) > 20
    assert [name for name in sorted(writing) if not name.startswith(WRITING)] == []
