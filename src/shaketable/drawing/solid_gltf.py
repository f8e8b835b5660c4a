"""A run of a solid as an animated scene in glTF 2.0, for any viewer of three dimensions.

The scene is metres with y upward, as the format wants it; the support's frame with x, y and its
normal z is a node in it; the solid, walls and straps are nodes in that one.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from shaketable.atomic_files import appearing_file
from shaketable.drawing.files import require_scene
from shaketable.drawing.solid_frames import (
    ShownPull,
    ShownRun,
    planes_of,
    poses_of,
    pulls_of,
    tilting,
)
from shaketable.drawing.solid_mesh import Prism, prisms_of

if TYPE_CHECKING:
    from pygltflib import GLTF2

POSES_PER_SECOND = 60
MOST_POSES = 36_000
BODY, PLATE = [0.24, 0.47, 0.71, 1.0], [0.86, 0.86, 0.86, 1.0]
STRAP = [0.84, 0.15, 0.16, 1.0]
WALL = [0.75, 0.72, 0.65, 0.5]
THICK = 0.01  # of the plate's width
NARROW = 0.01  # half the width of a strap, in sizes of the body
Z_TO_Y = [-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]  # a quarter turn about x


def write_gltf(run: ShownRun, path: Path) -> Path:
    """Write the solid, walls, straps, its support and its motion as binary glTF (.glb).

    Raises:
        InputError: another ending, or the extra `gltf` is not installed.
    """
    require_scene(path)
    from pygltflib import GLTF2, Asset, Node, Scene

    poses = poses_of(run, POSES_PER_SECOND, MOST_POSES, 1.0)
    made = GLTF2(asset=Asset(generator="shaketable"), scene=0, scenes=[Scene(nodes=[0])])
    store = Store(made)
    size = max(float(np.linalg.norm(part.vertices, axis=1).max()) for part in prisms_of(run.body))
    half = float(np.abs(poses.position[:, :2]).max()) + 2.0 * size
    square = half * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    name = run.body.name or "solid"
    made.nodes = [
        Node(name="level ground", rotation=Z_TO_Y, children=[1]),
        Node(
            name="support",
            rotation=_quaternion(tilting(run.support)),
            mesh=store.mesh("support", [Prism(square, -2 * THICK * half, 0.0)], PLATE),
            children=[2],  # and walls and straps
        ),
        Node(
            name=name,
            translation=poses.position[0].tolist(),
            rotation=poses.quaternions[0].tolist(),
            mesh=store.mesh(name, prisms_of(run.body), BODY),
        ),
    ]
    time = poses.time - poses.time[0]
    unit = poses.quaternions / np.linalg.norm(poses.quaternions, axis=1)[:, None]
    store.animate(2, time, translation=poses.position, rotation=unit)
    for number, pull in enumerate(pulls_of(run, poses), 1):
        _add_strap(store, made, f"strap {number}", pull, time, NARROW * size)
    square = size * np.array([[0.0, -1.0], [2 * THICK, -1.0], [2 * THICK, 1.0], [0.0, 1.0]])
    for number, plane in enumerate(planes_of(run), 1):
        made.nodes[1].children.append(len(made.nodes))
        made.nodes.append(
            Node(
                name=f"wall {number}",
                translation=plane.foot.tolist(),
                rotation=_quaternion(plane.axes),
                mesh=store.mesh(f"wall {number}", [Prism(square, 0.0, 2.5 * size)], WALL),
            )
        )
    content = store.binary()
    with appearing_file(path) as fresh:
        fresh.write_bytes(content)
    return path


def _add_strap(
    store: Store,
    made: GLTF2,
    name: str,
    pull: ShownPull,
    time: NDArray[np.float64],
    narrow: float,
) -> None:
    """A strap as a bar of one metre, turned and scaled to its length; no length once it broke."""
    from pygltflib import Node
    from scipy.spatial.transform import Rotation

    square = narrow * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    along = pull.point - pull.anchor
    length = np.linalg.norm(along, axis=1)
    up = np.array([[0.0, 0.0, 1.0]])
    turns = np.array(
        [
            Rotation.align_vectors(each[None], up)[0].as_quat() if far > 0.0 else [0, 0, 0, 1]
            for each, far in zip(along, length, strict=True)
        ]
    )
    whole = pull.whole.astype(float)
    scale = np.column_stack([whole, whole, whole * length])
    node = len(made.nodes)
    made.nodes.append(
        Node(
            name=name,
            translation=pull.anchor.tolist(),
            rotation=turns[0].tolist(),
            scale=scale[0].tolist(),
            mesh=store.mesh(name, [Prism(square, 0.0, 1.0)], STRAP),
        )
    )
    made.nodes[1].children.append(node)
    store.animate(node, time, rotation=turns, scale=scale)


def _quaternion(turn: NDArray[np.float64]) -> list[float]:
    from scipy.spatial.transform import Rotation

    return [float(each) for each in Rotation.from_matrix(turn).as_quat()]


class Store:
    """The meshes and the animation of a scene, and the numbers that they are made of."""

    def __init__(self, made: GLTF2) -> None:
        """Nothing in it yet; `made` is the scene."""
        self._made = made
        self._numbers = bytearray()

    def mesh(self, name: str, parts: Sequence[Prism], colour: list[float]) -> int:
        """Add a mesh whose faces are flat; returns its number."""
        import pygltflib as gltf

        corners: list[Any] = []
        for part in parts:
            for face in part.faces:
                outline = part.vertices[face]
                for k in range(1, len(outline) - 1):
                    corners += [outline[0], outline[k], outline[k + 1]]
        points = np.array(corners).reshape(-1, 3, 3)
        across = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
        length = np.linalg.norm(across, axis=1)
        points, across = points[length > 0.0], across[length > 0.0]
        normals = np.repeat(across / np.linalg.norm(across, axis=1)[:, None], 3, axis=0)
        material = gltf.PbrMetallicRoughness(
            baseColorFactor=colour, metallicFactor=0.0, roughnessFactor=0.9
        )
        mode = gltf.BLEND if colour[3] < 1.0 else gltf.OPAQUE
        self._made.materials.append(
            gltf.Material(name=name, pbrMetallicRoughness=material, alphaMode=mode)
        )
        primitive = gltf.Primitive(
            attributes=gltf.Attributes(
                POSITION=self._accessor(points.reshape(-1, 3), gltf.VEC3, gltf.ARRAY_BUFFER),
                NORMAL=self._accessor(normals, gltf.VEC3, gltf.ARRAY_BUFFER),
            ),
            material=len(self._made.materials) - 1,
        )
        self._made.meshes.append(gltf.Mesh(name=name, primitives=[primitive]))
        return len(self._made.meshes) - 1

    def animate(self, node: int, time: NDArray[np.float64], **moved: NDArray[np.float64]) -> None:
        """Let a node move; each of `moved` is a way of glTF, as its values at some times [s]."""
        import pygltflib as gltf

        if not self._made.animations:  # viewers play one
            self._made.animations.append(gltf.Animation(name="shaking"))
        shaking = self._made.animations[0]
        at = self._accessor(time, gltf.SCALAR)
        for path, values in moved.items():
            kind = gltf.VEC4 if path == "rotation" else gltf.VEC3
            target = gltf.AnimationChannelTarget(node=node, path=path)
            channel = gltf.AnimationChannel(sampler=len(shaking.samplers), target=target)
            shaking.channels.append(channel)
            shaking.samplers.append(
                gltf.AnimationSampler(input=at, output=self._accessor(values, kind))
            )

    def binary(self) -> bytes:
        """The whole file."""
        import pygltflib as gltf

        self._made.buffers = [gltf.Buffer(byteLength=len(self._numbers))]
        self._made.set_binary_blob(bytes(self._numbers))
        return b"".join(self._made.save_to_bytes())

    def _accessor(self, values: NDArray[np.float64], kind: str, target: int | None = None) -> int:
        import pygltflib as gltf

        packed = np.ascontiguousarray(values, np.float32)
        made = self._made
        made.bufferViews.append(
            gltf.BufferView(
                buffer=0, byteOffset=len(self._numbers), byteLength=packed.nbytes, target=target
            )
        )
        self._numbers += packed.tobytes()
        flat = packed.reshape(len(packed), -1)
        made.accessors.append(
            gltf.Accessor(
                bufferView=len(made.bufferViews) - 1,
                componentType=gltf.FLOAT,
                count=len(packed),
                type=kind,
                min=flat.min(axis=0).tolist(),
                max=flat.max(axis=0).tolist(),
            )
        )
        return len(made.accessors) - 1
