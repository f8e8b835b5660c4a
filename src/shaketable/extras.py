"""Packages that only some of the work needs: the extras of an installation."""

from __future__ import annotations

from importlib.util import find_spec

from shaketable.errors import InputError

#: What each extra brings, by the names that are imported.
EXTRAS = {
    "parquet": ("pyarrow",),
    "seismology": ("obspy",),
    "campaign": ("fsspec", "zarr"),
    "cluster": ("fsspec", "zarr", "distributed"),
    "scenario": ("pygmm",),
    "studies": ("shaketable_studies",),
    "rooms": ("shapely",),
    "gltf": ("pygltflib",),
    "docx": ("docx",),
    "web": ("pyarrow", "shapely", "fastapi", "pebble", "uvicorn"),
    "gpu": ("numba_cuda",),
}


def missing(extra: str) -> str:
    """The first package of an extra that is not installed, or an empty word."""
    return next((name for name in EXTRAS[extra] if find_spec(name) is None), "")


def remedy(extra: str) -> str:
    """How an extra is installed."""
    return f"pip install 'shaketable[{extra}]'"


def require(extra: str, what: str) -> None:
    """InputError unless the packages of an extra are installed.

    Args:
        extra: one of EXTRAS.
        what: needs it.
    """
    package = missing(extra)
    if package:
        raise InputError(f"{what} needs the package {package}: {remedy(extra)}")
