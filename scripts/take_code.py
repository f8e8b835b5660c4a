"""Give a checkout the machine code that a wheel of the same sources brings: nothing is compiled.

    python -m scripts.take_code dist/shaketable-0.2.0-cp311-cp311-manylinux_2_28_x86_64.whl

`make CODE=<wheel>` does it before all else. Such wheels are made by `make wheel`, and by the
release workflow for each Python. Nothing is fetched. What does not fit (other sources, another
Python, Numba or processor) is not used, as everywhere (`shaketable.compiled.caches`).
"""

from __future__ import annotations

import sys
import zipfile
from pathlib import Path, PurePosixPath

from shaketable.compiled.caches import SHIPPED, fits_here
from shaketable.compiled.sources import COMPILED_TOGETHER, source_hash

INSIDE = PurePosixPath("shaketable/machine_code")


def take(wheel: Path, target: Path) -> str:
    """Write the wheel's machine code there, and say how much of it these sources can use."""
    with zipfile.ZipFile(wheel) as file:
        names = [each for each in map(PurePosixPath, file.namelist()) if INSIDE in each.parents]
        for name in names:
            place = target / name.relative_to(INSIDE)
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(file.read(str(name)))
    if not names:
        return f"{wheel.name}: no machine code in it; make wheel builds one that has it"
    wanted = {f"{group}-{source_hash(group)}" for group in COMPILED_TOGETHER}
    fit = wanted & {name.relative_to(INSIDE).parts[0] for name in names}
    if not fits_here():
        return f"{wheel.name}: not for this processor; drivers are compiled when they are needed"
    return f"{wheel.name}: machine code for {len(fit)} of {len(wanted)} groups of these sources" + (
        "" if fit == wanted else "; the others have changed, and are compiled when needed"
    )


if __name__ == "__main__":
    try:
        print(take(Path(sys.argv[1]), SHIPPED))
    except (OSError, zipfile.BadZipFile) as error:
        sys.exit(f"{sys.argv[1]}: {error}; CODE= takes a wheel of `make wheel`")
