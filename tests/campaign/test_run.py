"""Campaigns in this process: the results of one piece, kept, resumed and never mixed."""

from __future__ import annotations

import json
import logging
import os
import signal
import threading
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from shaketable import Body, General, InputError, Motion, SimulationError, simulate_many
from shaketable.campaign import arrays, beginning, open_campaign, run_campaign, sketch
from shaketable.campaign.collect import by_recording_table
from shaketable.campaign.fingerprint import motion_hash
from shaketable.campaign.motions import (
    AT_ONCE,
    KEPT,
    StoredMotions,
    save_motions,
)
from shaketable.campaign.objects import Objects
from shaketable.campaign.simulations import Simulations
from shaketable.campaign.status import status_of
from shaketable.lazy_motions import heads_of
from shaketable.resampling import events_of, recordings_of
from shaketable.simulate.checks import unique_names


def counted(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Numbers of the blocks that are simulated from now on."""
    numbers: list[int] = []
    do = Simulations.do

    def noting(work: Simulations, number: int, progress: Any) -> Any:
        numbers.append(number)
        return do(work, number, progress)

    monkeypatch.setattr(Simulations, "do", noting)
    return numbers


def test_it_is_what_one_piece_gives(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path
) -> None:
    found = run_campaign(**small, store=tmp_path / "store")
    assert found["outcome"].variable._in_memory is False  # read when it is used
    xr.testing.assert_identical(found.load(), known)
    assert {name: found[name].dtype for name in found} == {n: known[n].dtype for n in known}


def test_with_the_general_model_and_losses(p695: list[Motion], tmp_path: Path) -> None:
    bodies = [Body.rectangle(0.3, 1.0, restitution_factor=0.9), Body.rectangle(0.2, 1.0)]
    given: dict[str, Any] = {
        "bodies": bodies, "motions": p695[:4], "scales": (0.5, 1.0), "progress": False,
        "model": General(static_friction=0.3),
    }  # fmt: skip
    found = run_campaign(**given, store=tmp_path / "store", block=8)
    xr.testing.assert_identical(found.load(), simulate_many(**given))


def test_where_nothing_happens_it_is_kept_too(small: dict[str, Any], tmp_path: Path) -> None:
    """Zarr leaves out chunks of zeros unless it is told; a missing one would be a loss."""
    weak = small | {"scales": (0.01,)}
    run_campaign(**weak, store=tmp_path)
    found = run_campaign(**weak, store=tmp_path).load()
    assert not found["outcome"].any()
    assert len(list((tmp_path / "results" / "outcome" / "c").rglob("0"))) > 0


def test_only_what_is_missing_is_done(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run_campaign(**small, store=tmp_path)
    done = sorted((tmp_path / "campaign" / "done").iterdir())
    for path in done[::3]:
        path.unlink()
    numbers = counted(monkeypatch)
    found = run_campaign(**small, store=tmp_path)
    assert sorted(numbers) == [int(path.stem) for path in done[::3]]
    xr.testing.assert_identical(found.load(), known)
    del numbers[:]
    run_campaign(**small, store=tmp_path)
    assert numbers == []


@pytest.mark.parametrize("harm", ["cut", "changed", "gone"])
def test_a_damaged_chunk_is_found_and_done_again(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    harm: str, caplog: pytest.LogCaptureFixture,
) -> None:  # fmt: skip
    run_campaign(**small, store=tmp_path)
    chunk = max(
        (tmp_path / "results" / "peak_rotation" / "c").rglob("0"), key=lambda p: p.is_file()
    )
    content = chunk.read_bytes()
    if harm == "gone":
        chunk.unlink()
    else:
        chunk.write_bytes(content[:-5] if harm == "cut" else content[:-5] + b"wrong")
    if harm == "changed":  # the same length: found by the checksum
        with pytest.raises(SimulationError, match=r"is damaged, or that of another block; run"):
            open_campaign(tmp_path)
        open_campaign(tmp_path, check=False)  # sizes alone
    else:
        with pytest.raises(SimulationError, match=r"bytes, .* were written; run"):
            open_campaign(tmp_path)
    numbers = counted(monkeypatch)
    found = run_campaign(**small, store=tmp_path)
    assert len(numbers) == 1
    assert "1 of the blocks that were done are damaged" in caplog.text
    xr.testing.assert_identical(found.load(), known)


def test_chunks_that_were_swapped_are_found(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each is whole, and has the size of the other: only its block's note tells that it is not."""
    given = small | {"block": 2}
    run_campaign(**given, store=tmp_path)
    chunks: dict[tuple[str, int], Path] = {}
    for path in sorted(p for name in known for p in (tmp_path / "results" / name).rglob("c/**/*")):
        if not path.is_file():
            continue
        one = chunks.setdefault((path.parts[-7], path.stat().st_size), path)
        if one.read_bytes() != path.read_bytes():
            break
    else:
        pytest.fail("no two chunks of an array have one size and two contents")
    content, other = one.read_bytes(), path.read_bytes()
    one.write_bytes(other)
    path.write_bytes(content)
    with pytest.raises(SimulationError, match="that of another block"):
        open_campaign(tmp_path)
    numbers = counted(monkeypatch)
    found = run_campaign(**given, store=tmp_path)
    assert len(numbers) == 2
    xr.testing.assert_identical(found.load(), known)


def test_status_counts_blocks_whose_chunks_are_there(small: dict[str, Any], tmp_path: Path) -> None:
    run_campaign(**small, store=tmp_path)
    before = status_of(Objects(tmp_path))
    assert (before.blocks_done, before.damaged) == (before.blocks, 0)
    chunk = next(p for p in (tmp_path / "results" / "outcome" / "c").rglob("0") if p.is_file())
    chunk.unlink()
    told = status_of(Objects(tmp_path))
    assert (told.blocks_done, told.damaged) == (before.blocks - 1, 1)
    assert told.count_done < before.count_done


def test_motions_are_read_as_they_are_needed(
    p695: list[Motion], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Names and origins without any; a block's from their files; a few files at a time."""
    count = 6 * AT_ONCE + 3
    motions = [replace(p695[k % 5], horizontal=np.array([0.0, k, 0.0])) for k in range(count)]
    objects, read = Objects(tmp_path), []
    save_motions(motions, objects)
    get = Objects.get
    monkeypatch.setattr(Objects, "get", lambda self, name: read.append(name) or get(self, name))
    told = [head.as_dict() for head in heads_of(motions)]
    hashes = [motion_hash(motion) for motion in motions]
    stored = StoredMotions(objects, told, hashes)
    assert len(stored) == count
    assert recordings_of(stored).tolist() == recordings_of(motions).tolist()
    assert unique_names(heads_of(stored)) == unique_names(motions)
    assert read == []
    assert [m.horizontal[1] for m in stored[AT_ONCE + 1 : AT_ONCE + 4]] == [
        AT_ONCE + 1.0, AT_ONCE + 2.0, AT_ONCE + 3.0,
    ]  # fmt: skip
    assert read == ["campaign/motions/000001.npz"]
    assert [m.horizontal[1] for m in stored] == list(range(count))
    assert len(stored._read) == KEPT
    assert stored[-1].horizontal[1] == count - 1
    with pytest.raises(IndexError):
        stored[count]
    for harm, said in ((b"no zip", "damaged"), (None, "missing")):
        path = tmp_path / "campaign" / "motions" / "000000.npz"
        path.unlink() if harm is None else path.write_bytes(harm)
        with pytest.raises(SimulationError, match=said):
            StoredMotions(objects, told, hashes)[0]
    with pytest.raises(SimulationError, match="other motions"):
        StoredMotions(objects, told, hashes[::-1])[AT_ONCE]


def test_what_changed_is_named(small: dict[str, Any], tmp_path: Path) -> None:
    run_campaign(**small, store=tmp_path)
    other = [*small["bodies"][:4], replace(small["bodies"][4], base=0.31)]
    for change, said in (
        ({"bodies": other}, r"bodies: 1 of 5 differ \(body 4\)"),
        ({"motions": small["motions"][:11]}, "motions: 12 → 11"),
        ({"tilts": [0.0]}, r"tilts: \[0.0, 0.0349\d+\] → \[0.0\]"),
        ({"model": "general"}, r"model: 'Rocking\(.*→ 'General\("),
        ({"block": 30}, "blocks: cut otherwise"),
        ({"keep": "summary"}, "keep: 'all' → 'summary'"),
    ):
        with pytest.raises(InputError, match=said):
            run_campaign(**(small | change), store=tmp_path)
    fresh = run_campaign(**(small | {"tilts": [0.0]}), store=tmp_path, fresh=True)
    assert fresh.sizes["tilt"] == 1


def test_other_code_or_versions_are_refused(small: dict[str, Any], tmp_path: Path) -> None:
    run_campaign(**small, store=tmp_path)
    path = tmp_path / "campaign" / "plan.json"
    told = json.loads(path.read_text())
    told["fingerprint"]["environment"]["numba"] = "0.1"
    path.write_text(json.dumps(told))
    with pytest.raises(InputError, match=r"numba: 0\.1 → "):
        run_campaign(**small, store=tmp_path)


def test_a_folder_of_something_else_is_kept(small: dict[str, Any], tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("mine")
    with pytest.raises(InputError, match=r"holds 'thesis.txt', which is no part"):
        run_campaign(**small, store=tmp_path, fresh=True)
    assert (tmp_path / "thesis.txt").read_text() == "mine"
    with pytest.raises(InputError, match="is a file"):
        run_campaign(**small, store=tmp_path / "thesis.txt")


def test_a_bad_body_fails_its_blocks_and_the_rest_goes_on(
    small: dict[str, Any], tmp_path: Path
) -> None:
    thin = Body.rectangle(0.02, 1.0, name="thin")  # falls by itself beyond 1.1°
    given = small | {"bodies": [*small["bodies"], thin], "block": 4}
    with pytest.raises(SimulationError, match="thin: falls by itself on a support tilted by 2°"):
        run_campaign(**given, store=tmp_path)
    with pytest.raises(InputError, match="blocks are done"):
        open_campaign(tmp_path)
    found = open_campaign(tmp_path, partial=True)
    assert found["done"].sel(body="body 0").all()
    assert not found["done"].sel(body="thin").any()
    known = simulate_many(
        small["bodies"][:1], small["motions"], tilts=small["tilts"], progress=False
    )
    assert (found["outcome"].sel(body="body 0") == known["outcome"][0]).all()


def test_a_store_by_url(small: dict[str, Any], known: xr.Dataset) -> None:
    """What fsspec reaches; its file system in memory stands for an object store."""
    found = run_campaign(**small, store="memory://campaigns/one")
    xr.testing.assert_identical(found.load(), known)
    again = run_campaign(**small, store="memory://campaigns/one")
    xr.testing.assert_identical(again.load(), known)
    with pytest.raises(InputError, match="cannot be used as a store"):
        run_campaign(**small, store="nowhere://a/b")


def test_a_summary(small: dict[str, Any], known: xr.Dataset, tmp_path: Path) -> None:
    """Counts, squares and sketch equal those of every simulation."""
    found = run_campaign(**small, store=tmp_path, keep="summary", recordings=True)
    order = ("body", "tilt", "scale")
    falls = {"downhill": known["outcome"] == -1, "uphill": known["outcome"] == 1}
    by_motion = {name: one.sum("polarity") for name, one in falls.items()}
    for name, one in by_motion.items():
        assert np.array_equal(found[name], one.sum("motion").transpose(*order))
        kept = found["by_recording"].sel(direction=name).sum("recording")
        assert np.array_equal(kept, found[name])
    table = by_recording_table(found)
    assert table["falls_uphill"].sum() == found["uphill"].sum()
    row = table.set_index(["body", "tilt_deg", "scale", "recording"]).iloc[-1]
    assert row["falls_downhill"] == found["by_recording"][0, -1, -1, -1, -1]
    recording = recordings_of(small["motions"])
    for number in np.unique(recording):
        first = small["motions"][int(np.argmax(recording == number))].origin
        kept = found["by_recording"].sel(recording=f"{first.event} {first.station}")
        for name, one in by_motion.items():
            expected = one.isel(motion=recording == number).sum("motion").transpose(*order)
            assert np.array_equal(kept.sel(direction=name), expected)
    event = events_of(small["motions"])[recording]
    for level, groups in (("recording", recording), ("event", event)):
        d, u = (
            one.assign_coords(motion=groups).groupby("motion").sum() for one in by_motion.values()
        )
        here = found["moments"].sel(level=level)
        for moment, expected in (("dd", d * d), ("uu", u * u), ("du", d * u)):
            squares = expected.sum("motion").transpose(*order)
            assert np.array_equal(here.sel(moment=moment), squares)
        assert (here.sel(moment="nn") == np.square(2 * np.bincount(groups)).sum()).all()
    assert (found["peaks"].sum("bin") == 24).all()  # 12 motions, both directions


def test_the_sketch_tells_quantiles() -> None:
    rng = np.random.default_rng(0)
    values = np.exp(rng.uniform(np.log(1e-3), np.log(1.0), 10001))
    counts = np.bincount(sketch.bins_of(values, np.zeros(values.size, bool)), minlength=sketch.BINS)
    for share in (0.1, 0.5, 0.9):
        exact = np.quantile(values, share)
        # half a bin, and the step from one of 10,000 values to the next
        assert sketch.quantile(counts, share) == pytest.approx(exact, rel=sketch.ACCURACY + 1e-3)
    assert sketch.bins_of([0.0, 1e-5, 2.0], [False, False, True]).tolist() == [
        0,
        0,
        sketch.BINS - 1,
    ]
    assert np.isnan(sketch.quantile(np.zeros(sketch.BINS), 0.5))


def test_too_little_room_is_told_before_anything_is_done(
    small: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(beginning.shutil, "disk_usage", lambda place: type("D", (), {"free": 100}))
    numbers = counted(monkeypatch)
    with pytest.raises(InputError, match="kB are needed and 100 bytes are free"):
        run_campaign(**small, store=tmp_path)
    assert numbers == []


def test_ctrl_c_stops_at_the_end_of_a_block(
    small: dict[str, Any], known: xr.Dataset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:  # fmt: skip
    do = Simulations.do
    numbers: list[int] = []

    def interrupted(work: Simulations, number: int, progress: Any) -> Any:
        numbers.append(number)
        if len(numbers) == 2:
            os.kill(os.getpid(), signal.SIGINT)
        return do(work, number, progress)

    monkeypatch.setattr(Simulations, "do", interrupted)
    with caplog.at_level(logging.WARNING), pytest.raises(KeyboardInterrupt):
        run_campaign(**small, store=tmp_path)
    assert "stops at the end of this block" in caplog.text
    assert len(list((tmp_path / "campaign" / "done").iterdir())) == 2  # the second one is kept
    found = run_campaign(**small, store=tmp_path)
    assert len(numbers) == len(set(numbers))
    xr.testing.assert_identical(found.load(), known)


def test_the_chunks_of_a_block_are_written_at_once(
    small: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each waits until all have begun: one after the other none would end."""
    opened = arrays.opened

    class Slow:
        """An array whose writes wait for those of the others."""

        def __init__(self, array: Any, together: threading.Barrier) -> None:
            self.array, self.together = array, together

        def __getattr__(self, name: str) -> Any:
            return getattr(self.array, name)

        def __setitem__(self, region: Any, values: Any) -> None:
            self.together.wait(timeout=20.0)
            self.array[region] = values

    def slow(*given: Any) -> dict[str, Any]:
        found = opened(*given)
        together = threading.Barrier(len(found))
        return {name: Slow(array, together) for name, array in found.items()}

    with monkeypatch.context() as patched:
        patched.setattr(arrays, "opened", slow)
        run_campaign(**small, store=tmp_path / "store")
    assert open_campaign(tmp_path / "store").sizes["body"] == len(small["bodies"])
