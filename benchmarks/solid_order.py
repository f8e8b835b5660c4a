"""`python -m benchmarks.solid_order`: what the tolerance of the steps of solids is worth.

The error of the state at the end of a motion against that with a tolerance of 1e-14, for what
rolls, what sticks and slips, and what meets its support often; the default is marked.
"""

from __future__ import annotations

from tests.support.solid_order import cases, errors

from shaketable.models.solid_input import TOLERANCE


def main() -> None:
    print("| case | tolerance | largest error [SI] | steps |")
    print("|---|---:|---:|---:|")
    for name, case in cases().items():
        for tolerance, error, steps in errors(case):
            mark = ", the default" if tolerance == TOLERANCE else ""
            print(f"| {name} | {tolerance:.0e}{mark} | {error:.1e} | {steps:.0f} |")


if __name__ == "__main__":
    main()
