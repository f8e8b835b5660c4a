"""How kernels are compiled, and where their machine code is kept.

`decorators` says what is compiled in which way; `linking` compiles a driver with all that it calls
at once; `caches` keep machine code on disk, `places` choose where, and `sources` when it is stale.
"""

from shaketable.compiled.caches import is_kept, may_be_kept
from shaketable.compiled.decorators import OPTIONS, driver, driver_part, kernel, routine

__all__ = ["OPTIONS", "driver", "driver_part", "is_kept", "kernel", "may_be_kept", "routine"]
