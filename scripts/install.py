"""Install what a lock file pins, hashes and all: by uv, which takes seconds, or else by pip.

    python scripts/install.py requirements.lock      # into the environment of that Python

uv is the one at hand, or the one that the first lock file pins. Both take the same versions from
the same index; where uv cannot (no wheel for this platform, an index that pip alone is told of),
pip does it. Bytecode is compiled once, on all cores: processes that start side by side would each
compile it for themselves.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def main() -> None:
    lock = Path(sys.argv[1])
    text = lock.read_text(encoding="utf-8")
    count = len(set(re.findall(r"^([\w.-]+)==", text, re.MULTILINE)))
    print(f"{lock.name}: {count} packages, once; uv takes seconds, pip a minute or two", flush=True)
    begun = time.monotonic()
    tool = "uv" if by_uv(lock) else "pip"
    if tool == "pip":
        subprocess.run([*PIP, "--no-compile", "-r", str(lock)], check=True)
        compiling = [sys.executable, "-m", "compileall", "-q", "-j", "0"]
        subprocess.run([*compiling, sysconfig.get_path("purelib")], check=False)
    print(f"{lock.name}: installed by {tool} in {time.monotonic() - begun:.0f} s", flush=True)


PIP = [sys.executable, "-m", "pip", "install", "--quiet", "--require-hashes"]


def by_uv(lock: Path) -> bool:
    """Whether uv is there, or can be had, and does it."""
    uv = shutil.which("uv") or pinned_uv()
    given = ["--quiet", "--require-hashes", "--compile-bytecode", "--python", sys.executable]
    return (
        uv is not None and not subprocess.run([uv, "pip", "install", *given, "-r", lock]).returncode
    )


def pinned_uv() -> str | None:
    """The uv of this environment, installed if it is not there yet."""
    place = shutil.which("uv", path=sysconfig.get_path("scripts"))
    if place is not None:
        return place
    found = re.search(
        r"^uv==(?:.*\\\n)+.*\n", (ROOT / "requirements.lock").read_text("utf-8"), re.MULTILINE
    )
    if found is None:
        return None
    with tempfile.TemporaryDirectory() as folder:
        only = Path(folder, "uv.txt")
        only.write_text(found[0])
        subprocess.run([*PIP, "--no-deps", "-r", str(only)], check=False)
    return shutil.which("uv", path=sysconfig.get_path("scripts"))


if __name__ == "__main__":
    main()
