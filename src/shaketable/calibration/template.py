"""An empty table of shake-table tests with examples and explanations, to be filled in."""

from __future__ import annotations

from shaketable.tables.template import Template

_EXPLAINED = {
    "test": "its name or number, each once. Replace the rows that stand here as examples",
    "motion": "file with the table's motion, in the folder given with --motions, or the name of a "
    "motion of a suite; the tests of one motion at several scales name it several times",
    "scale": "factor on the motion; 1 if empty",
    "fell": "yes or no; a table of tests to be predicted has no such column",
    "record": "name of the earthquake record from which the motion was made, alike for all tests "
    "made from it: they are kept together when predictions are judged; may be empty",
    "component": "which one, of files that hold several; may be empty",
    "order": "when it was made among the others, as 1, 2, 3: bodies wear; without this column "
    "tests whose names are numbers are taken in their order",
}
_EXAMPLES = (
    {"test": "A1", "motion": "tohoku.csv", "scale": 0.6, "fell": "no", "record": "Tohoku",
     "order": 1},
    {"test": "A2", "motion": "tohoku.csv", "scale": 0.9, "fell": "yes", "record": "Tohoku",
     "order": 2},
    {"test": "B1", "motion": "kobe.csv", "fell": "yes", "record": "Kobe", "order": 3},
)  # fmt: skip

TESTS = Template("Tests", _EXPLAINED, _EXAMPLES)
