"""The drawing of docs/explanation/theory.md: a body on a tilted support, with every symbol."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Polygon

BETA, THETA = math.radians(10.0), math.radians(13.0)
B_LEFT, B_RIGHT, CG, HEIGHT = 0.62, 0.78, 1.25, 2.5  # drawn sizes
ALONG, NORMAL = (
    np.array([math.cos(BETA), math.sin(BETA)]),
    np.array([-math.sin(BETA), math.cos(BETA)]),
)


def placed(x: float, y: float) -> np.ndarray:
    """A point of the support's frame as drawn; its origin is the right corner."""
    return x * ALONG + y * NORMAL


def of_body(u: float, v: float) -> np.ndarray:
    """A point of the body, from its right corner: along its base to the right, and up."""
    cos, sin = math.cos(THETA), math.sin(THETA)  # clockwise is positive
    return placed(u * cos + v * sin, -u * sin + v * cos)


def arrow(ax: Axes, start: np.ndarray, end: np.ndarray, **style: object) -> None:
    look = {"arrowstyle": "-|>", "lw": 1.3, "color": "black", "shrinkA": 0, "shrinkB": 0, **style}
    ax.annotate("", xy=tuple(end), xytext=tuple(start), arrowprops=look)


def span(ax: Axes, start: np.ndarray, end: np.ndarray, text: str, off: np.ndarray) -> None:
    """A measured length beside the body."""
    arrow(ax, start + off, end + off, arrowstyle="<|-|>", lw=0.9, color="0.25")
    for point in (start, end):
        ax.plot(*np.array([point + 0.3 * off, point + 1.15 * off]).T, color="0.6", lw=0.6)
    ax.text(*((start + end) / 2 + 1.75 * off), text, ha="center", va="center", fontsize=12)


def angle(ax: Axes, at: np.ndarray, size: float, first: float, last: float, text: str) -> None:
    """An arc between two directions [rad], named in its middle."""
    ax.add_patch(
        Arc(
            tuple(at), 2 * size, 2 * size, theta1=math.degrees(first), theta2=math.degrees(last),
            color="tab:blue", lw=1.2,
        )
    )  # fmt: skip
    middle = (first + last) / 2
    label = at + (size + 0.16) * np.array([math.cos(middle), math.sin(middle)])
    ax.text(*label, text, color="tab:blue", ha="center", va="center", fontsize=13)


def draw() -> Figure:
    figure = Figure(figsize=(9.2, 6.6), layout="constrained")
    ax = figure.subplots()
    ax.set_aspect("equal")
    ax.set_axis_off()

    # support and level
    edge = np.array([placed(-3.0, 0.0), placed(2.6, 0.0)])
    below = np.array([edge[1] - [0, 0.5], edge[0] - [0, 0.5]])
    ax.add_patch(Polygon(np.vstack([edge, below]), fc="0.9", ec="none"))
    ax.plot(*edge.T, color="0.3", lw=1.6)
    start = placed(-2.75, 0.0)
    ax.plot(*np.array([start, start + np.array([1.5, 0.0])]).T, color="0.5", lw=0.9, ls="--")
    angle(ax, start, 1.05, 0.0, BETA, r"$\beta$")
    ax.text(*placed(-2.3, -0.33), "downhill", color="0.35", rotation=math.degrees(BETA))
    ax.text(*placed(1.75, -0.3), "uphill", color="0.35", rotation=math.degrees(BETA))

    # the body, rotated by θ about its right corner R
    width = B_LEFT + B_RIGHT
    corners = np.array(
        [of_body(-width, 0), of_body(0, 0), of_body(0, HEIGHT), of_body(-width, HEIGHT)]
    )
    ax.add_patch(Polygon(corners, fc="#dfeaf5", ec="black", lw=1.5))
    cg, foot = of_body(-B_RIGHT, CG), of_body(-B_RIGHT, 0.0)
    for corner, name, off in ((corners[1], "R", (0.12, -0.17)), (corners[0], "L", (-0.14, 0.05))):
        ax.plot(*corner, "o", color="black", ms=5)
        ax.text(*(corner + off), name, fontsize=13, fontweight="bold")
        ax.plot(*np.array([corner, cg]).T, color="tab:red", lw=1.1)
    ax.plot(*np.array([foot, of_body(-B_RIGHT, HEIGHT)]).T, color="0.45", lw=0.9, ls="-.")
    ax.plot(*cg, "o", color="white", mec="black", ms=8, zorder=5)
    ax.text(*(cg + np.array([-0.34, 0.16])), "CG", fontsize=12)
    ax.text(*((corners[1] + cg) / 2 + np.array([0.08, 0.1])), "$r_R$", color="tab:red", fontsize=13)
    ax.text(
        *((corners[0] + cg) / 2 + np.array([-0.29, 0.02])), "$r_L$", color="tab:red", fontsize=13
    )
    span(ax, corners[0], foot, "$b_L$", -0.16 * _turned(0.0, 1.0))
    span(ax, foot, corners[1], "$b_R$", -0.16 * _turned(0.0, 1.0))
    span(ax, of_body(0, 0), of_body(0, CG), "$h$", 0.2 * _turned(1.0, 0.0))
    span(ax, of_body(-width, 0), of_body(-width, HEIGHT), "$H$", -0.2 * _turned(1.0, 0.0))
    span(ax, of_body(-width, HEIGHT), of_body(0, HEIGHT), "$B$", 0.16 * _turned(0.0, 1.0))

    # angles: of the body's axis against the normal, and of the lines to the corners
    up = math.pi / 2 + BETA
    ax.plot(*np.array([corners[1], placed(0.0, 2.95)]).T, color="0.6", lw=0.8, ls=":")
    angle(ax, corners[1], 2.05, up - THETA, up, r"$\theta$")
    down = up - THETA + math.pi
    to_right = math.atan2(*(corners[1] - cg)[::-1]) + 2 * math.pi
    to_left = math.atan2(*(corners[0] - cg)[::-1]) + 2 * math.pi
    angle(ax, cg, 0.55, down, to_right, r"$\alpha_R$")
    angle(ax, cg, 0.72, to_left, down, r"$\alpha_L$")

    # axes, forces, ground
    origin = placed(1.55, 0.25)
    arrow(ax, origin, origin + 0.8 * ALONG)
    arrow(ax, origin, origin + 0.8 * NORMAL)
    ax.text(*(origin + 0.9 * ALONG), "$x$", fontsize=13)
    ax.text(*(origin + 0.88 * NORMAL + np.array([-0.05, 0.02])), "$y$", fontsize=13)
    arrow(ax, cg, cg + 0.75 * ALONG, color="tab:green")
    arrow(ax, cg, cg + 0.75 * NORMAL, color="tab:green")
    ax.text(
        *(cg + 0.84 * ALONG + np.array([-0.02, -0.02])), "$f_t$", color="tab:green", fontsize=13
    )
    ax.text(*(cg + 0.8 * NORMAL + np.array([-0.22, 0.03])), "$f_n$", color="tab:green", fontsize=13)
    ground = np.array([-3.0, 1.75])
    arrow(ax, ground, ground + np.array([0.75, 0.0]), color="tab:purple")
    arrow(ax, ground, ground + np.array([0.0, 0.75]), color="tab:purple")
    arrow(ax, ground, ground + np.array([0.0, -0.6]), color="0.3")
    ax.text(*(ground + np.array([0.8, -0.05])), "$a_x$", color="tab:purple", fontsize=13)
    ax.text(*(ground + np.array([-0.08, 0.82])), "$a_y$", color="tab:purple", fontsize=13)
    ax.text(*(ground + np.array([0.06, -0.6])), "$g$", color="0.3", fontsize=13)
    ax.text(*(ground + np.array([-0.1, 1.15])), "ground", color="tab:purple", fontsize=11)
    pressing = corners[1] - 0.7 * NORMAL
    arrow(ax, pressing, corners[1] - 0.06 * NORMAL, color="tab:orange")
    arrow(ax, corners[1] + 0.06 * ALONG, corners[1] + 0.7 * ALONG, color="tab:orange")
    ax.text(*(pressing + np.array([-0.2, 0.0])), "$N$", color="tab:orange", fontsize=13)
    ax.text(*(corners[1] + 0.72 * ALONG - 0.2 * NORMAL), "$T$", color="tab:orange", fontsize=13)
    spin = of_body(0.25, HEIGHT + 0.1)
    ax.annotate(
        "", xy=tuple(spin + np.array([0.42, -0.28])), xytext=tuple(spin + np.array([-0.3, 0.1])),
        arrowprops={"arrowstyle": "-|>", "connectionstyle": "arc3,rad=-0.35", "lw": 1.3},
    )  # fmt: skip
    ax.text(*(spin + np.array([0.42, -0.1])), r"$\omega > 0$", fontsize=12)
    ax.set_xlim(-3.4, 3.3)
    ax.set_ylim(-1.25, 3.75)
    return figure


def _turned(u: float, v: float) -> np.ndarray:
    """A direction of the body as drawn."""
    return of_body(u, v) - of_body(0.0, 0.0)
