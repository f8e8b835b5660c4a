"""Errors that a user can mend, kept apart from what went wrong inside."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple, TypeVar

from shaketable.language import tell

MOST_FAULTS = 100  # in one message

#: Extra of a logged message that counts something: its numbers add up over the sets of a run.
ADDS_UP = "adds_up"


class InputError(ValueError):
    """The user's input cannot be used; the message says where, what was found and what is accepted.

    The command line then ends with exit code 2.

    Attributes:
        faults: of a file, which the message lists; empty where it is about no file.
    """

    faults: tuple[Fault, ...] = ()

    @property
    def listed(self) -> tuple[Fault, ...]:
        """The faults, or what the message says as one of them."""
        return self.faults or (Fault("", "", "", "other", str(self)),)


class Fault(NamedTuple):
    """What is wrong with a file.

    Attributes:
        path: the file.
        where: the place in it, as "line 7" or "cell B7"; empty if it is all of it.
        column: its column's header, or the field; empty if it is none's.
        kind: of the fault, one word for programs.
        text: what is wrong, in words.
        mend: how an option of the command line, or an argument in Python, mends it.
    """

    path: object
    where: str
    column: str
    kind: str
    text: str
    mend: str = ""

    def called(self, path: Path, name: str) -> Fault:
        """The fault with another name of a file, if it is about that file or about a part of it."""
        place = Path(str(self.path))
        if not self.path or not place.is_relative_to(path):
            return self
        part = place.relative_to(path)
        return self._replace(path=f"{name}/{part}" if part.parts else name)

    def __str__(self) -> str:
        place = ", ".join(str(each) for each in (self.path, self.where, self.column) if each)
        return f"{place}: {self.said}" if place else self.said

    @property
    def said(self) -> str:
        """What is wrong and how to mend it; after a question, the answer is a sentence."""
        text, mend = str(self.text), str(self.mend)
        if mend and text.endswith("?"):
            return f"{text} {mend[0].upper()}{mend[1:]}"
        return f"{text}; {mend}" if mend else text


Refusal = TypeVar("Refusal", bound=InputError)


def refusal(faults: Sequence[Fault], error: type[Refusal] = InputError) -> Refusal:  # type: ignore[assignment]
    """The error of a file with faults: one of them a line."""
    found = error(joined([str(fault) for fault in faults]))
    found.faults = tuple(faults)
    return found


def refused(
    path: object, text: str, *, where: str = "", column: str = "", kind: str = "file"
) -> InputError:
    """The error of a file with one fault."""
    return refusal([Fault(path, where, column, kind, text)])


def remark(path: object, text: str) -> Fault:
    """What a file's user should look at, to be logged; it is used nevertheless."""
    return Fault(path, "", "", "remark", text)


def require_number(name: str, value: object) -> None:
    """InputError unless the value is one number; infinity and NaN are numbers here."""
    try:
        if not isinstance(value, str):
            float(value)  # type: ignore[arg-type]  # what cannot be converted is refused
            return
    except (TypeError, ValueError, OverflowError):
        pass
    raise InputError(f"{name} must be a number, got {value!r:.100}")


def keep_floats(thing: object, *names: str) -> None:
    """Make fields of a frozen dataclass floats, whatever numbers they were given as.

    For each other type of number the kernels would be compiled anew, which takes a minute.
    """
    for name in names:
        value = getattr(thing, name)
        if value is not None:
            object.__setattr__(thing, name, float(value))


def require_positive(name: str, value: float) -> None:
    """InputError unless the value is positive and finite."""
    require_number(name, value)
    if not (math.isfinite(value) and value > 0.0):
        raise InputError(f"{name} must be a positive finite number, got {value!r}")


def require_not_negative(name: str, value: float) -> None:
    """InputError unless a number is 0 or more, and finite."""
    require_number(name, value)
    if not 0.0 <= value < math.inf:
        raise InputError(f"{name} must be 0 or more and finite, got {value!r}")


def require_whole(name: str, value: object) -> None:
    """InputError unless the value is a whole number above zero."""
    if isinstance(value, bool) or not isinstance(value, int) or value < 1:
        raise InputError(f"{name} must be a positive whole number, got {value!r}")


def require_damping(value: float) -> None:
    """InputError unless the value is a ratio of critical damping below 1."""
    require_number("damping", value)
    if not 0.0 <= value < 1.0:
        raise InputError(f"damping must be in [0, 1), got {value!r}")


def printable(text: str) -> str:
    """A text with its control characters written as escapes, which a terminal would obey."""
    return "".join(one if one.isprintable() else repr(one)[1:-1] for one in text)


def quoted(text: str) -> str:
    """A piece of the user's input for a message: in quotes, on one line, of at most 60 characters.

    Control characters are written as escapes: a terminal would obey them.
    """
    shown = repr(text[:60])
    return shown if len(text) <= 60 else f"{shown[:-1]}…{shown[-1]}"


def named(names: Sequence[str], most: int) -> str:
    """The first of some names, and how many more there are."""
    more = tell(" and {more:,} more", more=len(names) - most) if len(names) > most else ""
    return ", ".join(names[:most]) + more


def joined(faults: list[str]) -> str:
    """Several faults as one message, one per line; of very many the first ones."""
    more = len(faults) - MOST_FAULTS
    rest = [tell("... and {more:,} more", more=more)] if more > 0 else []
    return "\n".join([*faults[:MOST_FAULTS], *rest])


class SimulationError(RuntimeError):
    """A run failed or was stopped, or what is stored is damaged or unusable; the message says why.

    The command line then ends with exit code 1.
    """
