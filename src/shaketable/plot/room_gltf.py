"""One shaking of a whole room as an animated scene in glTF 2.0."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from shaketable.atomic_files import appearing_file
from shaketable.drawing.files import require_scene
from shaketable.drawing.solid_gltf import BODY, MOST_POSES, POSES_PER_SECOND, WALL, Z_TO_Y, Store
from shaketable.drawing.solid_mesh import Prism, prisms_of
from shaketable.plot.room_film import WALLS, standing, times_of
from shaketable.rooms.once import RoomShaken

FLOOR, FURNITURE = [0.92, 0.92, 0.92, 1.0], [0.80, 0.82, 0.84, 1.0]
THICK = 0.03  # m: of walls and floor


def write_room_gltf(shaken: RoomShaken, path: Path) -> Path:
    """Write a room, its things and their motion as binary glTF (.glb), seen from its floor.

    Raises:
        InputError: another ending, or the extra `gltf` is not installed.
    """
    require_scene(path)
    from pygltflib import GLTF2, Asset, Node, Scene

    room = shaken.room
    made = GLTF2(asset=Asset(generator="shaketable"), scene=0, scenes=[Scene(nodes=[0])])
    store = Store(made)
    corners = np.array(room.outline)
    floor = Prism(_counterclockwise(corners), -THICK, 0.0)
    made.nodes = [
        Node(name="level ground", rotation=Z_TO_Y, children=[]),
        Node(name=room.name, mesh=store.mesh(room.name, [floor], FLOOR)),
    ]
    walls = [_wall(*ends) for ends in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
    made.nodes.append(Node(name="walls", mesh=store.mesh("walls", walls, WALL)))
    simulated = {each.thing.name for each in shaken.things}
    for number, (part, foot) in enumerate(standing(room, simulated), 1):
        name = f"standing {number}"
        mesh = store.mesh(name, [part], FURNITURE)
        made.nodes.append(Node(name=name, translation=[0.0, 0.0, foot], mesh=mesh))
    time = times_of(shaken, POSES_PER_SECOND, MOST_POSES, 1.0)
    for each in shaken.things:
        position, quaternions = each.poses(time)
        flips = np.where((quaternions[1:] * quaternions[:-1]).sum(axis=1) < 0.0, -1.0, 1.0)
        quaternions[1:] *= np.cumprod(flips)[:, None]
        mesh = store.mesh(each.thing.name, prisms_of(each.response.body), BODY)
        node = Node(
            name=each.thing.name, translation=position[0].tolist(),
            rotation=quaternions[0].tolist(), mesh=mesh,
        )  # fmt: skip
        made.nodes.append(node)
        number = len(made.nodes) - 1
        store.animate(number, time - time[0], translation=position, rotation=quaternions)
    made.nodes[0].children = list(range(1, len(made.nodes)))
    content = store.binary()
    with appearing_file(path) as fresh:
        fresh.write_bytes(content)
    return path


def _counterclockwise(corners: np.ndarray) -> np.ndarray:
    x, y = corners.T
    twice = float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))
    return corners if twice > 0.0 else corners[::-1]


def _wall(start: np.ndarray, end: np.ndarray) -> Prism:
    """A thin wall between two corners, half of it on either side of them."""
    along = (end - start) / np.linalg.norm(end - start)
    out = THICK / 2 * np.array([along[1], -along[0]])
    return Prism(np.array([start + out, end + out, end - out, start - out]), 0.0, WALLS)
