"""What commands tell in the terminal."""

from __future__ import annotations

import logging
from copy import copy

import typer

from shaketable.errors import printable
from shaketable.language import message_of, translated


def say(text: str, *, err: bool = False) -> None:
    """Print lines, control characters that names brought along as escapes."""
    try:
        typer.echo("\n".join(map(printable, text.split("\n"))), err=err)
    except OSError as error:
        error.filename = "standard error" if err else "standard output"
        raise


def say_line(text: str) -> None:
    """Print one line; line breaks of names in it are escapes, too."""
    say(printable(text))


class Printable(logging.Formatter):
    """Log messages in the language that is spoken, with control characters as escapes."""

    def format(self, record: logging.LogRecord) -> str:
        told = copy(record)
        told.msg, told.args, told.levelname = message_of(record), None, translated(record.levelname)
        return "\n".join(map(printable, super().format(told).split("\n")))
