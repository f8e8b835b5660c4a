"""Words in a name, a note or an unknown column that say what a column should say.

In English, Spanish and German. A word after "no", "without" and their likes says nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

#: A denial, and at most three words up to what it denies.
_DENIED = re.compile(
    r"\b(no|not|never|without|sin|ohne|nicht|kein|keine|keinen)\b(\s+\w+){0,3}\s*$", re.IGNORECASE
)
_NONE = re.compile(r"\s*[:=]\s*(no|none|not|ninguna?|kein|keine|nein)\b", re.IGNORECASE)


def _said(pattern: re.Pattern[str], text: str) -> bool:
    """Whether a text has a pattern that is not denied before it, nor after it ("wheels: none")."""
    return any(
        not _DENIED.search(text[: found.start()]) and not _NONE.match(text[found.end() :])
        for found in pattern.finditer(text)
    )


_CASTORS = re.compile(
    r"\b("
    r"castors?|casters?|wheel(s|ed)?|wheelchairs?|rolls|rollers?|rolling|roll ?containers?"
    r"|rollators?|rollwagen|doll(y|ies)|trolleys?|carts?|gurneys?|stretchers?|hospital beds?"
    r"|mobile(?! phone)|ventilators?|ana?esthesia (machine|workstation)"
    r"|(iv|drip|infusion) (pole|stand)"
    r"|ruedas?|rueditas?|rodantes?|rodables?|carros?|carritos?|camillas?"
    r"|camas? (de hospital|cl[íi]nicas?)|atril(es)?|porta ?sueros?"
    r"|ventilador(es)?(?! de (techo|mesa|pared))"
    r"|rollen|lenkrollen|räder|fahrbar(e|es|er)?|rollstuhl|rollstühle|\w*rollcontainer"
    r"|(?!volkswagen)\w*wagen|infusionsständer|krankenbett(en)?|beatmungsgerät(e)?"
    r")\b",
    re.IGNORECASE,
)
_ANCHORED = re.compile(
    r"(?<!un)\b(anchored|bolted|screwed|strapped|fastened|chained"
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
    r"\b(round|circular|cylindrical|redond[oa]s?|circulares?|cil[íi]ndric[oa]s?"
    r"|rund(e|er|es|en)?|kreisförmig(e|er|es|en)?|zylindrisch(e|er|es|en)?"
    r"|cylinders?|bottles?|drums?|barrels?|vases?|urns?|bins?"
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
#: Of a location: furniture on which things stand.
_FURNITURE = re.compile(
    r"\b(shelf|shelves|table|desk|(work)?bench|counter|pedestal|plinth"
    r"|mes[óo]n|mesa|pedestal|estante|repisa|estanter[íi]a|escritorio"
    r"|\w*tisch|\w*regal|sockel|theke|podest)\s*\d*\s*$",
    re.IGNORECASE,
)
#: Of a header: what may be about castors, anchors or shapes, in the commonest languages.
_MAY_SAY = re.compile(
    r"\b(cast[eo]r|wheel|rueda|rodante|rollen|rolle\b|lenkrolle|rad\b|r[äa]e?der\b|ruot|rotell|roulett"
    r"|roues?\b|rod[íi]zi|rodas\b|brake|freno|bremse|trava\b|m[óo]vil\b|mobile?\b(?! phone)"
    r"|anchor|ancla|ancl[éa]|ancr|ancor|fij[oa]\b|fijad|fijaci|fixed\b|fixing|fissa|bolt|screw|strap"
    r"|chain|caden|kette|verank|befest|gesichert|sujet[oa]\b|sujeci|amarr|asegurad[oa]\b|restrain"
    r"|tether|attached|secured|brac(ed|ing)|atornill|verschraub|halterung"
    r"|shape|form(a|e)?\b|grundriss|round\b|redond|rund\b|tond[oa]\b|cil[íi]nd|[cz]ylind)",
    re.IGNORECASE,
)
#: Of a header: what may say on what objects stand.
_STANDS = re.compile(
    r"\b(stands? on|standing on|placed on|resting on|supported by|on top|pedestal|plinth"
    r"|apoyad[oa]s?|colocad[oa]s? sobre|encima|sobre qu[ée]"
    r"|steht auf|auf was|worauf|sockel|unterlage)\b",
    re.IGNORECASE,
)
#: Headers that the pattern above would take, and that are about something else.
_ELSE = re.compile(
    r"activo fijo|fixed asset|cadena de fr[íi]o|(supply|cold) chain|tel[ée]fono|photo"
    r"|(cylinder|cilindro) (volume|volumen)|asegurad[oa] por|sujeto a|form(a|ulario) (de )?pago",
    re.IGNORECASE,
)


def mentions_castors(*texts: str) -> bool:
    """Whether a text has a word that goes with castors."""
    return any(_said(_CASTORS, text) for text in texts)


def mentions_anchors(*texts: str) -> bool:
    """Whether a text says that something is anchored."""
    return any(_said(_ANCHORED, text) for text in texts)


def mentions_round(name: str) -> bool:
    """Whether a name is that of something round."""
    return _said(_ROUND, name)


def must_be_kept(*texts: str) -> bool:
    """Whether a text speaks of what must not fall, such as gas cylinders."""
    return any(_KEPT.search(text) for text in texts)


def mentions_what_it_stands_on(*texts: str) -> bool:
    """Whether a text says that something stands on another thing, or is of several pieces."""
    return any(_ON_TOP.search(text) for text in texts)


def is_furniture(location: str) -> bool:
    """Whether a location is one on which things stand, as "laboratory shelf"."""
    return _FURNITURE.search(location) is not None


def may_say_what_it_stands_on(header: str) -> bool:
    """Whether the header of an unknown column speaks of what objects stand on."""
    return _STANDS.search(header) is not None


def may_say_what_decides(header: str, values: Iterable[str], answers: Iterable[str]) -> bool:
    """Whether an unknown column may say what decides: castors, anchors or shapes of objects.

    By its header, by the values of most rows, or as all of its values are answers.

    Args:
        header: of the column.
        values: of its cells.
        answers: words that answer castors, anchored or shape, in lower case.
    """
    known = set(answers)
    told = [value.strip().lower() for value in values if value.strip()]
    if _MAY_SAY.search(header) and not _ELSE.search(header):
        return True
    like = sum(_said(_CASTORS, each) or _said(_ANCHORED, each) for each in told)
    return bool(told) and (2 * like > len(told) or all(each in known for each in told))
