"""What holds of any casters together: T of a union is the product of the parts' T."""

import numpy as np
import pytest

import pyopacity as po
from scenes import tangle

LIGHTS = {
    "directional": po.DirectionalLight((0.3, 0.2, -1.0)),
    "point": po.PointLight((4.0, 3.0, 30.0)),
}


def parts():
    points, offsets = tangle(4, strands=30)
    random = np.random.default_rng(8)
    square = np.array([(-6.0, -6, 1), (6, -6, 1), (6, 6, 1), (-6, 6, 1)])
    return [
        po.Strands(points, offsets, width=0.3, opacity=0.4),
        po.Mesh(square, np.array([(0, 1, 2), (0, 2, 3)]), opacity=0.5),
        po.Mesh(
            square - (0.0, 0.0, 2.0),
            np.array([(0, 1, 2), (0, 2, 3)]),
            uvs=np.ascontiguousarray(square[:, :2]),
            alpha_map=random.uniform(0, 1, (5, 7)).astype(np.float32),
            alpha_mode="blend",
        ),
        po.Particles(random.uniform(-6, 6, (60, 3)), radius=1.0, opacity=0.3),
        po.Particles(random.uniform(-6, 6, (60, 3)), radius=1.5, opacity=0.4, profile="metaball"),
        po.Volume(random.uniform(0, 0.1, (8, 8, 8)), origin=(-4.0, -4.0, -4.0)),
    ]


@pytest.mark.parametrize("light", LIGHTS)
def test_the_union_of_scenes_multiplies_t(light):
    """Below all casters, in one texel each: filter none, so that a mean of products stays one."""
    shapes = parts()
    below = np.random.default_rng(3).uniform((-4, -4, -20), (4, 4, -20), (500, 3))
    # All parts lie in one map of the same place and size: that of what is asked for, within this.
    frame = po.Mesh(
        np.array([(-40.0, -40, -15), (40, -40, -15), (40, 40, 15), (-40, 40, 15)]),
        np.array([(0, 1, 2), (0, 2, 3)]),
        opacity=1e-6,
    )
    for shape in (*shapes, frame):
        shape.receives = False
    technique = po.technique("exact", bias=0.0, filter="none")

    def T(*casters):
        return po.transmittance(
            po.Scene(*casters, frame, LIGHTS[light]), below, technique, map_size=128
        )

    product = np.prod([T(shape).astype(np.float64) for shape in shapes], axis=0)
    union = T(*shapes)
    assert union.min() < 0.3
    assert np.abs(union - product).max() < 1e-4


@pytest.mark.parametrize("light", LIGHTS)
def test_an_instance_casts_as_a_copy_of_its_points_would(light):
    strands = parts()[0]
    moved = np.eye(4)
    moved[:3, 3] = (3.0, -2.0, 1.0)
    instance = strands.instance(moved)
    copy = po.Strands(strands.points + moved[:3, 3], strands.offsets, width=0.3, opacity=0.4)
    asked = np.random.default_rng(5).uniform(-6, 6, (500, 3))
    T = [
        po.transmittance(po.Scene(strands, other, LIGHTS[light]), asked, map_size=128)
        for other in (instance, copy)
    ]
    assert np.abs(T[0] - T[1]).max() < 1e-4
