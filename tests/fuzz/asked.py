"""What is asked of the command line and of the page, whole and damaged."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel, ValidationError

from shaketable import InputError
from shaketable.web import budget, shaking, space, work
from shaketable.web.questions import LookAtMotion, Many, ManyInSpace, Shake, ShakeInSpace
from tests.support import record_files
from tests.support.command import shaketable
from tests.support.mutations import MUTATIONS
from tests.support.questions import question

COMMANDS = [
    "simulate --base-m 0.3 --height-m 1.8 --record a.csv",
    "simulate --base-m 0.3 --height-m 1.8 --record a.csv --tilt-deg 2 --eccentricity 0.1 --scale "
    "2 --model general --static-friction 0.3 --kinetic-friction 0.2 --normal-restitution 0 "
    "--restitution-factor 0.9 --json",
    "simulate --base-m 0.3 --height-m 1.8 --record a.AT2 --plot a.png",
    "simulate --base-m 0.3 --height-m 1.8 --record a.csv --time-step 0.01 --units g",
    "tilt --base-m 0.3 --height-m 1.8 --motions a.csv --tilt-deg 3 --downhill-share 0.9 --json",
    "tilt --base-m 0.3 --height-m 1.8 --motions a.csv a.AT2 --scale 2 --base-length-m 0.3",
    "criteria --base-m 0.3 --height-m 1.8 --pga-g 0.4 --pgv-cm-s 40 --eccentricity 0.1 --json",
    "criteria --base-m 0.3 --height-m 1.8 --record a.csv --scale 2",
    "initial-modes --base-m 0.3 --height-m 1.0 --static-friction 0.4 --out b.png",
    "records a.csv a.AT2",
    "records folder a.AT2 --out c --units g --time-step 0.01",
    "assess things.csv --motions a.csv a.AT2 --out d --overwrite --scale 1.5 --tilt-deg 1",
    "assess things.csv --motions a.csv --out e --model general --downhill-share 0.9",
    "study tilting --help",
    "suites",
    "--version",
]
ODD = [
    "", " ", "nan", "inf", "-inf", "1e308", "1e-308", "5e-324", "1e400", "-1", "0", "-0.0", "100",
    "1e5", "1e-9", "abc", "１", "٣", "1,5", "1_000", "1e", "+", "0x10", "9" * 40, "9" * 5000,
    "0.3m", "\x1b[31mred", ".", "missing", "folder", "a.csv", "things.csv", "p.txt", "none/p.png",
    "/dev/null", "/dev/full", "ä" * 300, "--", "-x", "--help", "rocking", "general", "g",
]  # fmt: skip


def damaged_line(rng: np.random.Generator) -> list[str]:
    """A command line of which one to three words are replaced, left out, repeated or added."""
    words = COMMANDS[rng.integers(len(COMMANDS))].split()
    for _ in range(rng.integers(1, 4)):
        at = int(rng.integers(len(words)))
        odd = ODD[rng.integers(len(ODD))]
        kind = rng.integers(6)
        values = [k for k, word in enumerate(words) if k and not word.startswith("-")]
        if kind < 3 and values:
            words[rng.choice(values)] = odd
        elif kind == 3 and len(words) > 1:
            del words[at]
        elif kind == 4:
            words.insert(at, odd)
        else:
            words.insert(at, words[rng.integers(len(words))])
    return words


def write_beside(folder: Path) -> None:
    """What the command lines name."""
    (folder / "a.csv").write_text(record_files.csv())
    (folder / "a.AT2").write_text(record_files.at2())
    (folder / "things.csv").write_text("name,width_m,height_m\nshelf,0.32,1.8\nbox,0.5,0.4\n")
    (folder / "folder").mkdir(exist_ok=True)


def line_as_file(rng: np.random.Generator) -> bytes:
    """A damaged command line, as `run_line` takes it."""
    return json.dumps(damaged_line(rng)).encode()


def run_line(path: Path) -> str:
    """What a command says, whose words are in a file, in the folder of the file.

    Raises:
        InputError: it refused them.
        AssertionError: it ended in another way, or said nothing, too much, or what it must not.
    """
    # any other exception than those that `main` knows would come out of `shaketable` here
    words = json.loads(path.read_bytes())
    run = shaketable(*words, cwd=path.parent)
    said = f"{[word[:60] for word in words]}: {run.stderr[-500:]}"
    assert run.returncode in (0, 2), said
    assert run.returncode == 0 or run.stderr.strip(), said
    assert len(run.stderr) < 10_000, said
    assert "\x1b[31m" not in run.stdout + run.stderr, said
    if run.returncode:
        raise InputError(said)
    return run.stdout


#: Questions by the path at which the page takes them.
ANSWERED_BY: dict[str, tuple[type[BaseModel], Callable[..., Any]]] = {
    "simulate": (Shake, work.shake),
    "many": (Many, work.many),
    "space/simulate": (ShakeInSpace, space.shake),
    "space/many": (ManyInSpace, space.many),
    "motion": (LookAtMotion, shaking.look),
}
LONGEST = 20_000  # bytes of a body that is damaged
SECONDS = 0.02  # of a processor for an answer: what is looked at is how it is refused


def question_as_file(rng: np.random.Generator) -> bytes:
    """The path and the body of a question, of which the body may be damaged."""
    asked = question(rng)
    path = next(path for path, (kind, _) in ANSWERED_BY.items() if kind is type(asked))
    body = asked.model_dump_json().encode()
    for _ in range(int(rng.integers(4))):
        if 0 < len(body) < LONGEST:  # a mutation may repeat a line so often that nothing holds it
            body = MUTATIONS[int(rng.integers(len(MUTATIONS)))](body, rng).raw
    return path.encode() + b"\n" + body


def ask(path: Path) -> Any:
    """The page's answer to the question in a file, as a worker gives it.

    Raises:
        InputError: it is refused, or takes longer than SECONDS.
    """
    where, _, body = path.read_bytes().partition(b"\n")
    kind, answer = ANSWERED_BY[where.decode()]
    try:
        return budget.answer(answer, (kind.model_validate_json(body),), {}, SECONDS, None)
    except (ValidationError, budget.TooLongError) as error:
        raise InputError(str(error)) from None
