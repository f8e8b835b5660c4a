"""The words of lists in every language that has a file in `words`.

A language is contributed as a file; no code is needed. `words/en.toml` says what is in one.
"""

from __future__ import annotations

import re
import tomllib
import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib import resources

#: Headings in English, in the order in which they are told.
ENGLISH = "en"
#: Tables of words: of cells, names of sheets, and of the sheet that describes the building.
VALUES = ("answers", "castors", "shapes", "sides", "sheets", "building", "structures")
_GAPS = re.compile(r"[\s_.\-:?]+")


@dataclass(frozen=True)
class Vocabulary:
    """The words of one language, as its file has them.

    Attributes:
        language: its code.
        columns: headings of each meaning.
        weak: headings that have a meaning where no other column of a list has it.
        values: words of cells, by table, one of VALUES, and meaning.
        rows: "totals", "all_sizes" of which a title tells the unit, and "own": headings that are
            like known ones, and no slips in them.
        hints: words or regular expressions of each kind.
        boundaries: whether words have blanks between them.
        explained: what a template says of columns, by their meanings.
        explained_building: likewise of what it asks of the building.
        in_template: words of a template for columns and values, where not their first ones.
    """

    language: str
    columns: Mapping[str, tuple[str, ...]]
    weak: Mapping[str, tuple[str, ...]]
    values: Mapping[str, Mapping[str, tuple[str, ...]]]
    rows: Mapping[str, tuple[str, ...]]
    hints: Mapping[str, tuple[str, ...]]
    boundaries: bool = True
    explained: Mapping[str, str] = field(default_factory=dict)
    explained_building: Mapping[str, str] = field(default_factory=dict)
    in_template: Mapping[str, str] = field(default_factory=dict)


@cache
def vocabularies() -> tuple[Vocabulary, ...]:
    """Those of all languages, English first."""
    files = [
        path
        for path in resources.files(__package__).joinpath("words").iterdir()
        if path.name.endswith(".toml")
    ]
    files.sort(key=lambda path: (not path.name.startswith(ENGLISH), path.name))
    return tuple(
        _read(path.name.removesuffix(".toml"), path.read_text(encoding="utf-8")) for path in files
    )


def _read(language: str, text: str) -> Vocabulary:
    told = tomllib.loads(text)
    return Vocabulary(
        language=language,
        columns=_lists(told["columns"]),
        weak=_lists(told.get("weak", {})),
        values={name: _lists(told[name]) for name in VALUES},
        rows=_lists(told["rows"]),
        hints=_lists(told["hints"]),
        boundaries=told.get("boundaries", True),
        explained=told["explained"],
        explained_building=told["explained_building"],
        in_template=told.get("in_template", {}),
    )


def _lists(table: Mapping[str, list[str]]) -> dict[str, tuple[str, ...]]:
    return {name: tuple(words) for name, words in table.items()}


def normalized(text: str) -> str:
    """A text without wide forms of its letters and digits; "45³" stays what it is."""
    return unicodedata.normalize(
        "NFC",
        "".join(
            unicodedata.normalize("NFKC", each)
            if unicodedata.decomposition(each).startswith(("<wide>", "<narrow>", "<square>"))
            else each
            for each in text
        ),
    ).strip()


def plain(text: str) -> str:
    """A text as words are compared: in lower case, and without wide forms of letters."""
    return normalized(text).lower()


def heading(text: str) -> str:
    """A heading as headings are compared: blanks, dashes and underscores are alike."""
    return _GAPS.sub(" ", plain(text)).strip()


@cache
def headings() -> Mapping[str, str]:
    """Every heading of every language, and its meaning."""
    return {
        heading(word): meaning
        for one in vocabularies()
        for table in (one.weak, one.columns)
        for meaning, words in table.items()
        for word in words
    }


@cache
def weak_headings() -> frozenset[str]:
    """Headings that have their meaning where no other column has it."""
    return frozenset(
        heading(word) for one in vocabularies() for words in one.weak.values() for word in words
    )


@cache
def words_of(table: str) -> Mapping[str, str]:
    """Every word of a table of values, and its meaning."""
    return {
        plain(word): meaning
        for one in vocabularies()
        for meaning, words in one.values[table].items()
        for word in words
    }


def first_word(language: str, table: str, meaning: str) -> str:
    """How a language says a value of a table in a template."""
    own = next(each for each in vocabularies() if each.language == language)
    words = (own.in_template.get(meaning, ""), *own.values[table].get(meaning, ()))
    return next(word for word in words if word)


@cache
def row_words(kind: str) -> frozenset[str]:
    """Every word of a kind of row."""
    return frozenset(heading(word) for one in vocabularies() for word in one.rows[kind])


def hint(kind: str, before: str = r"\b", after: str = r"\b") -> re.Pattern[str]:
    """A pattern of all words of a kind of hint.

    Args:
        kind: of those in [hints].
        before, after: what bounds a word, in languages whose words have blanks between them.
    """
    parts = []
    for bounded in (True, False):
        words = [
            word
            for one in vocabularies()
            if one.boundaries is bounded
            for word in one.hints.get(kind, ())
        ]
        if words:
            inner = "|".join(words)
            parts.append(f"{before}(?:{inner}){after}" if bounded else f"(?:{inner})")
    return re.compile("|".join(parts), re.IGNORECASE)
