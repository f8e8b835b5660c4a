"""Where an ensemble of simulations runs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable

from shaketable.errors import InputError
from shaketable.models import Model
from shaketable.progress import Progress
from shaketable.simulate.ensemble import Group, Part, Rows, run_groups

CPU, CUDA = "cpu", "cuda"
DEVICES = (CPU, CUDA)


def require_device(device: str) -> None:
    """InputError unless there are simulations on such a device."""
    if device not in DEVICES:
        raise InputError(f"unknown device {device!r}; accepted: {', '.join(DEVICES)}")


def run_groups_on(
    device: str,
    model: Model,
    rows: Rows,
    groups: Iterable[Group],
    keep: Callable[[Part], None],
    threads: int | None,
    progress: Progress,
) -> Counter[float]:
    """What `run_groups` does, on a device."""
    if device == CUDA:
        from shaketable.simulate.on_gpu import run_groups_on_gpu

        return run_groups_on_gpu(model, rows, groups, keep, progress)
    return run_groups(model, rows, groups, keep, threads, progress)
