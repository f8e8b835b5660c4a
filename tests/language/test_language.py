"""Sentences in other languages: all of them, with the same values in them."""

from __future__ import annotations

import string
from pathlib import Path
from typing import get_args

import pytest

from shaketable.errors import InputError
from shaketable.inventory.read import read_with_columns
from shaketable.language import (
    LANGUAGES,
    Language,
    number,
    speaking,
    spoken,
    tell,
    translated,
    words_of,
)
from shaketable.report.words import advice, findings
from shaketable.report.words.numbers import counted, two_digits
from tests.support.told import literals, sentences

OTHERS = [language for language in LANGUAGES if language != "en"]


def fields(sentence: str) -> set[tuple[str | None, str | None, str | None]]:
    return {part[1:] for part in string.Formatter().parse(sentence) if part[1] is not None}


@pytest.mark.parametrize("language", OTHERS)
def test_every_sentence_that_is_told_is_known(language: Language) -> None:
    missing = [each for each in dict.fromkeys(sentences()) if each not in words_of(language)]
    assert not missing


@pytest.mark.parametrize("language", OTHERS)
def test_a_translation_takes_no_other_values(language: Language) -> None:
    """One that English does not have would fail, and only where it is told.

    Spanish needs no value for whether one or several overturn.
    """
    for english, other in words_of(language).items():
        assert fields(other) <= fields(english), english
        assert fields(english) - fields(other) <= {("overturn", "", None)}, english


@pytest.mark.parametrize("language", OTHERS)
def test_what_is_chosen_at_run_time_is_known(language: Language) -> None:
    """Words in tables, which no search of the code finds beside `translated`."""
    chosen = [*advice.WORDS.values(), *findings.CRITERIA.values()]
    chosen += [side for sides in findings.SIDES.values() for side in sides]
    chosen += [str(direction) for direction in findings.SIDES]
    assert [each for each in chosen if each not in words_of(language)] == []


@pytest.mark.parametrize("language", OTHERS)
def test_no_translation_is_of_what_nobody_says(language: Language) -> None:
    """Each is written in the code, or made of two words of it."""
    names = {each.replace("_", " ") for each in literals()}  # columns, as they are told
    written = names | set(literals()) | set(sentences())
    made = ("the ", "is given without a ")  # a floor's name, a latitude
    unused = [each for each in words_of(language) if each not in written]
    assert [each for each in unused if not each.startswith(made)] == []


def test_numbers_are_written_as_the_language_does() -> None:
    assert number(1234.5, ",.1f") == "1,234.5"
    with speaking("es"):
        assert number(1234.5, ",.1f") == "1.234,5"
        assert two_digits(1200.0) == "1.200"
        assert tell("floor {label}", label="1.5") == "el piso 1.5"  # a name is no number
        assert counted(2, "kind of object") == "2 tipos de objeto"
    assert spoken() == "en"


def test_a_language_ends_where_its_block_does() -> None:
    with pytest.raises(ValueError, match="now"), speaking("es"):
        raise ValueError("now")
    assert translated("pieces") == "pieces"


def test_what_is_not_known_is_told_in_english() -> None:
    with speaking("es"):
        assert translated("{braces} of a user") == "{braces} of a user"


def test_languages_are_those_of_the_files() -> None:
    assert set(LANGUAGES) == set(get_args(Language))
    assert all(words_of(language) for language in OTHERS)


def test_faults_of_a_list_are_told_in_spanish(tmp_path: Path) -> None:
    path = tmp_path / "list.csv"
    path.write_text("name,depth_m,height_m\nshelf,abc,1.8\ntall,0.4,180\n", encoding="utf-8")
    with speaking("es"), pytest.raises(InputError) as found:
        read_with_columns(path)
    told = str(found.value)
    assert "línea 2, depth_m: se esperaba un número positivo, hay 'abc'" in told
    assert "180 m no es de esperar en un mueble (sería 1,8 m, si está en cm" in told
