"""Words in a name, a note or an unknown column that say what a column should say.

In English, Spanish and German. A word after "no", "without" and their likes says nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

_DENIALS = ("no", "not", "not on", "without", "sin", "ohne", "nicht", "kein", "keine")
_NO = "".join(rf"(?<!\b{word} )" for word in _DENIALS)


def _words(*patterns: str) -> re.Pattern[str]:
    """Any of some whole words, none of which is denied."""
    return re.compile(rf"{_NO}\b({'|'.join(patterns)})\b", re.IGNORECASE)


_CASTORS = _words(
    r"castors?|casters?|wheel(s|ed)?|wheelchairs?|rolls|rollers?|rolling|roll ?containers?",
    r"rollators?|rollwagen|doll(y|ies)|trolleys?|carts?|gurneys?|stretchers?|hospital beds?|mobile",
    r"ventilators?|ana?esthesia (machine|workstation)|(iv|drip|infusion) (pole|stand)",
    r"ruedas?|rueditas?|rodantes?|rodables?|carros?|carritos?|camillas?|cama(s)? (de hospital|"
    r"clínica|clinica)s?|atril(es)?|porta ?sueros?|ventilador(es)?",
    r"rollen|lenkrollen|räder|fahrbar(e|es|er)?|rollstuhl|rollstühle|\w*rollcontainer|"
    r"\w*wagen|infusionsständer|krankenbett(en)?|beatmungsgerät(e)?",
)
_ANCHORED = re.compile(
    rf"{_NO}(?<!un)\b(anchored|bolted|screwed|strapped|fastened|chained"
    r"|anclad[oa]s?|atornillad[oa]s?|amarrad[oa]s?|encadenad[oa]s?|empotrad[oa]s?|con cadenas?"
    r"|fij[oa]s? (al?|en|con)|fijad[oa]s?"
    r"|verankert|befestigt|verschraubt|angeschraubt|festgeschraubt|angekettet|mit ketten?)\b",
    re.IGNORECASE,
)
_KEPT = re.compile(
    r"\bmust (not|never) fall\b|\bno debe (caer|volcarse)\b|\bdarf nicht (fallen|kippen)\b"
    r"|\b(gas|oxygen|nitrogen|acetylene|hydrogen|co2) (cylinder|bottle)s?\b"
    r"|\b(cilindro|botella|bal[óo]n)(s|es)? (de|con) (gas|ox[íi]geno|nitr[óo]geno|acetileno"
    r"|hidr[óo]geno|co2)\b"
    r"|\b(gas|sauerstoff|stickstoff|acetylen|wasserstoff|co2-?)flaschen?\b",
    re.IGNORECASE,
)
_ROUND = re.compile(
    r"\b(cylinders?|bottles?|drums?|barrels?|vases?|urns?|bins?"
    r"|cilindros?|botellas?|bal[óo]n(es)?|tambor(es)?|barril(es)?|jarr[óo]n(es)?|floreros?|urnas?"
    r"|\w*zylinder|\w*flaschen?|f[aä]ss(er)?|tonnen?|vasen?|urnen?|eimer)\b",
    re.IGNORECASE,
)
_ON_TOP = re.compile(
    r"\b(on( top of)?( an?| the| its)? (pedestal|plinth|stand|table|desk|bench|counter|shelf"
    r"|shelves|cabinet|cupboard|trolley|cart|fridge|freezer|workbench|bookcase|rack|box)"
    r"|on top of|stacked|stack of|(two|three|2|3) (pieces|parts)|in (two|three) parts|two-piece"
    r"|(sobre|encima de|arriba de)( el| la| un| una| su)? (mes[óo]n|mesa|pedestal|mueble|estante"
    r"|repisa|escritorio|carro|gabinete|velador|refrigerador|cajonera|estanter[íi]a)"
    r"|encima de|apilad[oa]s?|(dos|tres) (piezas|partes|cuerpos)"
    r"|auf( dem| der| einem| einer| einen)? \w*(tisch|sockel|schrank|regal|pult|podest|wagen"
    r"|theke|bank|kommode)"
    r"|gestapelt|aufeinander|(zwei|drei)teilig|(zwei|drei) (teile|st[üu]cke))\b",
    re.IGNORECASE,
)
#: Of a header: what may be about castors, anchors or shapes, in the commonest languages.
_MAY_SAY = re.compile(
    r"cast[eo]r|wheel|rueda|rodante|roll(e|i)|\brad\b|r[äa]e?der|ruot|rotell|roulett|\broues?\b"
    r"|rod[íi]zi|\brodas\b|brake|fren[oa]|brems|trav[aã]|mobil|m[óo]vil"
    r"|anchor|ancl|ancr|ancor|\bfij|\bfix|fissa|bolt|screw|strap|chain|caden|kette|verank|befest"
    r"|gesich|sujet|sujec|amarr|asegur|restrain|tether|attach|secur|brac(e|ing)|atornill|schraub"
    r"|halterung|shape|\bform(a|e)?\b|grundriss|round|redond|rund\b|tond[oa]|cil[íi]nd|[cz]ylind",
    re.IGNORECASE,
)


def mentions_castors(*texts: str) -> bool:
    """Whether a text has a word that goes with castors."""
    return any(_CASTORS.search(text) for text in texts)


def mentions_anchors(*texts: str) -> bool:
    """Whether a text says that something is anchored."""
    return any(_ANCHORED.search(text) for text in texts)


def mentions_round(name: str) -> bool:
    """Whether a name is that of something round."""
    return _ROUND.search(name) is not None


def must_be_kept(*texts: str) -> bool:
    """Whether a text speaks of what must not fall, such as gas cylinders."""
    return any(_KEPT.search(text) for text in texts)


def mentions_what_it_stands_on(*texts: str) -> bool:
    """Whether a text says that something stands on another thing, or is of several pieces."""
    return any(_ON_TOP.search(text) for text in texts)


def may_speak_of_castors(header: str, values: Iterable[str], answers: Iterable[str]) -> bool:
    """Whether an unknown column may say castors, anchors or shapes of objects.

    By its header, by a value that is one of theirs, or as all of its values are answers.

    Args:
        header: of the column.
        values: of its cells.
        answers: words that answer castors, anchored or shape, in lower case.
    """
    known = set(answers)
    told = [value.strip().lower() for value in values if value.strip()]
    if _MAY_SAY.search(header):
        return True
    if any(_CASTORS.search(each) or _ANCHORED.search(each) for each in told if len(each) < 40):
        return True
    return bool(told) and all(each in known for each in told)
