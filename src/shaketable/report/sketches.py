"""Small drawings of measures, as SVG: the thing in grey, what is added in black."""

from __future__ import annotations

from markupsafe import Markup

from shaketable.assess import MitigationKind

WIDTH, HEIGHT = 84, 72
FLOOR, WALL = 64, 76  # where the floor and the wall are
THING = (34, 18, 22, 46)  # x, y, width and height of what stands there
ON_WHEELS = THING[3] - 6  # height of what stands on castors
_GREY = 'fill="#ddd" stroke="#777"'
_BLACK = 'fill="none" stroke="#111" stroke-width="2.2" stroke-linecap="round"'


def sketch(kind: MitigationKind, round_base: bool = False) -> Markup:
    """A drawing of a measure, hidden from screen readers, as the words beside it say the same.

    Args:
        kind: of the measure.
        round_base: whether of a cylinder.
    """
    parts = [_line(4, FLOOR, 80, FLOOR), *_DRAWN[kind](round_base)]
    return Markup(  # noqa: S704  our own shapes
        f'<svg class="sketch" viewBox="0 0 {WIDTH} {HEIGHT}" aria-hidden="true">'
        f"{''.join(parts)}</svg>"
    )


def _line(x1: float, y1: float, x2: float, y2: float, style: str = "") -> str:
    style = style or 'stroke="#777" stroke-width="1.5"'
    return f'<path d="M{x1:g} {y1:g}L{x2:g} {y2:g}" {style}/>'


def _thing(
    round_base: bool = False,
    dx: float = 0.0,
    turn: float = 0.0,
    width: float = THING[2],
    height: float = THING[3],
) -> str:
    x, y = THING[:2]
    corner = 7 if round_base else 1
    around = f' transform="rotate({turn:g} {x + dx + width:g} {FLOOR})"' if turn else ""
    return (
        f'<rect x="{x + dx:g}" y="{y}" width="{width:g}" height="{height}" rx="{corner}" '
        f"{_GREY}{around}/>"
    )


def _wall() -> str:
    hatch = "".join(f"M{WALL} {y}l6 -5" for y in range(12, FLOOR + 1, 8))
    return f'<path d="M{WALL} 6V{FLOOR}{hatch}" fill="none" stroke="#777" stroke-width="1.5"/>'


def _strap(round_base: bool) -> list[str]:
    links = ' stroke-dasharray="4 3"' if round_base else ""
    x = THING[0] + THING[2]
    height = 26 if round_base else 20  # under the shoulder of a cylinder
    around = f'<path d="M{THING[0]} {height}h{THING[2]}" {_BLACK}{links}/>' if round_base else ""
    return [
        _wall(),
        _thing(round_base),
        around,
        f'<path d="M{x} {height}L{WALL} {height}" {_BLACK}{links}/>',
        _hook(height),
    ]


def _hook(height: int) -> str:
    return f'<circle cx="{WALL}" cy="{height}" r="2.6" fill="#111"/>'


def _wheels() -> str:
    y = FLOOR - 3
    return "".join(f'<circle cx="{x}" cy="{y}" r="3" fill="#fff" stroke="#777"/>' for x in (38, 52))


def _tether(round_base: bool) -> list[str]:
    return [
        _wall(),
        _thing(round_base, height=ON_WHEELS),
        _wheels(),
        f'<path d="M56 34Q66 44 {WALL} 34" {_BLACK}/>',
        _hook(34),
    ]


def _lock(round_base: bool) -> list[str]:
    return [
        _thing(round_base, height=ON_WHEELS),
        _wheels(),
        *(f'<path d="M{x} {FLOOR - 9}l7 3" {_BLACK}/>' for x in (36, 50)),
    ]


def _base(round_base: bool) -> list[str]:
    return [
        _thing(round_base),
        f'<path d="M20 {FLOOR - 2}H70" fill="none" stroke="#111" stroke-width="4"/>',
    ]


def _pad(round_base: bool) -> list[str]:
    return [
        _thing(round_base),
        *(f'<rect x="{x}" y="{FLOOR - 4}" width="7" height="5" fill="#111"/>' for x in (34, 49)),
    ]


def _lower(round_base: bool) -> list[str]:
    boxes = "".join(
        f'<rect x="{x}" y="{y}" width="8" height="7" fill="#111"/>'
        for x, y in ((36, 55), (46, 55), (36, 46))
    )
    return [_thing(round_base), boxes, f'<path d="M45 24v12m-4 -4l4 5l4 -5" {_BLACK}/>']


def _to_wall(round_base: bool) -> list[str]:
    return [
        _wall(),
        _thing(round_base, dx=17.0),
        f'<path d="M14 40h28m-5 -4l5 4l-5 4" {_BLACK}/>',
    ]


def _turn(round_base: bool) -> list[str]:
    return [
        _thing(round_base),
        f'<path d="M24 14q21 -14 42 0m-7 -1l7 1l0 -7" {_BLACK}/>',
    ]


def _move(round_base: bool) -> list[str]:
    stairs = "M6 20h12v11h11v11h11v11h11v11"
    return [
        f'<path d="{stairs}" fill="none" stroke="#777" stroke-width="1.5"/>',
        f'<rect x="8" y="6" width="9" height="14" {_GREY}/>',
        f'<rect x="62" y="50" width="9" height="14" {_GREY}/>',
        f'<path d="M24 12Q58 14 66 42m-6 -4l6 5l3 -7" {_BLACK}/>',
    ]


def _tilted(round_base: bool) -> list[str]:
    return [
        _wall(),
        _thing(round_base, dx=14.0, turn=4.0),
        f'<path d="M46 {FLOOR}l5 -4v4z" fill="#111"/>',
    ]


_DRAWN = {
    MitigationKind.STRAP: _strap,
    MitigationKind.TETHER: _tether,
    MitigationKind.LOCK: _lock,
    MitigationKind.BASE: _base,
    MitigationKind.PAD: _pad,
    MitigationKind.LOWER: _lower,
    MitigationKind.WALL: _to_wall,
    MitigationKind.TURN: _turn,
    MitigationKind.MOVE: _move,
    MitigationKind.TILT: _tilted,
}
