"""`python -m benchmarks.campaigns`: what keeping, resuming and spreading simulations costs.

A campaign of W1 × 10 beside `simulate_many`, in turns, so that both meet the same machine; two
workers beside two threads; the time around each of many small blocks; and the memory of campaigns
of different lengths, each in a process of its own. With `--stub` nothing is simulated: what remains
is everything around the simulations. With `--slopes` all bodies rest: how the memory of who
begins a campaign, of a worker and of who collects it, and the bytes of its store, grow with
motions and with bodies, and what that makes of a billion simulations.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import resource
import shutil
import statistics
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.cases import BODIES, TILTS, motions
from shaketable import Body, Motion, simulate_many
from shaketable.campaign import open_campaign, run_campaign
from shaketable.campaign.cluster import local
from shaketable.campaign.description import read_campaign
from shaketable.campaign.objects import Objects
from shaketable.campaign.plan import ALL, BLOCKS, SUMMARY
from shaketable.campaign.run import run
from shaketable.campaign.status import status_of
from shaketable.origin import Origin
from shaketable.simulate.ensemble import Ensemble
from shaketable.units import STANDARD_GRAVITY

ROUNDS = 5
TIMES = 10
LARGE, SMALL = BLOCKS[ALL], BLOCKS[ALL] // 16  # simulations of a block


def w1_times(many: int) -> dict[str, Any]:
    """W1 with every body several times over."""
    return {"bodies": BODIES * many, "motions": motions(), "tilts": TILTS, "progress": False}


def timed(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def kept(folder: Path, **given: Any) -> float:
    """Seconds of a campaign in a new store."""
    shutil.rmtree(folder, ignore_errors=True)
    return timed(lambda: run_campaign(**given, store=folder))


def beside_one_piece(folder: Path) -> None:
    """Campaigns over `simulate_many`, in turns."""
    given = w1_times(TIMES)
    simulate_many(**w1_times(1))  # compiles
    ratios: dict[str, list[float]] = {"all": [], "summary": []}
    for _ in range(ROUNDS):
        once = timed(lambda: simulate_many(**given))
        for keep, found in ratios.items():
            found.append(kept(folder, **given, keep=keep) / once)
    for keep, found in ratios.items():
        low, middle, high = min(found), statistics.median(found), max(found)
        print(f"W1 × {TIMES}, keep={keep!r}: {middle:.3f} of the time of simulate_many "
              f"(from {low:.3f} to {high:.3f})")  # fmt: skip


def beside_threads(folder: Path) -> None:
    """Two workers of one thread over this process's threads, in turns."""
    given = w1_times(TIMES)
    with local(2) as client:
        kept(folder, **w1_times(1), client=client)  # compiles
        found = []
        for _ in range(ROUNDS):
            threads = timed(lambda: simulate_many(**given))
            found.append(threads / kept(folder, **given, client=client, block=40_000))
    low, middle, high = min(found), statistics.median(found), max(found)
    print(f"two workers: {middle:.2f} of the rate of two threads (from {low:.2f} to {high:.2f})")


def around_blocks(folder: Path, blocks: int) -> None:
    """The time of a worker around each block, many of which are small."""
    bodies = [Body.rectangle(0.2 + 1e-6 * k, 1.0) for k in range(blocks)]
    given = {"bodies": bodies, "motions": motions()[:1], "block": 1, "progress": False}
    with local(2) as client:
        kept(folder, **(given | {"bodies": bodies[:4]}), client=client)
        seconds = kept(folder, **given, client=client)
    told = status_of(Objects(folder))
    each = 2 * seconds / told.blocks - told.seconds / told.blocks
    print(f"{told.blocks:,} blocks on two workers: {1000 * each:.1f} ms around each")


def memory(bodies: int, block: int, stub: bool) -> tuple[int, int, float]:
    """Simulations, blocks and peak memory [MiB] of a campaign in a process of its own."""
    context = multiprocessing.get_context("spawn")
    with context.Pool(1) as pool:
        return pool.apply(_memory, (bodies, block, stub))


def _memory(bodies: int, block: int, stub: bool) -> tuple[int, int, float]:
    if stub:
        Ensemble.run = _nothing  # type: ignore[method-assign]
    many = (BODIES * (bodies // len(BODIES) + 1))[:bodies]
    with tempfile.TemporaryDirectory() as folder:
        store = Path(folder) / "store"
        run_campaign(many, motions(), tilts=TILTS, store=store, progress=False, block=block)
        told = status_of(Objects(store))
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        return told.count_done, told.blocks, peak


def _nothing(
    ensemble: Ensemble, store: object, threads: object, progress: Any, device: str = "cpu"
) -> Counter[float]:
    """In place of the simulations."""
    count = int(np.prod(ensemble.shape))
    if callable(progress):
        progress(count)
    return Counter({0: count})


def slopes() -> None:
    """Memory and bytes as c + a M + b B of M motions and B bodies, from three campaigns."""
    sizes(100, 600)  # compiles what the others use, which takes memory too
    found = {size: sizes(*size) for size in ((2_000, 600), (8_000, 600), (2_000, 2_400))}
    base, more_motions, more_bodies = found.values()
    print("| | 2,000 motions, 600 bodies | a motion | a body | 50,000 motions, 10,000 bodies |")
    print("|---|---:|---:|---:|---:|")
    for name in base:
        per_motion = (more_motions[name] - base[name]) / 6_000
        per_body = (more_bodies[name] - base[name]) / 1_800
        paper = base[name] + 48_000 * per_motion + 9_400 * per_body
        print(
            f"| {name} | {base[name]:.0f} MiB | {1024 * per_motion:.2f} KiB | "
            f"{1024 * per_body:.2f} KiB | {paper:,.0f} MiB |"
        )


def sizes(count: int, bodies: int) -> dict[str, float]:
    """Peak memory of four processes, and the bytes of the store [MiB]."""
    context = multiprocessing.get_context("spawn")
    with tempfile.TemporaryDirectory() as place:
        store = Path(place) / "store"
        told = {}
        for name, work in (
            ("begins it, by a generator of motions", _begun),
            ("begins it, by a folder of records", _begun_by_records),
            ("a worker", _worked),
            ("collects it", _collected),
        ):
            with context.Pool(1) as pool:
                told[name] = pool.apply(work, (store, count, bodies))
        files = [path for path in store.rglob("*") if path.is_file()]
        of_motions = sum(p.stat().st_size for p in files if p.parent.name == "motions")
        told["the store, without motions"] = (
            sum(path.stat().st_size for path in files) - of_motions
        ) / 2**20
        return told


def _noise(count: int) -> Iterator[Motion]:
    """Weak motions of 75 s, under which all bodies rest; sixteen recordings of each event."""
    rng = np.random.default_rng(0)
    for k in range(count):
        yield Motion(
            0.1 * rng.normal(size=7_500), 0.01, name=f"motion {k}",
            origin=Origin(event=f"event {k // 16}", station=f"station {k}"),
        )  # fmt: skip


def _begun(store: Path, count: int, bodies: int) -> float:
    many = [
        Body.rectangle(width, 1.8, name=f"body {k}")
        for k, width in enumerate(np.linspace(0.2, 0.6, bodies).tolist())
    ]
    run_campaign(many, _noise(count), store=store, keep=SUMMARY, scales=(0.5, 1.0), progress=False)
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def _begun_by_records(store: Path, count: int, bodies: int) -> float:
    """In a store of its own, from files that are read for the first time."""
    place = store.parent / "files"
    (place / "records").mkdir(parents=True)
    os.environ["XDG_CACHE_HOME"] = str(place / "cache")
    for motion in _noise(count):
        assert motion.origin is not None
        rows = "\n".join(map("{:.6f}".format, (motion.horizontal / STANDARD_GRAVITY).tolist()))
        name = motion.name.replace("motion ", "RSN") + ".AT2"
        (place / "records" / name).write_text(
            f"PEER STRONG MOTION DATABASE RECORD\n{motion.origin.event}, 1/1/2000, "
            f"{motion.origin.station}, 90\nACCELERATION TIME HISTORY IN UNITS OF G\n"
            f"NPTS= {motion.horizontal.size}, DT= .01 SEC\n{rows}\n"
        )
    (place / "campaign.toml").write_text(
        f"[bodies.grid]\nbase_m = {{from = 0.2, to = 0.6, count = {bodies}}}\nheight_m = 1.8\n"
        '[motions]\nof = "records"\n[shaking]\nscales = [0.5, 1.0]\n'
        '[results]\nkeep = "summary"\n'
    )
    run(read_campaign(place / "campaign.toml"), place / "store", progress=False)
    shutil.rmtree(place)
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def _worked(store: Path, count: int, bodies: int) -> float:
    from shaketable.campaign.blocks import BEGUN, do_block, site_of

    begun = (Objects(store).get_json(BEGUN) or {})["token"]
    blocks = site_of(str(store), begun).work.blocks
    for number in range(min(4, blocks)):  # each has other motions
        do_block(str(store), begun, number)
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def _collected(store: Path, count: int, bodies: int) -> float:
    from shaketable.campaign.collect import falls_table
    from shaketable.campaign.results import simulations_of

    falls_table(open_campaign(store), simulations_of(Objects(store)).plan)
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--stub", action="store_true", help="memory with nothing simulated")
    parser.add_argument("--blocks", type=int, default=10_000, help="small blocks on two workers")
    parser.add_argument("--slopes", action="store_true", help="memory by motions and by bodies")
    given = parser.parse_args()
    if given.slopes:
        slopes()
        return
    if given.stub:
        for bodies, block in (
            (336, BLOCKS[ALL]),
            (33_600, BLOCKS[ALL]),
            (33_600, BLOCKS[ALL] // 16),
        ):
            tell_memory(*memory(bodies, block, stub=True))
        return
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "store"
        beside_one_piece(folder)
        beside_threads(folder)
        around_blocks(folder, given.blocks)
    for bodies, block in ((336, LARGE), (3360, LARGE), (3360, SMALL)):
        tell_memory(*memory(bodies, block, stub=False))


def tell_memory(simulations: int, blocks: int, peak: float) -> None:
    print(f"{simulations:>13,} simulations in {blocks:>6,} blocks: {peak:,.0f} MiB")


if __name__ == "__main__":
    main()
