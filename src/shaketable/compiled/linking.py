"""Functions that compiled functions call: lowered one by one, optimised in their driver.

Numba optimises, emits and wraps every function by itself, with all that it calls linked in: a
function six calls deep is optimised and emitted six times. Here an inner function is turned into
LLVM's language and kept so; the driver that reaches it links each of them once, and what results
is optimised and emitted once. What Python calls is compiled as a driver is.

This builds on parts of Numba that it does not promise to keep. Where they are not as they are
known, the import of this module fails, and `decorators` do without it.
"""
# mypy: allow-untyped-calls, allow-subclassing-any, allow-untyped-decorators
# mypy: disable-error-code="attr-defined, assignment, import-untyped"

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numba
from llvmlite import binding
from numba.core import codegen, compiler, errors, types, typing
from numba.core.caching import NullCache
from numba.core.compiler_machinery import register_pass
from numba.core.funcdesc import PythonFunctionDescriptor
from numba.core.lowering import Lower
from numba.core.registry import CPUDispatcher
from numba.core.typed_passes import BaseNativeLowering, NativeLowering

from shaketable.compiled.caches import cache_of
from shaketable.compiled.sources import group_of

TRIED = ((0, 64), (0, 68))  # versions of Numba, from and to
#: Lets loops over lanes use 512-bit registers, which LLVM avoids on Intel's processors unless it
#: is told. W1 runs 1.12 times as fast, with results equal to the bit. Where there
#: are no such registers it does nothing.
WIDE = '"prefer-vector-width"="512"'
USED = (
    "add_ir_module",
    "add_linking_library", "enable_object_caching", "_raise_if_finalized",
    "_get_module_for_linking", "_finalize_final_module",
)  # fmt: skip


def _require_known() -> None:
    """Raise ImportError where Numba's version is none of those that this was tried with."""
    found = re.match(r"(\d+)\.(\d+)", numba.__version__)
    if found is None or not TRIED[0] <= (int(found[1]), int(found[2])) <= TRIED[1]:
        raise ImportError(f"Numba {numba.__version__} is not known from within")
    missing = [name for name in USED if not hasattr(codegen.JITCodeLibrary, name)]
    if missing:
        raise ImportError(f"Numba {numba.__version__} has no {', '.join(missing)}")


_require_known()


class InnerLibrary(codegen.JITCodeLibrary):
    """The code of an inner function alone, and the libraries of what it calls."""

    _own: Any = None

    def add_linking_library(self, library: Any) -> None:
        self._linking_libraries.append(library)

    def finalize(self) -> None:
        """Link all that it calls, for a caller that Numba compiles in its own way."""
        self._raise_if_finalized()
        _link(self._final_module, _callees(self))
        self._finalized = True

    def own(self) -> Any:
        """Its module, which several drivers may link, and drop what they do not use."""
        if self._own is None:
            self._own = self._final_module.clone()
            for function in self._own.functions:
                if not function.is_declaration and function.linkage == binding.Linkage.external:
                    function.linkage = "linkonce_odr"
        return self._own


class DriverLibrary(codegen.JITCodeLibrary):
    """The code of a driver with all that it reaches, optimised and emitted here."""

    def add_ir_module(self, module: Any) -> None:
        for function in module.functions:
            if not function.is_declaration:
                set.add(function.attributes, WIDE)  # llvmlite lists no such attribute
        super().add_ir_module(module)

    def add_linking_library(self, library: Any) -> None:
        self._linking_libraries.append(library)

    def finalize(self) -> None:
        self._raise_if_finalized()
        self._codegen._check_llvm_bugs()
        callees = _callees(self)
        for library in callees:
            self._reload_init.update(library._reload_init)
        _link(self._final_module, callees)
        # Numba would first inline everything, before anything is simplified: minutes for a large
        # driver. LLVM's own order goes from what is called to what calls.
        passes, builder = self._codegen._module_pass_manager()
        passes.run(self._final_module, builder)
        self._final_module.verify()
        self._finalize_final_module()


def _link(module: Any, libraries: list[Any]) -> None:
    for library in libraries:
        inner = isinstance(library, InnerLibrary)
        module.link_in(library.own() if inner else library._get_module_for_linking(), preserve=True)


def _callees(library: Any) -> list[Any]:
    """All libraries that one needs, each once and after those that need it.

    LLVM takes from a module what has been asked for by then.
    """
    found: dict[int, Any] = {}

    def visit(each: Any) -> None:
        if id(each) not in found:
            if isinstance(each, InnerLibrary | DriverLibrary):
                for callee in each._linking_libraries:
                    visit(callee)
            found[id(each)] = each

    for callee in library._linking_libraries:
        visit(callee)
    return list(reversed(found.values()))


class _Entry:
    """Stands for the machine code of an inner function, which has none of its own."""


@register_pass(mutates_CFG=True, analysis_only=False)
class _InnerLowering(BaseNativeLowering):
    """Turns an inner function into LLVM's language; no wrapper, no machine code."""

    _name = "inner_lowering"
    lowering_class = Lower

    def run_pass(self, state: Any) -> bool:
        context, flags = state.targetctx, state.flags
        _require_no_arrays_made(context, state)
        library = state.library = InnerLibrary(context.codegen(), state.func_id.func_qualname)
        library._reload_init.update(state.reload_init)
        description = PythonFunctionDescriptor.from_specialized_function(
            state.func_ir, state.typemap, state.return_type, state.calltypes,
            mangler=context.mangler, inline=flags.forceinline, noalias=flags.noalias,
            abi_tags=[flags.get_mangle_string()],
        )  # fmt: skip
        with context.push_code_library(library):
            lower = Lower(context, library, description, state.func_ir, metadata=state.metadata)
            lower.lower()
        entry = _Entry()
        context.insert_user_function(entry, description, [library])
        state.reload_init.extend(library._reload_init)
        state["cr"] = compiler._LowerResult(
            description, lower.call_helper, cfunc=entry, env=lower.env
        )
        state.metadata.update(llvm_pass_timings=library.recorded_timings, prune_stats=None)
        return True


def _require_no_arrays_made(context: Any, state: Any) -> None:
    """References to arrays are not counted in functions that make none: none may be returned."""
    model = context.data_model_manager[state.return_type]
    if not context.enable_nrt and model.contains_nrt_meminfo():
        raise errors.UnsupportedError(
            f"{state.func_id.func_qualname} returns an array: make it a driver_part"
        )


@register_pass(mutates_CFG=True, analysis_only=False)
class _DriverLowering(BaseNativeLowering):
    _name = "driver_lowering"
    lowering_class = Lower

    def run_pass(self, state: Any) -> bool:
        state.library = DriverLibrary(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        done: bool = super().run_pass(state)
        return done


class _InnerCompiler(compiler.CompilerBase):
    lowering: Any = _InnerLowering

    def define_pipelines(self) -> list[Any]:
        manager = compiler.DefaultPassBuilder.define_nopython_pipeline(self.state)
        manager.passes = [
            (self.lowering if each is NativeLowering else each, text)
            for each, text in manager.passes
        ]
        manager.finalize()
        return [manager]


class DriverCompiler(_InnerCompiler):
    lowering = _DriverLowering


class InnerFunction(CPUDispatcher):
    """A function for compiled callers; from Python, as tests call it, it is a driver of its own."""

    _cache: Any

    def __init__(self, py_func: Callable[..., Any], *arguments: Any, **options: Any) -> None:
        super().__init__(py_func, *arguments, **{"pipeline_class": DriverCompiler, **options})
        self._inner: dict[tuple[Any, ...], Any] = {}
        self._inner_compiler = type(self._compiler)(
            py_func, self.targetdescr, self.targetoptions, {}, _InnerCompiler
        )

    def compile(self, sig: Any) -> Any:
        """For a caller that is not compiled; kept on disk as a driver is."""
        if isinstance(self._cache, NullCache) and group_of(self.py_func):
            self._cache = cache_of(self.py_func)
        return super().compile(sig)

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Numba asks this for the type of a call.

        A kernel is compiled for each constant that it is called with (the loops over lanes run at
        0.6 of the speed otherwise), a routine once for all.
        """
        signature, given = self._compiler.fold_argument_types(args, kws)
        if not self.targetoptions["forceinline"]:
            given = tuple(types.unliteral(each) for each in given)
        if given not in self._inner:
            details = {"dispatcher": self, "args": given, "return_type": None}
            with numba.core.event.trigger_event("numba:compile", data=details):
                self._inner[given] = self._inner_compiler.compile(given, None)
        name = self.py_func.__name__
        template = typing.make_concrete_template(
            f"CallTemplate({name})",
            key=name,
            signatures=[each.signature for each in self._inner.values()],
        )
        return template, signature, given, {}

    def get_overload(self, signature: Any) -> Any:
        """Numba asks this for what a call goes to."""
        args, _ = numba.core.sigutils.normalize_signature(signature)
        return self._inner[tuple(args)].entry_point
