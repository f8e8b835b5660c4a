"""The kernels compile for a GPU: to PTX, which takes the toolkit's packages and no device."""

from __future__ import annotations

import importlib
import pkgutil
from types import SimpleNamespace
from typing import Any

import pytest

from shaketable.engine import general_one, rocking_one
from shaketable.physics import plane
from shaketable.physics.plane import rocking, sliding, sticking
from shaketable.physics.plane.contact import ContactBody, Pose
from shaketable.physics.plane.extremes import Log
from shaketable.physics.plane.forcing import Forcing, Shaking

pathfinder = pytest.importorskip("cuda.pathfinder", reason="pip install '.[gpu]'")
try:
    pathfinder.load_nvidia_dynamic_lib("nvrtc")
except pathfinder.DynamicLibNotFoundError:
    pytest.skip("CUDA's compiler is not here: pip install '.[gpu]'", allow_module_level=True)

CAPABILITY = (9, 0)
#: What only the whole kernel of the general model calls, which compiles for half a minute.
GENERAL_ALONE = {
    f"shaketable.physics.plane.sticking.{name}_sticking" for name in ("step", "bounce")
}

#: What was compiled in this process: nothing is compiled twice.
COMPILED: set[str] = set()


@pytest.fixture
def reached(monkeypatch: pytest.MonkeyPatch) -> set[str]:
    """Names of the functions that are compiled from now on; the device is pretended."""
    from numba.cuda import dispatcher

    names = COMPILED
    compile_cuda = dispatcher.compile_cuda

    def noting(function: Any, *args: Any, **options: Any) -> Any:
        names.add(f"{function.__module__}.{function.__qualname__}")
        return compile_cuda(function, *args, **options)

    device = SimpleNamespace(compute_capability=CAPABILITY)
    monkeypatch.setattr(dispatcher, "get_current_device", lambda: device)
    monkeypatch.setattr(dispatcher, "compile_cuda", noting)
    return names


def numbers(kind: type[Any]) -> Any:
    """The type of a NamedTuple of numbers and of such NamedTuples in compiled code."""
    from numba import types

    from shaketable.physics.plane.layout import _nested

    fields = [numbers(inner) if inner else types.float64 for inner in _nested(kind).values()]
    return tuple_type(kind, fields)


def tuple_type(kind: type[Any], fields: list[Any]) -> Any:
    from numba import types

    if len(set(fields)) == 1:
        return types.NamedUniTuple(fields[0], len(fields), kind)
    return types.NamedTuple(fields, kind)


def ptx(function: Any, *arguments: Any) -> str:
    from numba.cuda import compile_ptx

    code, _ = compile_ptx(function.py_func, arguments, device=True, cc=CAPABILITY)
    return str(code)


def launched(member: Any) -> str:
    """The machine code of a kernel as it is launched."""
    from numba import types
    from numba.cuda import compile_ptx

    array, table = types.Array(types.float64, 1, "C"), types.Array(types.float64, 2, "C")
    whole, codes = types.Array(types.int64, 1, "C"), types.Array(types.int8, 1, "C")
    ground = (array, array, array, whole, whole, array)
    members = (table, table, table, whole, whole, table, array, codes)
    code, _ = compile_ptx(member, (*ground, *members), cc=CAPABILITY)
    return str(code)


@pytest.mark.slow
def test_the_general_model_compiles_for_a_gpu(reached: set[str]) -> None:
    """As it is launched: it holds a whole simulation, and takes half a minute."""
    from shaketable.engine import cuda_kernels

    assert ".entry" in launched(cuda_kernels.move_member)
    assert reached >= GENERAL_ALONE


def test_every_kernel_compiles_for_a_gpu(reached: set[str]) -> None:
    from numba import types
    from numba.core.dispatcher import Dispatcher

    from shaketable.engine import cuda_kernels

    real, array = types.float64, types.Array(types.float64, 1, "C")
    codes, table = types.Array(types.int8, 1, "C"), types.Array(types.float64, 2, "C")
    # a body at a time: these two are what runs on a device
    history = tuple_type(rocking_one.History, [array] * 4)
    motion = (tuple_type(Shaking, [array, array, real]), array, real)
    assert "ret" in ptx(rocking_one.rock_one, *motion, history, array)
    trace = tuple_type(general_one.Trace, [array] * 8)
    log = tuple_type(Log, [array, array, codes, codes])
    scratch = tuple_type(general_one.Scratch, [trace, log, table])
    assert "ret" in ptx(general_one.move_one, *motion, scratch, array)
    # the whole kernel of the rocking model, as it is launched
    assert ".entry" in launched(cuda_kernels.rock_member)
    # what only vector lanes and tables ask for
    body, corners = numbers(ContactBody), numbers(sticking.StickingCorners)
    block, state = numbers(rocking.Block), numbers(rocking.State)
    cone, forcing = numbers(sticking.Cone), numbers(Forcing)
    pose = tuple_type(Pose, [types.int64, *[real] * 6])
    others = {
        rocking.make_block: (numbers(rocking.Size), real, real),
        rocking.least_demand: (block,),
        sticking.make_corners: (body,),
        sticking.corner_of: (corners, real),
        sticking.sticks_throughout: (block, corners, state, real, forcing),
        sticking.sag: (real, real, real, real, forcing),
        sticking.margin: (cone, real, real, real, real, real, real),
        sticking.resting_block: (body,),
        sticking.pose_of: (body, state, real),
        sticking.state_of: (body, pose),
        sliding.only_slides: (body, motion[0], real),
        sliding.slide_all: (body, motion[0], real, real),
    }
    for function, arguments in others.items():
        ptx(function, *arguments)
        reached.add(f"{function.py_func.__module__}.{function.py_func.__qualname__}")

    every = set()
    for found in pkgutil.iter_modules(plane.__path__, "shaketable.physics.plane."):
        for each in vars(importlib.import_module(found.name)).values():
            if isinstance(each, Dispatcher):
                every.add(f"{each.py_func.__module__}.{each.py_func.__qualname__}")
    assert len(every) > 100
    assert every - reached <= GENERAL_ALONE
