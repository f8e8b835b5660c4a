"""What carries an object, as the words of its row say: the floor, a wall or ceiling, or furniture.

What hangs or is fixed is not simulated. What stands on furniture that moves is simulated as if it
stood on the floor. What is built in or fastened, such as a bench or a plinth, counts as the floor.
"""

from __future__ import annotations

import re

from shaketable.inventory import hints
from shaketable.inventory.vocabulary import plain, row_words

#: That something is on what a name names.
_ON = re.compile(r"\b(on|auf|sobre|en|su|sul|sulla|sopra)\b|上", re.IGNORECASE)
#: m: what is higher and said to stand on a stand is as high as both.
WITH_ITS_STAND = 1.0


def hangs_or_is_fixed(name: str, *texts: str) -> bool:
    """Whether a name, a note or a location says that something hangs, or is fixed to the building.

    Args:
        name: of the object.
        texts: of its row; what is said where they name something that is fastened and carries
            things, such as a bench, is said of that.
    """
    own = [name, *(text for text in texts if not hints.is_fastened(text))]
    return hints.mentions_hanging(*own) or hints.mentions_anchors(*own)


def what_it_stands_on(said: str, name: str, note: str, location: str, height: float) -> str:
    """The furniture on which an object stands, as its row says it; "" for the floor.

    Args:
        said: text of the column that says it, which decides if it is filled.
        name, note, location: of the object.
        height: of the object [m].
    """
    if said.strip():
        return "" if plain(said) in row_words("floor") or hints.is_fastened(said) else said.strip()
    for text in (name, note):
        found = hints.what_it_stands_on(text)
        if found and not hints.is_fastened(text):
            return found
        if height < WITH_ITS_STAND and (found := hints.on_a_stand(text)):
            return found
    fastened = any(hints.is_fastened(text) for text in (name, note, location))
    return location if hints.is_furniture(location) and not fastened else ""


def may_be_fastened(name: str, note: str, location: str) -> bool:
    """Whether an object stands on something that is taken as fastened to the building.

    A name says that only with a word for it: "analyser on bench", not "work bench".
    """
    on = _ON.search(name) is not None and hints.is_fastened(name)
    return on or any(hints.is_fastened(text) for text in (note, location))
