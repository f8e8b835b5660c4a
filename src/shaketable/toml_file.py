"""TOML files that describe something: read with a schema, their faults told with their lines."""

from __future__ import annotations

import re
import sys
import tomllib
from collections.abc import Mapping, Sequence
from enum import StrEnum
from pathlib import Path
from typing import Any, TypeGuard, TypeVar

from shaketable.errors import Fault, refusal, refused
from shaketable.inputs import read_file
from shaketable.language import tell, translated

WORDS = {
    str: "text",
    int: "a whole number",
    float: "a number",
    bool: "true or false",
    list: "a list",
    dict: "a table",
}

E = TypeVar("E", bound=StrEnum)


class TomlFile:
    """A TOML file whose faults are told with their lines."""

    def __init__(self, path: Path) -> None:
        """Read it.

        Raises:
            InputError: it cannot be read, or is no TOML.
        """
        self.path = path
        content = read_file(path)
        try:
            self._text = content.decode("utf-8-sig")
            self.table = tomllib.loads(self._text)
        except (ValueError, RecursionError) as error:
            raise refused(path, tell("not a TOML file ({error})", error=error)) from None
        self.faults: list[Fault] = []

    def accept(self, schema: Mapping[str, type | tuple[type, ...] | Sequence[str]]) -> None:
        """Note what is in it that a schema does not know.

        Args:
            schema: by the names of the file's keys their kinds, `object` for any; by the names of
                its tables their keys.
        """
        for name, value in self.table.items():
            known = schema.get(name)
            if known is None:
                self.fault(name, tell("unknown; accepted: {accepted}", accepted=", ".join(schema)))
            elif isinstance(known, type) or isinstance(known[0], type):
                self._fits(name, value, known)  # type: ignore[arg-type]
            elif not isinstance(value, dict):
                self.fault(name, tell("must be a table, [{name}]", name=name))
            else:
                for key in value:
                    if key not in known:
                        accepted = ", ".join(known)  # type: ignore[arg-type]
                        self.fault(
                            f"{name}.{key}",
                            tell("unknown; accepted: {accepted}", accepted=accepted),
                        )

    def fault(self, key: str, message: str) -> None:
        """Note what is wrong with a key."""
        last = re.escape(key.rsplit(".", 1)[-1])
        lines = self._text.split("\n")
        there = re.compile(rf"\s*\[?(\w+\.)*{last}\s*[=\]]")
        at = [k for k, line in enumerate(lines, 1) if there.match(line)]
        self.note(f"line {at[0]}" if at else "", key, message)

    def note(self, where: str, key: str, message: str) -> None:
        """Note a fault of a place that is known."""
        self.faults.append(Fault(self.path, where, key, "field", message))

    def tables(self, section: str) -> list[TomlTable]:
        """The tables of a name, each begun by [[name]]."""
        found = self.table.get(section, [])
        if not isinstance(found, list) or not all(isinstance(each, dict) for each in found):
            self.fault(section, tell("must be tables, each begun by [[{name}]]", name=section))
            return []
        return [TomlTable(self, each, section, k) for k, each in enumerate(found)]

    def line_of(self, section: str, number: int, key: str) -> str:
        """Where a key of the number-th table of a name stands; "" if it is not found.

        Where the key is not there the table's own line is given.
        """
        lines = self._text.split("\n")
        begun = re.compile(rf"\s*\[\[\s*{re.escape(section)}\s*\]\]")
        heads = [k for k, line in enumerate(lines) if begun.match(line)]
        first = heads[number] if section and number < len(heads) else 0
        for k in range(first, len(lines)):
            if k > first and section and lines[k].lstrip().startswith("["):
                break
            if re.match(rf"\s*{re.escape(key)}\s*=", lines[k]):
                return f"line {k + 1}"
        return f"line {first + 1}" if section else ""

    def get(self, section: str, key: str, kinds: type | tuple[type, ...], default: Any) -> Any:
        """The value of a key, or a default where it is missing or wrong."""
        table = self.table.get(section, {})
        if not isinstance(table, dict) or key not in table:
            return default
        return table[key] if self._fits(f"{section}.{key}", table[key], kinds) else default

    def _fits(self, key: str, value: Any, kinds: type | tuple[type, ...]) -> bool:
        """Whether a value is of some kinds; notes it where it is not."""
        accepted = kinds if isinstance(kinds, tuple) else (kinds,)
        wrong = isinstance(value, bool) and not {bool, object} & set(accepted)
        if wrong or not isinstance(value, accepted):
            named = [kind for kind in accepted if kind is not int or float not in accepted]
            told = translated(" or ").join(translated(WORDS[kind]) for kind in named)
            self.fault(key, tell("expected {told}, found {value!r}", told=told, value=value))
            return False
        if isinstance(value, int) and float in accepted and not is_number(value):
            self.fault(key, tell("the number is too large"))
            return False
        return True

    def has(self, key: str) -> bool:
        """Whether a table, or a key of one, is there."""
        section, _, name = key.partition(".")
        table = self.table.get(section)
        return table is not None and (not name or (isinstance(table, dict) and name in table))

    def numbers(self, section: str, key: str, default: Sequence[float]) -> list[float]:
        """A number or a list of them."""
        value = self.get(section, key, (int, float, list), list(default))
        found = value if isinstance(value, list) else [value]
        if not found or not all(is_number(each) for each in found):
            self.fault(
                f"{section}.{key}",
                tell("expected a number or a list of numbers, found {value!r}", value=value),
            )
            return list(default)
        return [float(each) for each in found]

    def require(self) -> None:
        """InputError with all faults, if there are any."""
        if self.faults:
            raise refusal(self.faults)


class TomlTable:
    """One of several tables of a name, or what stands before all tables."""

    def __init__(
        self, file: TomlFile, table: Mapping[str, Any], section: str = "", number: int = 0
    ) -> None:
        """The table of a file; the number-th of its name from 0."""
        self.file, self.table, self.number = file, table, number
        self._section = section

    def line(self, key: str) -> str:
        """Where a key stands."""
        return self.file.line_of(self._section, self.number, key)

    def fault(self, key: str, message: str) -> None:
        """Note what is wrong with a key."""
        self.file.note(self.line(key), key, message)

    def accept(self, keys: Sequence[str]) -> None:
        """Note the keys that are unknown."""
        for key in self.table.keys() - {*keys}:
            self.fault(key, tell("unknown; accepted: {accepted}", accepted=", ".join(keys)))

    def text(self, key: str, default: str) -> str:
        """A text."""
        value = self.table.get(key, default)
        if not isinstance(value, str):
            self.fault(key, tell("expected text, found {value!r}", value=value))
            return default
        return value.strip()

    def yes(self, key: str, default: bool) -> bool:
        """True or false."""
        value = self.table.get(key, default)
        if not isinstance(value, bool):
            self.fault(key, tell("expected true or false, found {value!r}", value=value))
            return default
        return value

    def number_from(
        self, key: str, default: float | None, least: float, most: float
    ) -> float | None:
        """A number between two others; None if it is none, or is not there and has no default."""
        value = self.table.get(key, default)
        if value is None:
            return None
        if not is_number(value) or not least <= value <= most:
            self.fault(
                key,
                tell(
                    "expected a number from {least:g} to {most:g}, found {value!r}",
                    least=least,
                    most=most,
                    value=value,
                ),
            )
            return None
        return float(value)

    def values(self, key: str, default: Sequence[Any]) -> list[Any]:
        """A list with at least one entry."""
        value = self.table.get(key, [*default])
        if not isinstance(value, list) or not value:
            self.fault(key, tell("expected a list, found {value!r}", value=value))
            return [*default]
        return value

    def word(self, key: str, kinds: type[E], default: E | None) -> E | None:
        """One of some words; None if it is none of them."""
        value = self.table.get(key, default)
        if value in list(kinds):
            return kinds(value)
        accepted = ", ".join(kinds)
        self.fault(
            key, tell("expected one of {accepted}, found {value!r}", accepted=accepted, value=value)
        )
        return None


def is_number(value: object) -> TypeGuard[int | float]:
    """Whether a value of a TOML file is a finite number."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    return abs(value) <= sys.float_info.max  # an integer may be too large for a float
