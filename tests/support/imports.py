"""What the package's files import, read from their text."""

from __future__ import annotations

import ast
from pathlib import Path

import shaketable

PACKAGE = Path(shaketable.__file__).parent
FILES = sorted(path for path in PACKAGE.rglob("*.py") if path != PACKAGE / "__init__.py")


def names(path: Path) -> set[str]:
    """What a file imports, inside functions and for types too: every name may be a module."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return {name for name in found if name.startswith("shaketable.")}


def module_of(path: Path) -> str:
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return ".".join(("shaketable", *(parts[:-1] if parts[-1] == "__init__" else parts)))


MODULES = {module_of(path): path for path in FILES}


def modules(path: Path) -> set[str]:
    """The package's modules that a file imports."""
    found = set()
    for name in names(path):
        while name not in MODULES and "." in name:
            name = name.rpartition(".")[0]
        found |= {name} & MODULES.keys()
    return found - {module_of(path)}
