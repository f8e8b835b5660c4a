"""`python -m benchmarks.web_attacks URL`: visitors who mean no good, and what others notice of it.

The page has to run at that address (`shaketable serve`, with a proxy in front or without); all come
from this machine, which is one address. Beside each attack somebody opens the page and asks for the
list of motions.
"""

from __future__ import annotations

import argparse
import resource
import socket
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from urllib.parse import urlsplit

import httpx

HALF = 1_100  # headers
UNFINISHED, LENGTH = 400, 2_400_000  # questions, and the bytes that each of them names
DEAR = 8  # questions with little friction
LISTS = 98
THING = {"base_m": 0.3, "height_m": 1.8}
PULSE = {"kind": "pulse", "period_s": 0.5, "peak_g": 0.3}


def visit(address: str) -> str:
    """What somebody notices who opens the page."""
    begun = time.monotonic()
    try:
        codes = [httpx.get(f"{address}{path}", timeout=60.0).status_code
                 for path in ("/", "/api/motions")]  # fmt: skip
    except httpx.TransportError as error:
        return f"{type(error).__name__} after {time.monotonic() - begun:.1f} s"
    return f"{codes} after {time.monotonic() - begun:.2f} s"


def connections(address: str, count: int, sent: bytes) -> list[socket.socket]:
    """So many, each of which has sent something."""
    place = urlsplit(address)
    found = []
    for _ in range(count):
        try:
            one = socket.create_connection((place.hostname or "", place.port or 80), timeout=5.0)
            one.sendall(sent)
        except OSError:
            continue
        found.append(one)
    return found


def dear(address: str, number: int) -> int:
    """A hundred shakings at ten strengths of a cylinder that slides and wobbles for long."""
    thing = {**THING, "shape": "cylinder", "friction": (0.02, 0.1)[number % 2]}
    headers = {"X-Visitor": str(number)}
    path = f"{address}/api/space/many"
    return httpx.post(path, json={"thing": thing}, headers=headers, timeout=600.0).status_code


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("address", help="as http://127.0.0.1:8000")
    address = str(parser.parse_args().address).rstrip("/")
    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = 2 * HALF
    resource.setrlimit(resource.RLIMIT_NOFILE, (wanted if hard < 0 else min(wanted, hard), hard))
    host = urlsplit(address).netloc
    print(f"before: {visit(address)}")

    start = f"POST /api/assess HTTP/1.1\r\nHost: {host}\r\nContent-Length: {LENGTH}\r\n\r\n"
    for name, sent, more in (
        (f"{HALF:,} half-sent headers", start[:50], b""),
        (f"{UNFINISHED} questions that never end", start, b" " * (LENGTH - 1)),
    ):
        held = connections(address, UNFINISHED if more else HALF, sent.encode())
        for one in held:
            one.settimeout(0.2)
            try:
                one.sendall(more)
            except OSError:  # it was refused, or nobody reads it
                continue
        print(f"{name}: {visit(address)}")
        for one in held:
            one.close()
        time.sleep(1.0)

    with ThreadPoolExecutor(DEAR) as visitors:
        asked = [visitors.submit(dear, address, number) for number in range(DEAR)]
        time.sleep(0.5)
        waits = []
        for _ in range(5):
            begun = time.monotonic()
            shaking = {"thing": THING, "shaking": PULSE}
            httpx.post(f"{address}/api/simulate", json=shaking, timeout=600.0).raise_for_status()
            waits.append(time.monotonic() - begun)
        print(f"{DEAR} dear questions: another shaking takes at most {max(waits):.2f} s; "
              f"they end with {Counter(one.result() for one in asked)}")  # fmt: skip

    begun = time.monotonic()
    codes = Counter(
        httpx.post(
            f"{address}/api/assess",
            json={"text": "name,width_m,height_m\na,0.3,1.8\n"},
            headers={"X-Visitor": f"word {number}"},
            timeout=60.0,
        ).status_code
        for number in range(LISTS)
    )
    print(f"{LISTS} lists in {time.monotonic() - begun:.1f} s, each with a new word: {codes}")


if __name__ == "__main__":
    main()
