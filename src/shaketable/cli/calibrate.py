"""`shaketable calibrate`: a body's parameters from its shake-table tests."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from shaketable.cli.console import say
from shaketable.cli.option_groups import settings_of
from shaketable.cli.options import Overwrite, ReadingOptions, warn_of_sizes
from shaketable.errors import InputError, require_positive
from shaketable.report.run_log import RunLog

if TYPE_CHECKING:
    from shaketable.calibration import ShakeTest

log = logging.getLogger(__name__)


def calibrate(
    *,
    tests: Annotated[
        Path,
        typer.Argument(
            help="Table of tests, as CSV, .xlsx or .ods: test, motion (a file in --motions, in any "
            "of the formats of records, or a column of numbers), fell (yes or no), and if known "
            "scale (factor on that motion), record (the earthquake record that it was made from: "
            "tests of one record are kept together), component (of a file that holds several), "
            "order (in which the tests were made; that of their numbers, where names are numbers). "
            "'shaketable template --tests' writes one to fill in."
        ),
    ],
    motions: Annotated[
        Path, typer.Option(help="Folder with the motions of the table, or a suite.")
    ],
    out: Annotated[Path, typer.Option(help="Folder for the page, tables and figures.")],
    predict: Annotated[
        Path | None,
        typer.Option(
            help="Table of other tests to predict; its column fell, if it has one, judges only."
        ),
    ] = None,
    prior: Annotated[
        Path | None,
        typer.Option(
            help="Table of ranges: parameter, low, high, distribution (uniform, log-uniform), as "
            "in 'slenderness,0.02,0.6,log-uniform'; others keep theirs. [slenderness 0.05-0.6 rad "
            "and half_diagonal 0.2-2 m log-uniform, cg_offset -0.2-0.2, restitution_factor 0.5-1, "
            "tilt 0]"
        ),
    ] = None,
    base_m: Annotated[
        float | None,
        typer.Option(
            help="Measured base [m] along the shaking, with --height-m: a prior about it."
        ),
    ] = None,
    height_m: Annotated[float | None, typer.Option(help="Measured height [m].")] = None,
    members: Annotated[int, typer.Option(min=64, help="Bodies of the ensemble.")] = 4096,
    folds: Annotated[int, typer.Option(min=3, help="Folds of the cross-validation.")] = 10,
    reading: ReadingOptions,
    seed: Annotated[int, typer.Option(min=0, help="Seed of ensemble, folds, bootstrap.")] = 0,
    overwrite: Overwrite = False,
) -> None:
    """Estimate a body's parameters from its shake-table tests, and predict other tests.

    Rocking is chaotic: one simulation of one body says little. An ensemble of bodies is weighed by
    how well each explains the tests; it gives probabilities for other motions, and tells by
    cross-validation how good they are.
    """
    settings = {name: value for name, value in settings_of(locals()).items() if name != "overwrite"}
    from shaketable.body import Body
    from shaketable.calibration import Prior, ordered_by_number, read_prior, read_tests
    from shaketable.calibration import calibrate as calibrated
    from shaketable.calibration.rivals import rival_predictions
    from shaketable.report.calibration import lead, write_calibration
    from shaketable.report.results_folder import require_folder
    from shaketable.report.run_log import sha256

    run_log = RunLog()
    require_folder(out, overwrite, run_log)
    if (base_m is None) != (height_m is None):
        raise InputError("--base-m and --height-m: give both of them, or none")
    nominal = None
    ranges = Prior()
    if base_m is not None and height_m is not None:
        require_positive("--base-m", base_m)
        require_positive("--height-m", height_m)
        warn_of_sizes({"--base-m": base_m, "--height-m": height_m})
        nominal = Body.rectangle(base_m, height_m)
        ranges = Prior.around(base_m, height_m)
    if prior is not None:
        ranges = read_prior(prior, ranges)
    known = read_tests(tests, motions, **reading.as_read)
    others: list[ShakeTest] = []
    if predict is not None:
        others = read_tests(predict, motions, outcomes=False, **reading.as_read)
        _warn_of_known(known, others)
    known, others = ordered_by_number(known, others)
    found = calibrated(ranges, known, members=members, folds=folds, seed=seed)
    rivals = rival_predictions(found, nominal) if found.fitted else {}
    predicted = (others, found.predict(others)) if others else None
    given = {"tests": tests, "predict": predict, "prior": prior}
    run = {
        **run_log.entries(),
        "inputs": {
            name: {"path": str(path), "sha256": sha256(path)}
            for name, path in given.items()
            if path
        },
        "motions": {
            origin.file: origin.sha256
            for test in (*known, *others)
            if (origin := test.motion.origin) is not None
        },
        "setting": found.setting._asdict(),
        "settings": {
            name: str(value) if isinstance(value, Path) else value
            for name, value in settings.items()
        },
    }
    write_calibration(found, rivals, predicted, run, out, overwrite=overwrite)
    for sentence in lead(found, rivals, predicted):
        say(sentence)
    say(f"page: {out / 'index.html'}; posterior.csv and the other files beside it")


def _warn_of_known(known: Sequence[ShakeTest], others: Sequence[ShakeTest]) -> None:
    """Warn of tests to be predicted that the calibration knows: they judge nothing."""
    records = {test.record for test in known if test.record}
    motions = {test.motion.name for test in known}
    seen = [test.name for test in others if test.record in records or test.motion.name in motions]
    if seen:
        log.warning(
            "%d of the %d tests to predict are of records or motions that the calibration has "
            "seen: how well they come out judges nothing",
            len(seen),
            len(others),
        )
