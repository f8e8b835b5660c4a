"""The folder of a command's results: whole or not at all, and never in place of something else."""

from __future__ import annotations

import json
import logging
from pathlib import Path

import pandas as pd
import pytest
from matplotlib.figure import Figure

from shaketable.errors import ADDS_UP, InputError
from shaketable.report.results_folder import Picture, require_folder, write_folder
from shaketable.report.run_log import RunLog

TABLE = pd.DataFrame({"a": [1.0, 2.0]})


def test_messages_that_count_add_up() -> None:
    """Each set of simulations tells its own; a page shows the sum, and in how many sets."""
    log = logging.getLogger("shaketable.anything")
    with RunLog(["shaketable", "test"]) as kept:
        for count in (3, 4):
            log.warning("%d of %d simulations %s", count, 10, "fell asleep", extra={ADDS_UP: True})
        log.warning("%d of %d simulations %s", 1, 10, "woke up", extra={ADDS_UP: True})
        for _ in range(2):
            log.warning("%d of %d motions are short", 2, 5)
    assert kept.messages == [
        "WARNING: 2 of 5 motions are short",
        "WARNING: 7 of 20 simulations fell asleep (in 2 sets of simulations)",
        "WARNING: 1 of 10 simulations woke up",
    ]


def write(folder: Path, *, overwrite: bool = False, name: str = "rows") -> list[str]:
    return write_folder(
        folder,
        {"command": "shaketable test"},
        overwrite=overwrite,
        tables={name: TABLE, "both": TABLE},
        parquet=["both"],
        pictures=[Picture("one", "What is seen.", Figure())],
        page=lambda pictures: f"<p>{pictures[0]['file']}: {pictures[0]['caption']}",
        others=lambda fresh: (fresh / "other.txt").write_text("mine"),
    )


def test_everything_is_written_and_listed(tmp_path: Path) -> None:
    names = write(tmp_path / "out")
    assert names == [
        "both.csv", "both.parquet", "index.html", "one.png", "other.txt", "rows.csv", "run.json",
    ]  # fmt: skip
    assert names == sorted(path.name for path in (tmp_path / "out").iterdir())
    told = json.loads((tmp_path / "out" / "run.json").read_text())
    assert told == {"command": "shaketable test", "files": names}
    assert (tmp_path / "out" / "index.html").read_text() == "<p>one.png: What is seen."
    assert (tmp_path / "out" / "rows.csv").read_text() == "a\n1\n2\n"


def test_earlier_results_are_replaced_if_that_is_wanted(tmp_path: Path) -> None:
    write(tmp_path / "out", name="old")
    with pytest.raises(InputError, match="--overwrite to replace its results"):
        write(tmp_path / "out")
    write(tmp_path / "out", overwrite=True)
    assert not (tmp_path / "out" / "old.csv").exists()


@pytest.mark.parametrize("listed", ["", "[1", '{"files": 3}', '{"files": ["run.json"]}', None])
def test_what_is_not_listed_is_not_replaced(tmp_path: Path, listed: str | None) -> None:
    """A list that cannot be read lists nothing but itself."""
    write(tmp_path / "out")
    run = tmp_path / "out" / "run.json"
    run.unlink() if listed is None else run.write_text(listed)
    with pytest.raises(InputError, match=r"holds '(both|run).*', which is not a result of this"):
        require_folder(tmp_path / "out", True, RunLog(["shaketable", "test"]))
    write(tmp_path / "new")
    (tmp_path / "new" / "thesis.txt").write_text("mine")
    with pytest.raises(InputError, match=r"holds 'thesis.txt'"):
        write(tmp_path / "new", overwrite=True)
    assert (tmp_path / "new" / "thesis.txt").read_text() == "mine"


def test_results_of_another_command_are_not_replaced(tmp_path: Path) -> None:
    """`assess --out` with the folder of a long `fragility` by mistake."""
    write(tmp_path / "out")
    require_folder(tmp_path / "out", True, RunLog(["shaketable", "test", "--faster"]))
    with pytest.raises(InputError, match=r"holds 'both.csv', which is not a result of this"):
        require_folder(tmp_path / "out", True, RunLog(["shaketable", "another"]))


def test_a_failure_leaves_nothing(tmp_path: Path) -> None:
    def fail(pictures: object) -> str:
        raise RuntimeError

    with pytest.raises(RuntimeError):
        write_folder(tmp_path / "out", {}, tables={"rows": TABLE}, page=fail)
    assert list(tmp_path.iterdir()) == []
