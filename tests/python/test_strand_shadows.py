"""T along strands, looked up once for all cameras, against T of every sample."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po

LIGHT = po.DirectionalLight((0.5, 0.3, -0.8))


def hair() -> po.Scene:
    """A head of hair, which also shadows a bust and a ground."""
    return po.Scene(po.load("demo:hair?segments=6000"), po.DirectionalLight((0.5, 0.3, -0.8)))


def renderer(scene: po.Scene, way: str, **settings: Any) -> po.Renderer:
    settings = {"size": (160, 120), "map_size": 64, "camera": po.Camera.fit(scene)} | settings
    return po.Renderer(scene, strand_look_up=way, **settings)


def ran(r: po.Renderer) -> set[str]:
    return {row.name for row in r.report if row.status == "ran"}


def strand_passes(r: po.Renderer) -> dict[str, str]:
    return {row.name: row.status for row in r.report if row.name.endswith("strand_shadows")}


@pytest.mark.parametrize(
    ("technique", "compositing"),
    [
        ("bounding_opacity_maps", "opaque"),
        ("exact", "subsets"),
        ("deep_opacity_maps", "sorted"),
        ("opacity_shadow_maps", "exact"),
        ("fourier_opacity_maps", "maps"),
    ],
)
def test_pictures_are_those_of_every_sample(technique: str, compositing: str) -> None:
    """Whatever the technique, and however strands cover what lies behind them."""
    scene = hair()
    settings = {"technique": technique, "compositing": compositing}
    with renderer(scene, "along_strands", **settings) as along:
        picture = along.render()
        assert strand_passes(along)
    with renderer(scene, "per_sample", **settings) as each:
        other = each.render()
        assert not strand_passes(each)
    np.testing.assert_array_equal(picture[..., 3], other[..., 3])
    assert not np.array_equal(picture, other)
    assert po.metrics.rmse(picture, other) < 0.004
    assert abs(po.metrics.bias(picture, other)) < 0.001


@pytest.mark.parametrize(
    "light",
    [
        LIGHT,
        po.PointLight((2.0, -1.0, 9.0)),
        po.SpotLight((0.0, 0.0, 9.0), (0.0, 0.0, -1.0), 60.0),
    ],
)
def test_it_is_t_of_the_strand(light: po.Light) -> None:
    """A strand across a slab of even extinction: T falls by Beer and Lambert, at every pixel."""
    low, high, extinction = -1.0, 1.0, 0.8
    slab = po.Volume(np.full((20, 4, 4), extinction), origin=(-3, -3, -0.95), spacing=(2, 2, 0.1))
    along = np.linspace(1.2, -1.2, 4)
    points = np.stack([0.2 * along, 0.1 * along, along], axis=1)
    strand = po.Strands(points, np.array([0, 4]), width=0.05, opacity=0.0)
    slab.receives = False
    scene = po.Scene(strand, slab, light)
    camera = po.Camera.look_at((0.0, -6.0, 0.0), (0.0, 0.0, 0.0))
    settings = {"camera": camera, "size": (64, 64), "map_size": 128, "antialiasing": 1}
    with renderer(
        scene, "along_strands", technique=po.technique("exact", bias=0.0), **settings
    ) as r:
        T, ids = r.image("transmittance"), r.image("object_id")
        at = r.receivers().points
    on_strand = ids == 0
    assert on_strand.sum() > 20
    here = at[on_strand]
    right = exact_slab(light, here, low, high, extinction)
    np.testing.assert_allclose(T[on_strand], right, atol=0.02)


def exact_slab(
    light: po.Light, points: npt.NDArray[np.float64], low: float, high: float, extinction: float
) -> npt.NDArray[np.float64]:
    """exp(-extinction x length) of the ray to the light between two heights."""
    toward = -np.array(LIGHT.direction) * np.ones_like(points)
    if isinstance(light, po.PointLight | po.SpotLight):
        toward = np.array(light.position) - points
    slope = np.linalg.norm(toward, axis=1) / toward[:, 2]
    length = np.clip(high - np.maximum(points[:, 2], low), 0.0, None) * slope
    transmittance: npt.NDArray[np.float64] = np.exp(-extinction * length)
    return transmittance


def test_only_what_moves_t_runs_it_again() -> None:
    """Neither a camera nor a colour does; light, points and opacity do."""
    scene = hair()
    strands = scene.shapes[0]
    assert isinstance(strands, po.Strands)
    with renderer(scene, "along_strands", compositing="opaque") as r:
        r.render()
        assert "solid/strand_shadows" in ran(r)
        r.camera = po.Camera.fit(scene, direction=(1.0, 0.2, -0.1))
        r.render()
        assert ran(r) == {"lighting"}
        strands.color = (0.2, 0.3, 0.9)
        r.render()
        assert ran(r) == {"lighting"}
        for move in (
            lambda: setattr(strands, "opacity", 0.2),
            lambda: setattr(strands, "points", strands.points * np.float32(1.01)),
            lambda: setattr(scene.lights[0], "direction", (0.1, 0.4, -0.9)),
        ):
            move()
            moved = r.render()
            assert "solid/strand_shadows" in ran(r)
            r.invalidate()
            np.testing.assert_array_equal(moved, r.render())


def test_auto_goes_by_places_and_samples() -> None:
    """Along the strands up to three places for each sample of a picture that shows them blended."""
    scene = hair()
    settings = {"camera": po.Camera.fit(po.Scene(scene.shapes[0].instance()))}
    with (
        renderer(scene, "auto", size=(400, 300), **settings) as large,
        renderer(scene, "auto", size=(100, 75), **settings) as small,
    ):
        large.render()
        small.render()
        assert "blended/strand_shadows" in ran(large)
        assert not strand_passes(small)
        (note,) = {row.note for row in large.report if row.name == "blended/strand_shadows"}
        assert 6000 <= int(note.split()[0]) <= 3 * 400 * 300 * 4


def test_nothing_runs_where_nothing_is_looked_up() -> None:
    """Not without shadows, light, or strands that receive them."""
    scene = hair()
    with renderer(scene, "along_strands", technique="unshadowed") as r:
        r.render()
        assert not strand_passes(r)
    for shape in scene.shapes:
        shape.receives = not isinstance(shape, po.Strands)
    with renderer(scene, "along_strands") as r:
        r.render()
        assert not strand_passes(r)


def test_strands_of_one_point_and_of_no_length() -> None:
    """They have no segment, or one without extent: neither harms the others."""
    points = np.array([[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 1], [1, 0, 1]], np.float64)
    strands = po.Strands(points, np.array([0, 1, 3, 5]), width=0.1)
    scene = po.Scene(strands, LIGHT)
    with renderer(scene, "along_strands") as r:
        assert np.isfinite(r.render()).all()
        assert r.image("transmittance").min() >= 0.0


def test_too_many_places_are_told() -> None:
    """A buffer has an end; auto looks T up per sample there."""
    points = np.random.default_rng(0).uniform(-1, 1, (600_000, 3))
    strands = po.Strands(points, np.array([0, 600_000]), width=1e-3)
    scene = po.Scene(strands, LIGHT)
    with (
        renderer(scene, "along_strands", map_size=1024) as r,
        pytest.raises(po.ParameterError) as error,
    ):
        r.render()
    assert "along_strands" in str(error.value)
    assert "auto" in str(error.value)
