"""What is believed of walls and straps, and whether it holds; verdicts come out either way."""

from __future__ import annotations

import pandas as pd

from shaketable.study import NO, OPEN, YES, Claim
from shaketable_studies.shaketable_2026_surroundings.cases import USUAL, of_scale

SMOOTH, LOUD = 0.2, 2.0  # friction and scale of the claims about lips
CODE = 0.061  # of the weight: ASCE 7-22's least F_p, 0.3 W, at the centre of gravity


def claims(
    walls: pd.DataFrame,
    straps: pd.DataFrame,
    weak: pd.DataFrame,
    tilts: pd.DataFrame,
    lips: pd.DataFrame,
) -> list[Claim]:
    """The claims, one by one."""
    return [
        *(_wall_helps(walls, scale) for scale in walls["scale"].unique()),
        _turned(walls),
        *(_static(straps, scale) for scale in straps["scale"].unique()),
        _slack(straps),
        _weak(weak),
        _caught(tilts),
        *(_lip_keeps(lips, thing) for thing in lips["thing"].unique()),
    ]


def _wall_helps(walls: pd.DataFrame, scale: float) -> Claim:
    here = of_scale(walls, scale)
    free = here[here["gap_mm"].isna()].iloc[0]
    near = here[(here["gap_mm"] == 10.0) & (here["restitution"] == USUAL)].iloc[0]
    holds = YES if near["high"] < free["low"] else NO if near["low"] > free["high"] else OPEN
    return Claim(
        f"a wall 10 mm behind a bookcase keeps it from falling (motions × {scale:g})",
        "–",
        f"{near['falls']:g} of {near['runs']:g} fall, {free['falls']:g} without the wall",
        holds,
    )


def _turned(walls: pd.DataFrame) -> Claim:
    beside = walls[walls["gap_mm"].notna()]
    toward, all_of_them = int(beside["to_the_wall"].sum()), int(beside["falls"].sum())
    return Claim(
        "what falls beside a wall falls away from it",
        "–",
        f"{all_of_them - toward} of {all_of_them} falls",
        OPEN if not all_of_them else YES if toward == 0 else NO,
    )


def _static(straps: pd.DataFrame, scale: float) -> Claim:
    here = of_scale(straps, scale)
    low, high = here["force_90"].min(), here["force_90"].max()
    return Claim(
        f"the static force of a code is what a strap has to bear (motions × {scale:g})",
        f"{CODE:.3f} of the weight (ASCE 7-22, its least F_p at the centre of gravity)",
        f"{low:.2f} to {high:.2f} of the weight in 90 of 100 shakings, by stiffness and slack",
        NO if low > CODE else YES if high <= CODE else OPEN,
    )


def _slack(straps: pd.DataFrame) -> Claim:
    keys = ["gap_mm", "stiffness_per_mass", "scale"]
    tight, loose = (
        straps[straps["slack_mm"] == slack].set_index(keys)["force_90"] for slack in (0.0, 20.0)
    )
    more = (loose.to_numpy() / tight.to_numpy()).tolist()
    low, high = min(more), max(more)
    return Claim(
        "20 mm of slack raise the force of a strap",
        "–",
        f"the force in 90 of 100 shakings {low:.2f} to {high:.2f} times that without slack",
        YES if low > 1.0 else NO if high < 1.0 else OPEN,
    )


def _weak(weak: pd.DataFrame) -> Claim:
    saved, harmed = int(weak["saved"].sum()), int(weak["harmed"].sum())
    worse, better = (weak["change_low"] > 0.0).sum(), (weak["change_high"] < 0.0).sum()
    return Claim(
        "a strap that breaks does more harm than none",
        "–",
        f"{harmed} runs fall that stand without it, {saved} stand that fall without it; of "
        f"{len(weak)} cases {worse} are worse and {better} better by more than chance",
        YES if worse and not better else NO if better and not worse else OPEN,
    )


def _caught(tilts: pd.DataFrame) -> Claim:
    here = tilts[(tilts["scale"] == 1.0) & (tilts["wall"] == "vertical")]
    level = here[here["tilt_deg"] == 0.0].set_index("gap_mm")
    tilted = here[here["tilt_deg"] == 3.0].set_index("gap_mm")
    better = bool((tilted["high"] < level["low"]).any())
    worse = bool((tilted["low"] > level["high"]).any())
    falls = zip(level.index, level["falls"], tilted["falls"], strict=True)
    told = ", ".join(f"{gap:g} mm {before} to {after}" for gap, before, after in falls)
    return Claim(
        "a bookcase that is tilted by 3° toward its wall falls less often",
        "the wall catches it (Boroschek & Iruretagoyena 2006)",
        f"falls of {int(here['runs'].iloc[0])} by gap: {told}",
        YES if better and not worse else NO if worse and not better else OPEN,
    )


def _lip_keeps(lips: pd.DataFrame, thing: str) -> Claim:
    """By the intervals of what falls at all, on the shelf or off it, with 5 mm and without."""
    here = lips[(lips["thing"] == thing) & (lips["friction"] == SMOOTH) & (lips["scale"] == LOUD)]
    bare, lip = (here[here["lip_mm"] == size].iloc[0] for size in (0.0, 5.0))
    less, more = lip["high"] < bare["low"], lip["low"] > bare["high"]
    return Claim(
        f"a lip of 5 mm keeps a {thing} thing, 50 mm from the edge of a shelf, from falling "
        f"(motions × {LOUD:g}, friction {SMOOTH:g})",
        "–",
        f"{lip['falls']} of {lip['runs']} fall, {lip['off_edge']} of these off the shelf; without "
        f"it {bare['falls']}, {bare['off_edge']} of these off it",
        YES if less else NO if more else OPEN,
    )
