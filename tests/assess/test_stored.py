"""Assessments in pieces: what `assess` finds at once, kept and gone on with."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest

from shaketable import InputError, Motion, SimulationError, assess, open_campaign
from shaketable.assess import stored
from shaketable.assess.record import from_json, to_json
from shaketable.assess.stored import ReportJob, read_report, run_report
from shaketable.inventory import Item, read_inventory
from shaketable.models import Rocking
from tests.support.command import refused, shaketable

pytest.importorskip("zarr", reason="the extra campaign is not installed: pip install '.[campaign]'")

HOSPITAL = Path(__file__).parents[2] / "examples" / "hospital.csv"


@pytest.fixture
def job(p695: list[Motion]) -> ReportJob:
    """Seven kinds of object in pieces of three, some on castors."""
    items: list[Item] = [item for item in read_inventory(HOSPITAL) if not item.anchored]
    given = {"motions": p695[:30], "scale": 1.0, "tilt": 0.0, "model": Rocking()}
    return ReportJob(items=items[8:15], **given, piece_size=3)


def test_pieces_are_what_is_found_at_once(job: ReportJob, tmp_path: Path) -> None:
    run_report(job, tmp_path, progress=False)
    found, _, _ = read_report(stored.Objects(tmp_path))
    once = assess(job.items, job.motions, progress=False)
    pd.testing.assert_frame_equal(found.table, once.table)
    assert [one.number for one in found.results] == [1, 2, 3, 4, 5, 6, 7]
    assert found.floors[0].motions == once.floors[0].motions
    assert repr(found.results[0].curves) == repr(once.results[0].curves)
    again = from_json(to_json(once.results[0]))
    assert again.profile == once.results[0].profile


def test_only_what_is_missing_is_done(
    job: ReportJob, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run_report(job, tmp_path, progress=False)
    pieces = sorted((tmp_path / "results" / "items").iterdir())
    assert len(pieces) == 3
    pieces[0].unlink()
    pieces[1].write_bytes(pieces[1].read_bytes()[:-9])
    with pytest.raises(InputError, match="pieces or more are done"):
        read_report(stored.Objects(tmp_path))
    done: list[int] = []
    piece = ReportJob.piece
    monkeypatch.setattr(
        ReportJob,
        "piece",
        lambda self, number, progress: done.append(number) or piece(self, number, progress),
    )
    run_report(job, tmp_path, progress=False)
    assert done == [0, 1]
    pieces[2].write_bytes(b"nothing")
    with pytest.raises(SimulationError, match=r"00000002\.json\.z is damaged"):
        read_report(stored.Objects(tmp_path))


def test_other_inputs_are_refused(job: ReportJob, tmp_path: Path) -> None:
    run_report(job, tmp_path, progress=False)
    other = replace(job, items=job.items[:6], scale=2.0)
    with pytest.raises(InputError, match="differs in items, scale; go on with what"):
        run_report(other, tmp_path, progress=False)


@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_workers_find_the_same(job: ReportJob, tmp_path: Path) -> None:
    pytest.importorskip("distributed", reason="the extra cluster is not installed")
    from shaketable.campaign.cluster import local

    with local(2) as client:
        run_report(job, tmp_path / "there", client=client, progress=False)
    run_report(job, tmp_path / "here", progress=False)
    found, once = (read_report(stored.Objects(tmp_path / name))[0] for name in ("there", "here"))
    told = [json.dumps([to_json(one) for one in each.results]) for each in (found, once)]
    assert told[0] == told[1]
    with pytest.raises(InputError, match="another campaign"):
        run_report(replace(job, scale=2.0), tmp_path / "there", progress=False)


def test_a_worker_with_other_code_is_refused(
    job: ReportJob, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run_report(job, tmp_path, progress=False)
    monkeypatch.setattr(stored, "source_hash", lambda pattern: "other")
    with pytest.raises(SimulationError, match="has other shaketable's code"):
        stored.site_of(str(tmp_path), "a beginning")


def test_a_report_is_no_dataset(job: ReportJob, tmp_path: Path) -> None:
    run_report(job, tmp_path, progress=False)
    with pytest.raises(InputError, match="holds the report of an inventory, not simulations"):
        open_campaign(tmp_path)
    assert stored.seconds_of(job) > 0.0


def test_from_the_command_line(tmp_path: Path) -> None:
    """The tables are those of `assess`; the page is whole."""
    (tmp_path / "rooms.csv").write_text(
        "name,depth_m,width_m,height_m,quantity\nshelf,0.3,0.9,1.8,4\nbox,0.5,0.5,0.6,2\n"
    )
    (tmp_path / "c.toml").write_text(
        '[bodies]\ninventory = "rooms.csv"\n[motions]\nof = "near-field-pulse"\n'
        "[plan]\nreport = true\n"
    )
    dry = shaketable("campaign", "run", "c.toml", "--dry-run", cwd=tmp_path)
    assert "2 in 1 pieces" in dry.stdout
    run = shaketable("campaign", "run", "c.toml", "--store", "s", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert "2 of 2 assessed" in run.stdout
    collect = shaketable("campaign", "collect", "s", "--out", "out", cwd=tmp_path)
    assert collect.returncode == 0, collect.stderr
    shaketable(
        "assess",
        "rooms.csv",
        "--planar",
        "--motions",
        "near-field-pulse",
        "--out",
        "once",
        cwd=tmp_path,
    )
    tables = [pd.read_csv(tmp_path / name / "results.csv") for name in ("out", "once")]
    pd.testing.assert_frame_equal(*tables)
    page = (tmp_path / "out" / "report.html").read_text()
    assert "What to do first" in page
    assert "rooms.csv · 28 motions (near-field-pulse)" in page
    assert "Shaken by 28 motions (near-field-pulse)" in collect.stdout
    said = refused("campaign", "run", "c.toml", "--store", "s", "--device", "cuda", cwd=tmp_path)
    assert "c.toml: plan.report: a report is made on the CPU" in said


def test_in_three_dimensions(job: ReportJob, tmp_path: Path) -> None:
    run_report(replace(job, in_pairs=True), tmp_path, progress=False)
    found, kept, _ = read_report(stored.Objects(tmp_path))
    assert kept.in_pairs
    once = assess(job.items, job.motions, pairs=kept.pairs, progress=False)
    assert len(once.solids) == len(job.items)
    pd.testing.assert_frame_equal(found.table, once.table)
    assert found.pairs == once.pairs
    with pytest.raises(InputError, match="differs in pairs"):
        run_report(job, tmp_path, progress=False)
