"""`python -m benchmarks.web_load`: many visitors at once on the web page's server.

Each shakes one thing of his own and asks for a hundred shakings of it, and some also assess the
example hospital; all ask again where the server asks to wait. Printed are how long they waited,
whether all were answered and right, and the memory of server and workers.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import httpx

from shaketable.cli.assess import example_inventory
from shaketable.web import lists, work
from shaketable.web.questions import Assess, Many, Recording, Shake, Thing

PATIENCE = 1800.0  # s
HOSPITAL = Assess(name="hospital.csv", text=example_inventory().read_text("utf-8"))


def thing_of(visitor: int) -> Thing:
    return Thing(base_m=0.2 + 0.01 * (visitor % 60), height_m=1.8, friction=0.5)


async def ask(client: httpx.AsyncClient, path: str, question: Any, visitor: int) -> Any:
    """The answer, after as many waits as the server asks for; and how long it took [s]."""
    begun = time.monotonic()
    while True:
        answer = await client.post(
            path,
            content=question.model_dump_json(),
            headers={
                "Content-Type": "application/json",
                "X-Visitor": str(visitor),
                "X-Forwarded-For": f"10.0.0.{visitor % 250}",
            },
        )
        if answer.status_code != 429:
            answer.raise_for_status()
            return answer.json(), time.monotonic() - begun
        await asyncio.sleep(float(answer.headers["Retry-After"]))


async def visit(client: httpx.AsyncClient, visitor: int) -> tuple[dict[str, Any], list[float]]:
    """What one visitor was told of a thing, and how long each answer took [s]."""
    thing = thing_of(visitor)
    shake = Shake(thing=thing, shaking=Recording(name="NORTHR/MUL009"))
    film, first = await ask(client, "/api/simulate", shake, visitor)
    shares, second = await ask(client, "/api/many", Many(thing=thing), visitor)
    return {"outcome": film["outcome"], "falls": shares["falls"]}, [first, second]


async def assess(client: httpx.AsyncClient, visitor: int) -> tuple[str, float]:
    """What was found of the example hospital, and how long it took [s]."""
    begun = time.monotonic()
    job, _ = await ask(client, "/api/assess", HOSPITAL, visitor)
    async with client.stream("GET", f"/api/assess/{job['id']}/events") as told:
        last = [line async for line in told.aiter_lines() if line][-1]
    assert '"done"' in last, last
    found = await client.get(f"/api/assess/{job['id']}")
    return found.text, time.monotonic() - begun


def memory(process: int) -> float:
    """Resident memory of a process and its children [MB]."""
    listed = subprocess.run(
        ["ps", "-o", "rss=", "--pid", str(process), "--ppid", str(process)],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    return sum(int(size) for size in listed.stdout.split()) / 1000


async def load(
    address: str, visitors: int, lists: int
) -> tuple[list[tuple[dict[str, Any], list[float]]], list[tuple[str, float]]]:
    """What all were told who ask at once; some of them come with lists as well."""
    limits = httpx.Limits(max_connections=None)
    async with httpx.AsyncClient(base_url=address, timeout=PATIENCE, limits=limits) as client:
        things = asyncio.gather(*(visit(client, k) for k in range(visitors)))
        hospitals = asyncio.gather(*(assess(client, k) for k in range(lists)))
        return await things, await hospitals


def right(visitor: int, found: dict[str, Any]) -> bool:
    thing = thing_of(visitor)
    film = work.shake(Shake(thing=thing, shaking=Recording(name="NORTHR/MUL009")))
    return found == {"outcome": film.outcome, "falls": work.many(Many(thing=thing)).falls}


def hospital() -> str:
    """What is found of the example hospital without a server."""
    with tempfile.TemporaryDirectory() as folder:
        lists.assess_list(HOSPITAL, folder)
        return (Path(folder) / lists.RESULTS["en"]).read_text("utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--visitors", type=int, default=100)
    parser.add_argument("--lists", type=int, default=10, help="of them, who also assess a hospital")
    given = parser.parse_args()
    server = subprocess.Popen(
        [sys.executable, "-m", "shaketable", "serve", "--port", "0"],
        stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONUNBUFFERED": "1"},
    )  # fmt: skip
    assert server.stdout is not None
    address = server.stdout.readline().split()[0].rstrip("/")
    try:
        for _ in range(60):  # until it listens, and until a worker has compiled
            try:
                httpx.get(f"{address}/api/motions", timeout=PATIENCE).raise_for_status()
                break
            except httpx.ConnectError:
                time.sleep(1.0)
        begun = time.monotonic()
        found, hospitals = asyncio.run(load(address, given.visitors, given.lists))
        took = time.monotonic() - begun
        used = memory(server.pid)
    finally:
        server.terminate()
        server.wait()
    told = {text for text, _ in hospitals}
    assert len(told) <= 1, "the same list was told in several ways"
    assert not told or told == {hospital()}
    wrong = sum(not right(k, told) for k, (told, _) in enumerate(found))
    first, second = zip(*(waits for _, waits in found), strict=True)
    print(
        f"{given.visitors} visitors at once on {os.cpu_count()} cores: all answered in "
        f"{took:.0f} s, {wrong} wrong; one shaking after {statistics.median(first):.1f} s (median, "
        f"at most {max(first):.1f}), a hundred after {statistics.median(second):.1f} s more "
        f"(at most {max(second):.1f}); {used:,.0f} MB in all processes"
    )
    if hospitals:
        waits = [took for _, took in hospitals]
        print(
            f"{len(waits)} of them also assessed the example hospital: median "
            f"{statistics.median(waits):.0f} s, at most {max(waits):.0f} s, none wrong"
        )


if __name__ == "__main__":
    main()
