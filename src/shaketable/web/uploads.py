"""Files that visitors upload: how they are called, and what is wrong with them in their words."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

from shaketable.errors import Fault, InputError, refusal
from shaketable.records.text import NO_TIME_STEP, NO_UNIT
from shaketable.units import OFFERED_UNITS

#: What mends a fault here, where the command line has options.
MENDED = {
    NO_UNIT: f"give units, one of {', '.join(OFFERED_UNITS)}",
    NO_TIME_STEP: "give time_step_s with the time step [s], and units where it names none",
}


class Upload(NamedTuple):
    """A file of a visitor.

    Attributes:
        path: where it lies here.
        name: that the visitor gave it.
    """

    path: Path
    name: str

    @classmethod
    def written(cls, folder: Path, name: str, data: bytes) -> Upload:
        """A file, written into a folder; its name chooses the format."""
        path = folder / safe_name(name)
        path.write_bytes(data)
        return cls(path, name)

    def fault(self, fault: Fault) -> Fault:
        """A fault with the visitor's own name of the file, or of what is in it."""
        mend = MENDED.get(fault.kind, fault.mend)
        return fault._replace(mend=mend).called(self.path, self.name)

    def refusal(self, error: InputError) -> InputError:
        """An error in the visitor's words."""
        return refusal([self.fault(each) for each in error.listed])


def safe_name(name: str) -> str:
    """A visitor's name of a file, of letters that any folder takes, and never hidden."""
    return "file_" + re.sub(r"[^A-Za-z0-9._-]", "_", name)[-60:]
