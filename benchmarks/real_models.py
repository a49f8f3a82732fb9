"""Real models as they are measured and pictured: what they stand on, and how they are lit.

Files are those of PYOPACITY_DATA (default: ../shared/data beside the checkout).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from depth_error import DATA, LIGHT, OPACITY

import pyopacity as po

Vector = tuple[float, float, float]
X_UP, Y_UP, Z_UP = range(3)


@dataclass(frozen=True)
class Model:
    """Shapes over a ground.

    Attributes:
        make: loads the shapes.
        up: the axis that points away from the ground.
        light: in which a directional light travels.
        ground: where the ground lies on the axis; None for below everything.
    """

    make: Callable[[], list[po.Shape]]
    up: int = Z_UP
    light: Vector = LIGHT
    ground: float | None = None

    def level(self, shapes: Iterable[po.Shape]) -> float:
        """Of the ground, on the axis that points up."""
        lowest = po.Bounds.union(shape.bounds for shape in shapes).min[self.up]
        return float(lowest) if self.ground is None else self.ground


def ground(middle: Vector, half: float, up: int, cells: int = 1) -> po.Mesh:
    """A square of side 2 half that receives and does not cast, cut into cells x cells."""
    across = [axis for axis in range(3) if axis != up]
    steps = np.linspace(-half, half, cells + 1)
    points = np.tile(np.array(middle, np.float64), ((cells + 1) ** 2, 1))
    points[:, across] += np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    first = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).reshape(-1, 1)
    corners = np.array([0, 1, cells + 2, 0, cells + 2, cells + 1])
    normals = np.tile(np.eye(3)[up], (len(points), 1))
    mesh = po.Mesh(
        points, (first + corners).reshape(-1, 3), normals=normals, color=(0.42, 0.4, 0.34)
    )
    mesh.casts = False
    return mesh


def wide_ground(casters: list[po.Shape], model: Model) -> po.Mesh:
    """Below them, as far as the horizon."""
    box = po.Bounds.union(shape.bounds for shape in casters)
    middle = 0.5 * (box.min + box.max)
    middle[model.up] = model.level(casters)
    x, y, z = middle.tolist()
    return ground((x, y, z), 40.0 * float(np.max(box.max - box.min)), model.up)


def sphere(center: Vector, radius: float, rows: int = 48) -> po.Mesh:
    """An opaque ball of 2 * rows columns."""
    columns = 2 * rows
    polar = np.linspace(0, np.pi, rows + 1)[:, None]
    around = np.linspace(0, 2 * np.pi, columns + 1)[None, :]
    unit = np.stack(
        np.broadcast_arrays(
            np.sin(polar) * np.cos(around), np.sin(polar) * np.sin(around), np.cos(polar)
        ),
        axis=-1,
    ).reshape(-1, 3)
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).reshape(-1, 1)
    quads = first + np.array([0, columns + 1, 1, 1, columns + 1, columns + 2])
    return po.Mesh(unit * radius + center, quads.reshape(-1, 3), color=(0.75, 0.6, 0.5))


def load(*names: str) -> list[po.Shape]:
    """All shapes of these files."""
    return [shape for name in names for shape in po.load(str(DATA / name))]


def straight() -> list[po.Shape]:
    """The model of the deep opacity maps paper, with a ball for its head."""
    (hair,) = load("hair/straight.hair")
    hair.opacity, hair.color = OPACITY, (0.62, 0.42, 0.22)
    return [hair, sphere((-0.06, -0.23, 38.63), 18.5)]


def bear() -> list[po.Shape]:
    """Fur on its body."""
    fur, body = load("hair/bear.hair", "opaque/bear_body.obj")
    fur.opacity, fur.color = OPACITY, (0.5, 0.36, 0.24)
    body.color = (0.18, 0.13, 0.1)
    return [fur, body]


def ponytail() -> list[po.Shape]:
    """Hair on its head."""
    hair, head = load("hair/ponytail.hair", "opaque/ponytail_head.obj")
    hair.opacity, hair.color = OPACITY, (0.35, 0.2, 0.1)
    head.color = (0.7, 0.52, 0.42)
    return [hair, head]


def selfshadow(name: str) -> list[po.Shape]:
    """A model of the thesis; its file does not hold that its material green_trans lets through."""
    shapes = load(f"foliage/cs_selfshadow_{name}.obj")
    for shape in shapes:
        if np.allclose(shape.color, (0.2, 0.6, 0.2)):
            shape.opacity = 176 / 255
    return shapes


def smoke(name: str, factor: float) -> list[po.Shape]:
    """A volume whose file holds densities: extinction is a factor of them."""
    (volume,) = load(f"volume/{name}.nrrd")
    volume.extinction = factor * volume.extinction
    volume.color = (0.9, 0.9, 0.9)
    return [volume]


def lidar() -> list[po.Shape]:
    """Returns from a forest as spheres: those from above a metre, since the file has the ground."""
    (returns,) = load("volume/lidar_mixed_conifer_37657.ply")
    centers = returns.points[returns.points[:, 2] > 1.0]
    shade = np.clip(centers[:, 2:] / 32.0, 0.0, 1.0)
    color = (1.0 - shade) * (0.06, 0.14, 0.04) + shade * (0.25, 0.34, 0.1)
    return [po.Particles(centers, radius=0.6, opacity=0.7, color=color)]


FROM_THE_SIDE = (0.6, -0.8, 0.1)

MODELS = {
    "straight.hair": Model(straight),
    "bear.hair on its body": Model(bear, Y_UP, (0.6, -0.8, -0.3)),
    "ponytail.hair on its head": Model(ponytail, Y_UP, (0.5, -0.8, -0.3)),
    "San Miguel, leaves": Model(
        lambda: load("foliage/sanmiguel_tree_a_leaves.glb"), Y_UP, FROM_THE_SIDE
    ),
    "oak": Model(lambda: load("foliage/eztree_oak_large.obj"), Y_UP, FROM_THE_SIDE),
    "nettle": Model(lambda: load("foliage/urtica_dioica_1.obj")),
    "thesis, tree": Model(lambda: selfshadow("tree"), Y_UP, FROM_THE_SIDE),
    "thesis, plant": Model(lambda: selfshadow("plant"), Y_UP, FROM_THE_SIDE),
    "smoke": Model(lambda: smoke("openvdb_smoke_111x222x112", 0.4), Y_UP, FROM_THE_SIDE),
    "stratocumulus": Model(lambda: smoke("les_stratocumulus_64x64x16", 40.0), ground=0.0),
    "lidar forest": Model(lidar, ground=0.0),
}


def model(name: str) -> Model:
    """One of these, or a generated one, "demo:" with its options."""
    if name.startswith("demo:"):
        return Model(lambda: po.load(name), ground=0.0)
    return MODELS[name]
