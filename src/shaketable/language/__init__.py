"""The language in which sentences are told.

The code speaks English. A sentence that people of other languages read goes through `tell`, which
looks its English words up in the file of the language that is spoken, and writes its numbers as
people of that language do. `es.json` is such a file; another one beside it is another language.
"""

from __future__ import annotations

import json
import numbers
import string
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from importlib import resources
from typing import Literal

Language = Literal["en", "es"]
LANGUAGES: tuple[Language, ...] = Language.__args__  # type: ignore[attr-defined]

_spoken: ContextVar[Language] = ContextVar("language", default="en")
_SWAPPED = str.maketrans(",.", ".,")


class _Writer(string.Formatter):
    """Fills sentences; numbers with the signs of the language that is spoken."""

    def format_field(self, value: object, format_spec: str) -> str:
        told: str = super().format_field(value, format_spec)
        swaps = _spoken.get() == "es" and isinstance(value, numbers.Real)
        return told.translate(_SWAPPED) if swaps else told


_WRITER = _Writer()


@contextmanager
def speaking(language: Language) -> Iterator[None]:
    """Everything told within is told in this language."""
    before = _spoken.set(language)
    try:
        yield
    finally:
        _spoken.reset(before)


def spoken() -> Language:
    """The language that is spoken here."""
    return _spoken.get()


def tell(sentence: str, /, **values: object) -> str:
    """A sentence in the language that is spoken; in English where it is not known there.

    Args:
        sentence: in English, a template as of `str.format`.
        values: what stands in its braces; numbers are written as the language does.
    """
    return _WRITER.format(translated(sentence), **values)


def translated(words: str) -> str:
    """Words in the language that is spoken, as they are: braces in them mean nothing."""
    return words_of(_spoken.get()).get(words, words)


def number(value: float, spec: str) -> str:
    """A number as people of the language write it: 1,200.5 in English, 1.200,5 in Spanish."""
    return _WRITER.format_field(value, spec)


@cache
def words_of(language: Language) -> Mapping[str, str]:
    """All that is known of a language: its words by the English ones; nothing for English."""
    if language == "en":
        return {}
    text = resources.files(__name__).joinpath(f"{language}.json").read_text(encoding="utf-8")
    found: dict[str, str] = json.loads(text)
    return found
