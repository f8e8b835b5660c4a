"""Sentences in other languages: all of them, with the same values in them."""

from __future__ import annotations

import inspect
import logging
import re
import string
from importlib import resources
from pathlib import Path

import pytest

from shaketable.assess.classes import NOT_CLASSED
from shaketable.assess.uncertainty import KINDS
from shaketable.cli.console import Printable
from shaketable.criteria.kaneko_hayashi_2004 import RISK_CLASSES
from shaketable.errors import InputError
from shaketable.inventory.columns import WORDS
from shaketable.inventory.read import read_with_columns
from shaketable.language import (
    LANGUAGES,
    Language,
    listed,
    message_of,
    number,
    speaking,
    tell,
    translated,
    words_of,
)
from shaketable.records import cached, read_components, suite
from shaketable.report.words import advice, findings, hazard, mitigation
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

    Spanish and German need no value for whether one or several overturn.
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
    chosen += [kind.name for kind in KINDS]
    chosen += [*RISK_CLASSES, NOT_CLASSED]
    chosen += [meaning.replace("_", " ") for meaning in WORDS]
    chosen += [*mitigation.SHORT.values(), *mitigation.SHORT_THERE.values(), mitigation.CONSERVATOR]
    chosen += mitigation.WHO.values()
    chosen += [hazard.NOT_CONSIDERED, hazard.AS_IF_FIXED]
    source = "".join(
        inspect.getsource(each)
        for each in (advice._first, advice._first_as_it_stands, advice._to_fill_in)
    )
    said = [each for each in re.findall(r'(?:return|else) "(.*?)"', source) if each]
    said += re.findall(r'(?:return|else) "(.*?)" if', source)
    assert len(set(said)) == 15  # as many as there are
    chosen += said
    assert [each for each in chosen if each not in words_of(language)] == []


@pytest.mark.parametrize("language", OTHERS)
def test_no_translation_is_of_what_nobody_says(language: Language) -> None:
    """Each is written in the code, or made of two words of it."""
    names = {each.replace("_", " ") for each in (*literals(), *WORDS)}  # columns, as they are told
    written = names | set(literals()) | set(sentences())
    written |= {logging.getLevelName(each) for each in (logging.WARNING, logging.ERROR)}
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
    assert number(1234.5, ",.1f") == "1,234.5"
    with speaking("de"):
        assert number(1234.5, ",.1f") == "1.234,5"
        assert counted(2, "kind of object") == "2 Arten von Gegenständen"


def test_words_one_after_another() -> None:
    assert listed(["a"]) == "a"
    assert listed(["a", "b", "c"]) == "a, b and c"
    with speaking("es"):
        assert listed(["agua", "sal"]) == "agua y sal"
        assert listed(["agua", "hilo"]) == "agua e hilo"
    with speaking("de"):
        assert listed(["a", "b"]) == "a und b"


def test_a_language_ends_where_its_block_does() -> None:
    with pytest.raises(ValueError, match="now"), speaking("es"):
        raise ValueError("now")
    assert translated("pieces") == "pieces"


def test_what_is_not_known_is_told_in_english() -> None:
    with speaking("es"):
        assert translated("{braces} of a user") == "{braces} of a user"


def test_languages_are_those_of_the_files() -> None:
    files = resources.files("shaketable.language").iterdir()
    assert {
        name.removesuffix(".json") for file in files if (name := file.name).endswith(".json")
    } == {*OTHERS}
    assert all(words_of(language) for language in OTHERS)


def test_faults_of_a_list_are_told_in_spanish(tmp_path: Path) -> None:
    path = tmp_path / "list.csv"
    path.write_text("name,depth_m,height_m\nshelf,abc,1.8\ntall,0.4,180\n", encoding="utf-8")
    with speaking("es"), pytest.raises(InputError) as found:
        read_with_columns(path)
    told = str(found.value)
    assert "línea 2, depth_m: se esperaba un número positivo, hay 'abc'" in told
    assert "180 m no es de esperar en un mueble (sería 1,8 m, si está en cm" in told


def test_warnings_of_a_list_are_told_in_spanish(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    """All that names and notes hint at, and what is left out."""
    path = tmp_path / "list.csv"
    path.write_text(
        "name,depth_m,width_m,height_m,note,colour\n"
        "trolley,0.5,0.5,1.0,,red\n"
        "oxygen cylinder,0.3,0.3,1.5,bolted,\n"
        "# old,,,,,\n"
        "total,1,1,1,,\n",
        encoding="utf-8",
    )
    with speaking("es"):
        read_with_columns(path)
    told = "\n".join(caplog.messages)
    assert len(caplog.messages) == 7
    assert "'trolley': posiblemente sobre ruedas" in told
    assert "'oxygen cylinder': posiblemente cuelga o está fijado" in told
    assert "'oxygen cylinder': posiblemente redondo" in told
    assert "'oxygen cylinder': posiblemente no debe caer" in told
    assert "omitidos, por ser totales: línea 5" in told
    assert "omitidos, por ser comentarios: línea 4" in told
    assert "columnas que no se usan: 'colour'" in told


def test_faults_of_a_record_are_told_in_german(tmp_path: Path) -> None:
    path = tmp_path / "record.csv"
    path.write_text("time_s,ew_g\n0,0.1\n0.01,abc\n0.02,0.1\n", encoding="utf-8")
    with speaking("de"), pytest.raises(InputError) as found:
        read_components(path)
    assert "Zeile 3: erwartet wurde eine Zahl, gefunden 'abc'" in str(found.value)
    path.write_text("time_s,ew_g\n0,0.1\n0.01,0.2\n0.5,0.1\n0.51,0.1\n", encoding="utf-8")
    with speaking("de"), pytest.raises(InputError, match=r"eine Lücke von 0,49 s, wo Schritte"):
        read_components(path)


def test_what_is_logged_is_told_where_it_is_shown() -> None:
    """Template and numbers are those of the language; what a user named stays as it is."""
    record = logging.LogRecord(
        "x", logging.WARNING, "", 0, "%d motions are left out, as the second component of their "
        "recording, or its direction, is not known: %s", (1200, "a.b"), None,
    )  # fmt: skip
    english = "WARNING: 1200 motions are left out"
    format_ = Printable("%(levelname)s: %(message)s").format
    assert format_(record).startswith(english)
    with speaking("de"):
        told = format_(record)
    assert told.startswith("WARNUNG: 1200 Bewegungen werden ausgelassen")
    assert told.endswith(": a.b")
    assert record.levelname == "WARNING"
    turned = logging.LogRecord(
        "x", logging.WARNING, "", 0, "what stands on castors is simulated on a level floor, not on "
        "a tilt of %.3g°, on which free castors may roll away by themselves: %s", (1.5, "x"), None,
    )  # fmt: skip
    # what another library says stays as it is
    of_others = logging.LogRecord("x", logging.WARNING, "", 0, "%(a)G of 5 %%", ({"a": 1.5},), None)
    with speaking("es"):
        assert "con una inclinación de 1,5°" in message_of(turned)
        assert message_of(of_others) == "1.5 of 5 %"


def test_warnings_that_were_kept_are_told_in_another_language(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """A folder is read once; what its readers warned of is kept as they said it."""
    monkeypatch.setattr(cached, "user_cache_path", lambda _: tmp_path / "cache")
    folder = tmp_path / "records"
    folder.mkdir()
    rows = "".join(f"{k / 100:g},{0.1 * (k % 2)}\n" for k in range(20))
    (folder / "one.csv").write_text(f"time_s,ew_g\n{rows}", encoding="utf-8")
    (folder / "notes.txt").write_text("no record\n", encoding="utf-8")
    suite(folder)
    first = [message_of(record) for record in caplog.records]
    caplog.clear()
    with speaking("de"):
        suite(folder)
        again = [message_of(record) for record in caplog.records]
    assert first == [f"{folder}: left out, not records: notes.txt"]
    assert again == [f"{folder}: ausgelassen, keine Aufzeichnungen: notes.txt"]
