"""Scenes that several tests share."""

import numpy as np

import pyopacity as po

CASTING = [name for name in po.techniques() if name != "unshadowed"]
# Those that let light through: to a shadow map every caster is opaque.
TRANSLUCENT = [name for name in CASTING if name != "shadow_map"]
# Where T may rise along the light: a series that ends rings.
RINGING = {"fourier_opacity_maps"}
# Techniques that keep a few sums of a texel: how far off T is inside an even medium.
SUMS_ALONE = {"fourier_opacity_maps": 0.01, "moment_opacity_maps": 0.2}


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


def random_shapes(seed: int) -> list[po.Shape]:
    """A caster of each kind, about three units across, with changing attributes, each moved."""
    random = np.random.default_rng(seed)
    steps = random.normal(0.0, 0.4, (8, 7, 3))
    steps[0, 3] = 0.0  # a point twice
    xyz = (random.uniform(-1, 1, (8, 1, 3)) + np.cumsum(steps, axis=1)).reshape(-1, 3)
    width, opacity = random.uniform(0.05, 0.5, 56), random.uniform(0.0, 1.0, 56)
    width[3], opacity[3] = width[2], opacity[2]
    hair = po.Strands(xyz, np.arange(0, 57, 7), width, opacity)
    corners = random.uniform(-1.5, 1.5, (12, 3, 3)).astype(np.float32).reshape(-1, 3)
    veils = po.Mesh(corners, np.arange(36).reshape(12, 3), opacity=random.uniform(0, 1, 36))
    stone = po.Mesh(0.4 * corners[:9], np.arange(9).reshape(3, 3))
    dust = po.Particles(
        random.uniform(-1.2, 1.2, (10, 3)), random.uniform(0.1, 0.6, 10), random.uniform(0, 1, 10)
    )
    balls = po.Particles(0.8 * dust.points, dust.radius, dust.opacity, profile="metaball")
    density = random.uniform(0.0, 2.0, (5, 3, 4)).astype(np.float32)
    density[random.uniform(size=density.shape) < 0.5] = 0.0
    smoke = po.Volume(density, (-0.6, -0.4, -0.8), (0.4, 0.5, 0.3))
    shapes = [hair, veils, stone, dust, smoke, *_leaves(random), balls]
    for shape in shapes:
        matrix = np.eye(4)
        matrix[:3, :3] = np.linalg.qr(random.normal(size=(3, 3)))[0] * random.uniform(0.5, 2.0)
        matrix[:3, 3] = random.uniform(-0.5, 0.5, 3)
        shape.transform = matrix
    return shapes


def _leaves(random: np.random.Generator) -> list[po.Mesh]:
    """With an alpha map of each mode, which repeats over them."""
    return [
        po.Mesh(
            random.uniform(-1.2, 1.2, (12, 3)),
            np.arange(12).reshape(4, 3),
            opacity=random.uniform(0.5, 1, 12),
            uvs=random.uniform(-1.5, 2.5, (12, 2)),
            alpha_map=random.uniform(0, 1, (3, 5)).astype(np.float32),
            alpha_mode=mode,
        )
        for mode in ("mask", "blend")
    ]


def flat_to_the_light(scene: po.Scene) -> None:
    """Leaves no surface that knows more of itself than a point there: light from above, no ball.

    Of :func:`conftest.tuft_and_ball`.
    """
    scene.remove(scene.lights[0])
    scene.add(po.DirectionalLight((0.0, 0.0, -1.0)))
    scene.shapes[1].casts = scene.shapes[1].receives = False
