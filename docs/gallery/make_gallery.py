"""Renders the pictures of this folder: python docs/gallery/make_gallery.py [NAME...]

Real models come from PYOPACITY_DATA (default: ../shared/data beside the checkout); a picture whose
model is not there is left as it is.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

import numpy as np

import pyopacity as po

HERE = Path(__file__).resolve().parent
DATA = Path(os.environ.get("PYOPACITY_DATA", HERE.parents[2] / "shared" / "data"))
SIZE = (560, 420)
SKY = (0.62, 0.68, 0.75, 1.0)


def sphere(center: tuple[float, float, float], radius: float, rows: int = 48) -> po.Mesh:
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


def ground(box: po.Bounds, up: int) -> po.Mesh:
    """A square below a box, six times as wide, that receives and does not cast."""
    center = 0.5 * (box.min + box.max)
    half = 3.0 * float(np.max(box.max - box.min))
    across = [axis for axis in range(3) if axis != up]
    corners = np.tile(center, (4, 1))
    corners[:, across] += half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    corners[:, up] = box.min[up]
    normals = np.zeros((4, 3))
    normals[:, up] = 1.0
    mesh = po.Mesh(
        corners, np.array([[0, 1, 2], [0, 2, 3]]), normals=normals, color=(0.5, 0.5, 0.5)
    )
    mesh.casts = False
    return mesh


def straight() -> list[po.Shape]:
    """The model of the deep opacity maps paper, with a ball for its head."""
    shapes = po.load(str(DATA / "hair/straight.hair"))
    shapes[0].opacity = 0.3
    shapes[0].color = (0.62, 0.42, 0.22)
    return [*shapes, sphere((-0.06, -0.23, 38.63), 18.5)]


def bear() -> list[po.Shape]:
    """Fur on its body."""
    fur = po.load(str(DATA / "hair/bear.hair"))
    fur[0].opacity = 0.3
    fur[0].color = (0.5, 0.36, 0.24)
    body = po.load(str(DATA / "opaque/bear_body.obj"))
    body[0].color = (0.18, 0.13, 0.1)
    return [*fur, *body]


# name: shapes, up axis, direction of the light, direction of the view
PICTURES = {
    "demo_hair": (lambda: po.load("demo:hair"), 2, (0.5, 0.3, -0.8), (0.3, 1.0, -0.25)),
    "demo_curly": (
        lambda: po.load("demo:hair?style=curly"),
        2,
        (0.5, 0.3, -0.8),
        (0.3, 1.0, -0.25),
    ),
    "demo_fur": (lambda: po.load("demo:fur"), 2, (0.5, 0.3, -0.8), (0.3, 1.0, -0.25)),
    "demo_teapot": (lambda: po.load("demo:teapot"), 2, (0.5, 0.3, -0.8), (0.3, 1.0, -0.4)),
    "straight_lit_side": (straight, 2, (0.5, 0.3, -0.8), (0.6, 0.8, -0.3)),
    "straight_far_side": (straight, 2, (0.5, 0.3, -0.8), (-1.0, -0.5, -0.3)),
    "straight_backlit": (straight, 2, (-0.3, -1.0, -0.25), (0.2, 1.0, -0.15)),
    "bear": (bear, 1, (0.6, -0.8, -0.3), (0.5, -0.3, -1.0)),
    "bear_far_side": (bear, 1, (0.6, -0.8, -0.3), (-0.9, -0.3, 0.4)),
}


def render(name: str) -> None:
    make, up, light, view = PICTURES[name]
    shapes = make()
    casters = [shape for shape in shapes if shape.casts]
    scene = po.Scene()
    scene.add(shapes)
    if len(casters) == len(shapes):
        scene.add(ground(po.Bounds.union(shape.bounds for shape in shapes), up))
    scene.add(po.DirectionalLight(direction=light, intensity=1.3))
    camera = po.Camera.fit(casters, view, np.eye(3)[up].tolist())
    technique = po.technique("bounding_opacity_maps", layers=16)
    options = {"size": SIZE, "map_size": 512, "antialiasing": 3, "background": SKY}
    with po.Renderer(scene, camera, technique=technique, **options) as r:
        po.save_image(HERE / f"{name}.png", r.render())
        print(f"{name}\n{r.report}")


def main() -> None:
    for name in sys.argv[1:] or PICTURES:
        try:
            render(name)
        except po.FileFormatError as error:
            print(f"{name}: left as it is: {error.what}")


if __name__ == "__main__":
    main()
