"""Scenes that several tests share."""

import numpy as np

import pyopacity as po


def tangle(seed: int = 1, strands: int = 40, points: int = 8, step: float = 1.0):
    """Random walks in a ball of radius 10 or so; (points, offsets)."""
    rng = np.random.default_rng(seed)
    starts = rng.uniform(-6, 6, (strands, 1, 3))
    steps = rng.normal(0, step, (strands, points, 3))
    walk = starts + np.cumsum(steps, axis=1)
    return walk.reshape(-1, 3), np.arange(strands + 1) * points


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
