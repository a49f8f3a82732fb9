"""Scenes that several tests share."""

import numpy as np

import pyopacity as po
from pyopacity.stress.shapes import random_shapes as random_shapes
from pyopacity.stress.shapes import tangle as tangle
from pyopacity.stress.way import CASTING as CASTING
from pyopacity.stress.way import TRANSLUCENT as TRANSLUCENT

# Where T may rise along the light: a series that ends rings.
RINGING = {"fourier_opacity_maps"}
# Techniques that keep a few sums of a texel: how far off T is inside an even medium.
SUMS_ALONE = {"fourier_opacity_maps": 0.01, "moment_opacity_maps": 0.2}


def hair_over_ball():
    points, offsets = tangle(7, strands=120)
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 17), np.linspace(0, np.pi, 9))
    ball = 2.5 * np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)], -1).reshape(
        -1, 3
    )
    row = np.arange(16)
    quads = np.concatenate(
        [np.stack([r * 17 + row, r * 17 + row + 1, r * 17 + row + 17], 1) for r in range(8)]
    )
    other = np.concatenate(
        [np.stack([r * 17 + row + 1, r * 17 + row + 18, r * 17 + row + 17], 1) for r in range(8)]
    )
    scene = po.Scene()
    scene.add(po.Strands(points, offsets, width=0.2, opacity=0.3))
    scene.add(po.Mesh(ball, np.concatenate([quads, other])))
    scene.add(po.DirectionalLight(direction=(0.2, 0.1, -1.0)))
    return scene


def impersonal(name, **parameters):
    """A technique that answers at a shape's points as at any other: own_correction off."""
    technique = po.technique(name, **parameters)
    if "own_correction" in {parameter.name for parameter in technique.parameters}:
        technique.own_correction = False
    return technique


def flat_to_the_light(scene: po.Scene) -> None:
    """Leaves no surface that knows more of itself than a point there: light from above, no ball.

    Of :func:`conftest.tuft_and_ball`.
    """
    scene.remove(scene.lights[0])
    scene.add(po.DirectionalLight((0.0, 0.0, -1.0)))
    scene.shapes[1].casts = scene.shapes[1].receives = False
