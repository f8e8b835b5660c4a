"""Damage to files: what transfers, disks, editors and spreadsheets do to them, at random."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

ODD = [
    b"/0", b"1.2.3", b"1e999", b"-1e308", b"nan", b"inf", b"", b"0", b"-1", b"1_0", b"9" * 4300,
    b"\xef\xbc\x99", b"1e-30", b"1e30", b"x", b"--", b"+", b".", b"\x1b[31m", b"\0", b"'", b'"',
]  # fmt: skip
LONG = 100_000  # characters


class Damaged(NamedTuple):
    """A damaged file.

    Attributes:
        raw: what is left of it.
        lines: how many lines were touched.
    """

    raw: bytes
    lines: int


Mutation = Callable[[bytes, np.random.Generator], Damaged]


def flip(raw: bytes, rng: np.random.Generator) -> Damaged:
    """One byte becomes another that can be printed."""
    at = int(rng.integers(len(raw)))
    return Damaged(raw[:at] + bytes([int(rng.integers(32, 127))]) + raw[at + 1 :], 2)


def flip_any(raw: bytes, rng: np.random.Generator) -> Damaged:
    at = int(rng.integers(len(raw)))
    return Damaged(raw[:at] + bytes([int(rng.integers(256))]) + raw[at + 1 :], 2)


def drop(raw: bytes, rng: np.random.Generator) -> Damaged:
    at = int(rng.integers(len(raw)))
    return Damaged(raw[:at] + raw[at + 1 :], 2)


def insert(raw: bytes, rng: np.random.Generator) -> Damaged:
    at = int(rng.integers(len(raw)))
    return Damaged(raw[:at] + bytes([int(rng.integers(32, 127))]) + raw[at:], 2)


def cut(raw: bytes, rng: np.random.Generator) -> Damaged:
    return Damaged(raw[: int(rng.integers(len(raw)))], 1)


def zeros(raw: bytes, rng: np.random.Generator) -> Damaged:
    """A block that was never written."""
    at, size = int(rng.integers(len(raw))), int(rng.integers(1, 600))
    block = raw[at : at + size]
    return Damaged(raw[:at] + bytes(len(block)) + raw[at + size :], 1 + block.count(b"\n"))


def line_dropped(raw: bytes, rng: np.random.Generator) -> Damaged:
    lines = raw.split(b"\n")
    at, size = int(rng.integers(len(lines))), int(rng.choice([1, 1, 1, 3, 10]))
    return Damaged(b"\n".join(lines[:at] + lines[at + size :]), size)


def line_repeated(raw: bytes, rng: np.random.Generator) -> Damaged:
    lines = raw.split(b"\n")
    at, size = int(rng.integers(len(lines))), int(rng.choice([1, 1, 1, 5, 12]))
    return Damaged(b"\n".join(lines[: at + size] + lines[at:]), size)


def lines_swapped(raw: bytes, rng: np.random.Generator) -> Damaged:
    lines = raw.split(b"\n")
    a, b = (int(n) for n in rng.integers(len(lines), size=2))
    lines[a], lines[b] = lines[b], lines[a]
    return Damaged(b"\n".join(lines), len(lines))  # a blank line's place moves all rows


def line_long(raw: bytes, rng: np.random.Generator) -> Damaged:
    """A line grows by the same character, or by itself, over and over."""
    lines = raw.split(b"\n")
    at = int(rng.integers(len(lines)))
    more = bytes(rng.choice([b" ", b"0", b"x", b"=", lines[at] or b"-"]))
    size = int(rng.choice([300, 10_000, LONG]))
    lines[at] += (more * (size // max(1, len(more)) + 1))[:size]
    return Damaged(b"\n".join(lines), 1)


def word_odd(raw: bytes, rng: np.random.Generator) -> Damaged:
    """A word of one line, a header's more often than not, becomes something odd."""
    lines = raw.split(b"\n")
    at = int(rng.integers(min(len(lines), 50) if rng.random() < 0.7 else len(lines)))
    words = lines[at].split(b" ")
    words[int(rng.integers(len(words)))] = ODD[int(rng.integers(len(ODD)))]
    lines[at] = b" ".join(words)
    return Damaged(b"\n".join(lines), 2)


def header_digit(raw: bytes, rng: np.random.Generator) -> Damaged:
    """One digit among the first lines becomes another."""
    places = [n for n, byte in enumerate(raw[:3000]) if 48 <= byte <= 57]
    if not places:
        return Damaged(raw, 0)
    at = int(rng.choice(places))
    return Damaged(raw[:at] + bytes([48 + int(rng.integers(10))]) + raw[at + 1 :], 2)


MUTATIONS: list[Mutation] = [
    flip, flip_any, drop, insert, cut, zeros, line_dropped, line_repeated, lines_swapped,
    line_long, word_odd, word_odd, header_digit, header_digit,
]  # fmt: skip
