"""The language in which sentences are told.

The code speaks English. A sentence that people of other languages read goes through `tell`, which
looks its English words up in the file of the language that is spoken, and writes its numbers as
people of that language do. What is logged is a template that `message_of` fills where it is shown.
Another language is a file beside `es.json`, its name in `Language`, and its signs in `_SIGNS`.
"""

from __future__ import annotations

import json
import logging
import numbers
import re
import string
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from importlib import resources
from typing import Literal, get_args

Language = Literal["en", "es", "de"]
LANGUAGES: tuple[Language, ...] = get_args(Language)

_spoken: ContextVar[Language] = ContextVar("language", default="en")
_PLACE = re.compile(r"%%|%[-+ 0#]*\d*(?:\.\d+)?[a-z]")  # of a value, in what is logged
_COMMA = str.maketrans(",.", ".,")
_SIGNS = {"es": _COMMA, "de": _COMMA}  # of numbers, in place of the English ones


class _Writer(string.Formatter):
    """Fills sentences; numbers with the signs of the language that is spoken."""

    def format_field(self, value: object, format_spec: str) -> str:
        told: str = super().format_field(value, format_spec)
        is_number = isinstance(value, numbers.Real)
        return told.translate(_SIGNS.get(_spoken.get(), {})) if is_number else told


_WRITER = _Writer()


@contextmanager
def speaking(language: Language) -> Iterator[None]:
    """Everything told within is told in this language, and an error keeps it as `spoken`."""
    before = _spoken.set(language)
    try:
        yield
    except Exception as error:
        if not hasattr(error, "spoken"):
            error.spoken = language  # type: ignore[attr-defined]
        raise
    finally:
        _spoken.reset(before)


def tell(sentence: str, /, **values: object) -> str:
    """A sentence in the language that is spoken; in English where it is not known there.

    Args:
        sentence: in English, a template as of `str.format`.
        values: what stands in its braces; numbers are written as the language does.
    """
    return _WRITER.format(translated(sentence), **values)


def message_of(record: logging.LogRecord) -> str:
    """What is logged, in the language that is spoken; as it was logged where it is not known."""
    template = words_of(_spoken.get()).get(str(record.msg))
    if template is None or not isinstance(record.args, tuple):
        return record.getMessage()
    values, signs = iter(record.args), _SIGNS.get(_spoken.get(), {})

    def filled(found: re.Match[str]) -> str:
        if found.group() == "%%":
            return "%"
        value = next(values)
        told = found.group() % (value,)
        return told.translate(signs) if isinstance(value, numbers.Real) else told

    return _PLACE.sub(filled, template)


def spoken() -> Language:
    """The language that is spoken."""
    return _spoken.get()


def listed(parts: Sequence[str]) -> str:
    """Words one after another: "a, b and c"; "a, b y c" (e before an i); "a, b und c"."""
    *first, last = parts
    if not first:
        return last
    if _spoken.get() == "es" and last.lower().startswith(("i", "hi")):
        return f"{', '.join(first)} e {last}"
    return tell("{first} and {last}", first=", ".join(first), last=last)


def translated(words: str) -> str:
    """A literal string in the language that is spoken; braces in it mean nothing."""
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
