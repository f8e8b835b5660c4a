"""How much a visitor may ask for."""

from __future__ import annotations

MOST_BYTES = 20_000_000  # of an uploaded record
MOST_ASKED = 4_000_000  # bytes of any other request
MOST_SAMPLES = 60_000  # of an uploaded motion
MOST_NAME = 120  # characters
MOST_WAITING = 400  # questions that wait for a worker, of all visitors
MOST_EACH = 8  # of one visitor
SHAKE_SECONDS = 20.0  # of a worker, for one shaking or one record
MANY_SECONDS = 60.0  # for a hundred shakings
WORKER_MEMORY = 4 << 30  # bytes of address space
