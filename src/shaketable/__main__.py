"""Where the command begins; Ctrl-C while the rest is imported ends it without a traceback."""

from __future__ import annotations

import sys


def main() -> None:
    """Entry point of the command, and of `python -m shaketable`."""
    try:
        from shaketable.cli import main as run

        run()
    except KeyboardInterrupt:
        sys.exit("Aborted.")


if __name__ == "__main__":
    main()
