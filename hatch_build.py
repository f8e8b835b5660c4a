"""Build hook: a wheel with the machine code that scripts/compile_wheel.py has made, if it has.

SHAKETABLE_MACHINE_CODE names its folder. Without it, as in an installation from the sources, the
wheel is for every platform, and drivers are compiled where they are first needed.
"""

from __future__ import annotations

import os
import sys
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

PLATFORM = "manylinux_2_28_x86_64"  # machine code that is linked when it is read: no shared library


class MachineCode(BuildHookInterface[Any]):
    """Adds the folder, and says for which interpreter and platform the wheel is then."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        folder = os.environ.get("SHAKETABLE_MACHINE_CODE")
        if folder and version != "editable":
            python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
            build_data["force_include"][folder] = "shaketable/machine_code"
            build_data["pure_python"] = False
            build_data["tag"] = f"{python}-{python}-{PLATFORM}"
