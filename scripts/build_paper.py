"""The paper as PDF: python -m scripts.build_paper, into paper/paper.pdf.

The journal builds its own from paper.md; this one shows what its readers will see. It needs
pypandoc_binary and typst, which are installed into a folder that is thrown away.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

PAPER = Path(__file__).parents[1] / "paper"
WORDS = (750, 1750)  # what the journal takes
BUILD = """
import sys
import pypandoc
import typst
from pathlib import Path
text = pypandoc.convert_file("paper.md", "typst", extra_args=["--citeproc", "--standalone"])
source = Path(sys.argv[1]) / "paper.typ"
source.write_text(text, encoding="utf-8")
typst.compile(str(source), output="paper.pdf")
"""


def words() -> int:
    """Words of the paper, without its head and its references."""
    text = (PAPER / "paper.md").read_text(encoding="utf-8")
    return len(text.split("---", 2)[2].split("# References")[0].split())


def main() -> None:
    """Build the PDF."""
    with tempfile.TemporaryDirectory() as folder:
        wanted = ["pypandoc_binary", "typst"]
        pip = [sys.executable, "-m", "pip", "install", "--quiet", "--target", folder, *wanted]
        subprocess.run(pip, check=True)
        command = [sys.executable, "-c", BUILD, folder]
        subprocess.run(command, cwd=PAPER, env={"PYTHONPATH": folder}, check=True)
    low, high = WORDS
    print(f"{PAPER / 'paper.pdf'}: {words():,} words of {low} to {high:,}")


if __name__ == "__main__":
    main()
