"""A page as PDF, by a browser or by WeasyPrint, whichever is at hand."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from importlib.util import find_spec
from pathlib import Path

from shaketable.errors import InputError

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "msedge")
SECONDS = 120.0  # a browser that takes longer hangs


def require_printer() -> None:
    """InputError unless something prints PDFs."""
    if _browser() is None and find_spec("weasyprint") is None:
        raise InputError(
            f"--pdf: needs a browser ({', '.join(BROWSERS)}) on the path, or WeasyPrint (pip "
            "install weasyprint); or open report.html and print it"
        )


def print_pdf(page: Path, pdf: Path) -> None:
    """Print a page.

    Args:
        page: an HTML file that needs no other.
        pdf: is written.

    Raises:
        InputError: nothing that prints, or it failed.
    """
    require_printer()
    browser = _browser()
    if browser is None:
        from weasyprint import HTML

        HTML(filename=str(page)).write_pdf(str(pdf))
        return
    with tempfile.TemporaryDirectory(prefix="shaketable-") as profile:
        command = [
            browser,
            "--headless",
            "--disable-gpu",
            "--no-pdf-header-footer",
            f"--user-data-dir={profile}",
            f"--print-to-pdf={pdf}",
            page.absolute().as_uri(),
        ]
        if hasattr(os, "geteuid") and os.geteuid() == 0:
            command.insert(1, "--no-sandbox")  # as root a browser does not start with it
        try:
            done = subprocess.run(command, capture_output=True, timeout=SECONDS, check=False)  # noqa: S603  a browser from the path
        except (OSError, subprocess.TimeoutExpired) as error:
            raise InputError(f"--pdf: {browser}: {error}") from None
    if not pdf.is_file():
        said = done.stderr.decode(errors="replace").strip().splitlines()
        raise InputError(f"--pdf: {browser} wrote nothing: {said[-1] if said else 'no reason'}")


def _browser() -> str | None:
    return next((found for name in BROWSERS if (found := shutil.which(name))), None)
