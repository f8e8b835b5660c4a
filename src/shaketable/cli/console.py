"""What commands tell in the terminal."""

from __future__ import annotations

import logging

import typer

from shaketable.errors import printable


def say(text: str, *, err: bool = False) -> None:
    """Print lines, control characters that names brought along as escapes."""
    try:
        typer.echo("\n".join(map(printable, text.split("\n"))), err=err)
    except OSError as error:
        error.filename = "standard error" if err else "standard output"
        raise


class Printable(logging.Formatter):
    """Log messages with control characters as escapes."""

    def format(self, record: logging.LogRecord) -> str:
        return "\n".join(map(printable, super().format(record).split("\n")))
