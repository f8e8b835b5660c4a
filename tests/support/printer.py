"""What needs a browser that prints, which the lock does not install."""

from __future__ import annotations

import pytest

from shaketable.errors import InputError
from shaketable.report.print_pdf import require_printer


def skip_without_printer() -> None:
    """Skip a test where nothing prints PDFs, and say what would."""
    try:
        require_printer()
    except InputError as error:
        pytest.skip(str(error))
