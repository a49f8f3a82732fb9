"""What holds for every technique of the registry, today's and tomorrow's."""

import numpy as np
import pytest

import pyopacity as po
from scenes import CASTING, RINGING, TRANSLUCENT, hair_over_ball, tangle

ALL = sorted(po.techniques())


def small(scene, technique, **options):
    return po.Renderer(
        scene, size=(48, 32), technique=technique, map_size=64, antialiasing=1, **options
    )


@pytest.mark.parametrize("name", ALL)
def test_transmittance_lies_in_0_1_and_falls_along_the_light(needs_gl, name):
    scene = hair_over_ball()
    direction = np.array(scene.lights[0].direction)
    rng = np.random.default_rng(1)
    starts = rng.uniform(-6, 6, (200, 3)) - 20 * direction
    steps = np.linspace(0, 45, 91)
    points = starts[:, None, :] + steps[None, :, None] * direction
    with small(scene, name) as r:
        t = r.transmittance(points.reshape(-1, 3)).reshape(200, 91)
    assert np.isfinite(t).all()
    assert ((t >= 0) & (t <= 1)).all()
    assert name in RINGING or (np.diff(t, axis=1) <= 1e-6).all()
    assert (t[:, 0] == 1).all()  # nothing is in front of all casters
    if name != "unshadowed":
        assert t[:, -1].min() == 0.0  # behind the opaque ball
    if name in TRANSLUCENT:
        assert ((t[:, -1] > 0.01) & (t[:, -1] < 0.99)).any()  # behind hair alone


@pytest.mark.parametrize("name", ALL)
def test_without_casters_or_light_everything_is_lit(needs_gl, name):
    points = np.random.default_rng(2).uniform(-5, 5, (50, 3))
    empty, dark = po.Scene(), hair_over_ball()
    empty.add(po.DirectionalLight(direction=(0, 0, -1)))
    dark.remove(dark.lights[0])
    invisible = hair_over_ball()
    for shape in invisible.shapes:
        shape.casts = False
    for scene in (po.Scene(), empty, dark, invisible):
        with small(scene, name) as r:
            assert (r.transmittance(points) == 1).all()
            assert np.isfinite(r.render()).all()
            assert all(row.status != "ran" for row in r.report if row.name.startswith(name))


@pytest.mark.parametrize("name", ALL)
def test_both_ends_of_every_parameter_render(needs_gl, name):
    scene = hair_over_ball()
    for parameter in po.techniques()[name].parameters:
        for value in ends_of(parameter):
            with small(scene, po.technique(name, **{parameter.name: value})) as r:
                picture = r.render()
                assert np.isfinite(picture).all(), (parameter.name, value)


def ends_of(parameter):
    """The extremes that a parameter's range names."""
    if parameter.type == "bool":
        return [True, False]
    if parameter.type == "choice or list":
        return [word.strip('"') for word in parameter.range.split(", ")[:-1]]
    if parameter.type == "choice":
        return [choice.strip().strip('"') for choice in parameter.range.split(",")]
    convert = int if parameter.type == "int" else float
    if ", " in parameter.range:
        return [convert(choice) for choice in parameter.range.split(", ")]
    ends = [convert(float(end)) for end in parameter.range.replace('"auto" or ', "").split("..")]
    return [*ends, "auto"] if "auto" in parameter.range else ends


@pytest.mark.parametrize("name", TRANSLUCENT)
def test_a_thin_object_is_lit_on_itself_and_dark_behind(needs_gl, name):
    """start == end: T = 1 in front and on it, exp(-tau) behind."""
    tau = 0.7
    side = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    sheet = po.Mesh(side, np.array([[0, 1, 2], [0, 2, 3]]), opacity=float(-np.expm1(-tau)))
    scene = po.Scene()
    scene.add(sheet)
    scene.add(po.DirectionalLight(direction=(0, 0, -1)))
    points = np.array([[0.1, 0.2, 1.0], [0.1, 0.2, 0.0], [0.1, 0.2, -1.0], [0.1, 0.2, -100.0]])
    with small(scene, name) as r:
        t = r.transmittance(points)
    assert t[:2].tolist() == [1.0, 1.0]
    assert t[2:] == pytest.approx([np.exp(-tau)] * 2, abs=1e-6)


@pytest.mark.parametrize("name", TRANSLUCENT)
def test_a_ladder_of_sheets_multiplies(needs_gl, name):
    """Between sheets, T is the product of those in front, to the layer's ramp."""
    count, tau = 8, 0.25
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    scene = po.Scene()
    for k in range(count):
        scene.add(
            po.Mesh(
                corners - [0, 0, k],
                np.array([[0, 1, 2], [0, 2, 3]]),
                opacity=float(-np.expm1(-tau)),
            )
        )
    scene.add(po.DirectionalLight(direction=(0, 0, -1)))
    points = np.stack([np.full(3, 0.1), np.full(3, 0.2), np.array([5.0, -3.5, -50.0])], 1)
    with small(scene, name) as r:
        t = r.transmittance(points)
    assert t[0] == 1.0
    assert t[1] == pytest.approx(np.exp(-4 * tau), abs=0.1)
    assert t[2] == pytest.approx(np.exp(-count * tau), abs=1e-6)  # each counted once


@pytest.mark.parametrize("name", CASTING)
@pytest.mark.parametrize("offset", [1e3, 1e5, 1e7])
def test_far_from_the_origin_nothing_changes(needs_gl, name, offset):
    points, offsets = tangle(9, strands=60)
    results = []
    for shift in (0.0, offset):
        strands = po.Strands(points + shift, offsets, width=0.2, opacity=0.3)
        scene = po.Scene()
        scene.add(strands)
        scene.add(po.DirectionalLight(direction=(0.5, 0.3, -0.8)))
        technique = po.technique(name, bias=0.2)
        with small(scene, technique) as r:
            results.append(r.transmittance(strands))
    assert np.abs(results[0] - results[1]).mean() < 1e-4


def test_a_transform_moves_the_shadow_as_moved_points_would(needs_gl):
    points, offsets = tangle(10, strands=60)
    a = np.radians(30)
    m = np.array(
        [
            [2 * np.cos(a), -2 * np.sin(a), 0, 5],
            [2 * np.sin(a), 2 * np.cos(a), 0, -3],
            [0, 0, 2, 1],
            [0, 0, 0, 1],
        ]
    )
    moved = po.Strands(points @ m[:3, :3].T + m[:3, 3], offsets, width=0.4, opacity=0.3)
    transformed = po.Strands(points, offsets, width=0.2, opacity=0.3)
    transformed.transform = m
    results = []
    for strands in (moved, transformed):
        scene = po.Scene()
        scene.add(strands)
        scene.add(po.DirectionalLight(direction=(0.5, 0.3, -0.8)))
        with small(scene, po.technique("exact", bias=0.2)) as r:
            results.append(r.transmittance(strands))
    assert np.abs(results[0] - results[1]).mean() < 1e-4
