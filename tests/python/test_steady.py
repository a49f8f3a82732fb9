"""What moves by less than a texel: T moves by little, and nothing flickers."""

import numpy as np

import pyopacity as po
from scenes import tangle

STEPS = 8
MAP_SIZE = 64


def flicker(steady, move):
    """Means over points: of |T - T one frame before|, and from the second frame to the last."""
    points, offsets = tangle(3, strands=80)
    strands = po.Strands(points, offsets, width=0.3, opacity=0.4)
    light = po.DirectionalLight((0.2, 0.1, -1.0))
    scene = po.Scene(strands, light)
    asked = np.random.default_rng(1).uniform(-6, 6, (3000, 3))
    T = []
    with po.Renderer(scene, device="cpu", map_size=MAP_SIZE, steady=steady) as renderer:
        texel = None
        for step in range(STEPS):
            if texel is not None:
                move(strands, light, step * texel)
            T.append(renderer.transmittance(asked))
            if texel is None:
                texel = 1.0 / np.linalg.norm(renderer.light_from_world[0, :3])
    # The first map just fits; from the second on there is room.
    return np.mean(np.abs(np.diff(T[1:], axis=0))), np.mean(np.abs(T[-1] - T[1]))


def grow(strands, light, distance):
    """The outermost strand leaves the others, and would take the box with it."""
    points = strands.points.copy()
    first = 8 * (int(points[:, 0].argmax()) // 8)
    points[first : first + 8, 0] += distance / STEPS
    strands.points = points


def turn(strands, light, distance):
    light.direction = (0.2 + 0.003 * distance, 0.1, -1.0)


def test_a_strand_that_leaves_by_less_than_a_texel_a_frame_leaves_the_others_their_shadow():
    held, _ = flicker(True, grow)
    refitted, _ = flicker(False, grow)
    assert held < 0.006
    assert held < 0.6 * refitted


def test_a_light_that_turns_by_less_than_a_texel_changes_t_by_little():
    step, whole = flicker(True, turn)
    assert step < 0.01
    assert step * (STEPS - 2) < 3.0 * whole + 0.02  # it goes somewhere, not to and fro
