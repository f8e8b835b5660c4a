"""The command line; its commands are the files of this folder, which `lazy` lists.

Exit codes: 0 done, 1 failed, 2 the user's input.
"""

from __future__ import annotations

import errno
import logging
import sys
from typing import Annotated

import typer

from shaketable.cli.console import Printable, say
from shaketable.cli.examples import epilog
from shaketable.cli.lazy import LazyGroup
from shaketable.errors import InputError, SimulationError
from shaketable.extras import missing, remedy
from shaketable.inputs import require_readable
from shaketable.language import Language, speaking, translated

app = typer.Typer(
    cls=LazyGroup,
    add_completion=False,
    invoke_without_command=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog=epilog(""),
    help="A virtual shake table for things that are not bolted down: "
    "what falls in an earthquake, which way, and what to do.",
)


def _version(asked: bool) -> None:
    if asked:
        from shaketable import __version__

        say(f"shaketable {__version__}")
        raise typer.Exit


class _Once(logging.Filter):
    """Lets each message through once, although a study of many steps may repeat it."""

    def __init__(self) -> None:
        super().__init__()
        self.seen: set[str] = set()

    def filter(self, record: logging.LogRecord) -> bool:
        message = record.getMessage()
        fresh = message not in self.seen
        self.seen.add(message)
        return fresh


@app.callback()
def _options(
    context: typer.Context,
    version: Annotated[
        bool,
        typer.Option(
            "--version", "-V", callback=_version, is_eager=True, help="Print the version."
        ),
    ] = False,
) -> None:
    handler = logging.StreamHandler()
    handler.addFilter(_Once())
    handler.setFormatter(Printable("%(levelname)s: %(message)s"))
    logging.basicConfig(level=logging.WARNING, handlers=[handler])
    if context.invoked_subcommand is None:
        _begin(context)


def _begin(context: typer.Context) -> None:
    """Without any word: the page, or the help where its packages are not installed."""
    if missing("web"):
        say(context.get_help())
        say(f"\nThe page in the browser needs more packages: {remedy('web')}")
        return
    from shaketable.cli.open import open as open_page

    open_page()


@app.command("help")
def help_(
    command: Annotated[list[str] | None, typer.Argument(help="A command, such as assess.")] = None,
) -> None:
    """The help of the program, or of a command."""
    app([*(command or []), "--help"], prog_name="shaketable")


def _spread(arguments: list[str]) -> list[str]:
    """`--motions a b c` as `--motions a --motions b --motions c`."""
    spread: list[str] = []
    within = False
    for argument in arguments:
        if argument.startswith("-"):
            within = argument == "--motions"
            spread.append(argument)
        elif within and spread[-1] != "--motions":
            spread += ["--motions", argument]
        else:
            spread.append(argument)
    return spread


def main() -> None:
    """Entry point of the command line."""
    sys.argv[1:] = _spread(sys.argv[1:])
    try:
        for argument in sys.argv[1:]:
            require_readable(argument)
        app()
    except InputError as error:
        _fail(str(error), 2, getattr(error, "spoken", "en"))
    except SimulationError as error:
        _fail(str(error), 1, getattr(error, "spoken", "en"))
    except OSError as error:
        code = 2 if error.errno == errno.ENAMETOOLONG else 1  # no machine could have such a file
        place = error.filename or _full_stream()
        told = error.strerror or str(error)
        _fail(f"{place}: {told}" if place else told, code)


def _full_stream() -> str | None:
    """The name of a stream that takes no more, None if all do."""
    for name, stream in (("standard output", sys.stdout), ("standard error", sys.stderr)):
        try:
            stream.flush()
        except OSError:
            return name
    return None


def _fail(message: str, code: int, language: Language = "en") -> None:
    from shaketable.cli.spelling import as_options

    for line in as_options(message).splitlines():
        with speaking(language):
            say(f"{translated('error')}: {line}", err=True)
    sys.exit(code)
