"""Renders the pictures of this folder: python docs/gallery/make_gallery.py [NAME...]

Real models come from PYOPACITY_DATA (default: ../shared/data beside the checkout); a picture whose
model is not there is left as it is.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import pyopacity as po

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "benchmarks"))
import real_models
from real_models import Vector

HERE = Path(__file__).resolve().parent

SKY = (0.42, 0.54, 0.68, 1.0)
OPTIONS = {"size": (560, 420), "map_size": 512, "antialiasing": 3, "background": SKY}


@dataclass(frozen=True)
class Picture:
    """A model as a camera sees it.

    Attributes:
        model: its name in benchmarks/real_models.py, or of a generated one.
        view: the direction in which the camera looks.
        light: in which light travels; None for that of all benchmarks.
        intensity: of the light.
        zoom: how much larger than all of it fits.
    """

    model: str
    view: Vector
    light: Vector | None = None
    intensity: float = 1.3
    zoom: float = 1.0


FRONT, LEFT = (0.3, 1.0, -0.25), (0.4, -1.0, -0.3)  # where shadows fall behind, and to the left

PICTURES = {
    "demo_hair": Picture("demo:hair", FRONT),
    "demo_curly": Picture("demo:hair?style=curly", FRONT),
    "demo_fur": Picture("demo:fur", FRONT),
    "demo_teapot": Picture("demo:teapot", (0.3, 1.0, -0.4)),
    "straight_lit_side": Picture("straight.hair", (0.6, 0.8, -0.3)),
    "straight_far_side": Picture("straight.hair", (-1.0, -0.5, -0.3)),
    "straight_backlit": Picture("straight.hair", (0.2, 1.0, -0.15), (-0.3, -1.0, -0.25)),
    "bear": Picture("bear.hair on its body", (0.5, -0.3, -1.0)),
    "bear_far_side": Picture("bear.hair on its body", (-0.9, -0.3, 0.4)),
    "ponytail": Picture("ponytail.hair on its head", (0.8, -0.15, -0.6), zoom=1.3),
    "san_miguel": Picture("San Miguel, leaves", (0.3, -0.3, 1.0), intensity=1.7, zoom=1.2),
    "oak": Picture("oak", (0.3, -0.25, 1.0), zoom=1.2),
    "nettle": Picture("nettle", (-0.4, 1.0, -0.5), zoom=1.4),
    "thesis_tree": Picture("thesis, tree", (0.3, -0.3, 1.0), zoom=1.3),
    "thesis_plant": Picture("thesis, plant", (0.3, -0.5, 1.0), zoom=1.4),
    "smoke": Picture("smoke", (0.3, -0.12, 1.0), (0.8, -0.5, -0.1), 1.1, zoom=1.3),
    "stratocumulus": Picture("stratocumulus", (0.3, 1.0, -0.4), (0.8, -0.3, -0.5), 0.9, zoom=1.2),
    "lidar_forest": Picture("lidar forest", (0.3, 1.0, -0.4), (0.8, -0.1, -0.6), 1.5, zoom=1.4),
    "demo_tree": Picture("demo:tree", LEFT, zoom=1.2),
    "demo_meadow": Picture("demo:grass", (0.4, -1.0, -0.4), zoom=1.8),
    "demo_smoke": Picture("demo:smoke", LEFT, (-0.8, -0.2, -0.6), 1.1, zoom=1.2),
    "demo_clouds": Picture("demo:clouds", (0.3, 1.0, -0.35), (-0.8, 0.0, -0.6), 1.1, zoom=1.3),
    "demo_plume": Picture("demo:plume", LEFT, (-0.7, -0.3, -0.7), zoom=1.0),
    "demo_mixed": Picture("demo:mixed", LEFT, zoom=1.3),
}


def camera(casters: list[po.Shape], picture: Picture, up: int) -> po.Camera:
    """Sees all of them, or their middle from nearer."""
    fitted = po.Camera.fit(casters, picture.view, np.eye(3)[up].tolist())
    x, y, z = np.add(fitted.target, np.subtract(fitted.eye, fitted.target) / picture.zoom)
    return po.Camera.look_at((x, y, z), fitted.target, fitted.up, fitted.fov_deg)


def staged(picture: Picture) -> tuple[po.Scene, po.Camera]:
    """Its model on a ground, lit."""
    model = real_models.model(picture.model)
    shapes = model.make()
    casters = [shape for shape in shapes if shape.casts]
    scene = po.Scene(shapes)
    if len(casters) == len(shapes):
        scene.add(real_models.wide_ground(casters, model))
    else:
        shapes[-1].transform = np.diag((20.0, 20.0, 1.0, 1.0))  # to the horizon
    direction = picture.light or model.light
    scene.add(po.DirectionalLight(direction, intensity=picture.intensity))
    return scene, camera(casters, picture, model.up)


def render(name: str) -> None:
    technique = po.technique("bounding_opacity_maps", layers=16)
    with po.Renderer(*staged(PICTURES[name]), technique=technique, **OPTIONS) as r:
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
