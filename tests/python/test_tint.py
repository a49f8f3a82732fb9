"""Opacity and extinction a colour: three scenes in one, whatever they go through."""

import pathlib
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po
from pyopacity.cli import main

Tinted = Callable[[object], po.Scene]

RGB = (0.15, 0.4, 0.8)
CHANNELS = ("red", "green", "blue")


def hair(opacity: object) -> po.Scene:
    """Strands that cross at random."""
    random = np.random.default_rng(4)
    points = random.uniform(-1.0, 1.0, (400, 3))
    strands = po.Strands(points, np.arange(0, 401, 4), width=0.05, opacity=opacity)  # type: ignore[arg-type]
    return po.Scene(strands, po.DirectionalLight((0.3, 0.2, -1.0)))


def smoke(extinction: object) -> po.Scene:
    """A cloud of voxels; `extinction` times a density."""
    random = np.random.default_rng(5)
    density = random.uniform(0.0, 2.0, (6, 7, 8))
    values = density if np.ndim(extinction) == 0 else density[..., None]
    volume = po.Volume(values * np.asarray(extinction), spacing=0.3)
    return po.Scene(volume, po.DirectionalLight((0.3, 0.2, -1.0)))


def puffs(opacity: object) -> po.Scene:
    """Particles above an opaque floor, under two lights."""
    random = np.random.default_rng(6)
    particles = po.Particles(random.uniform(-1, 1, (60, 3)), radius=0.3, opacity=opacity)  # type: ignore[arg-type]
    corners = np.array([[-2, -2, -1.5], [2, -2, -1.5], [2, 2, -1.5], [-2, 2, -1.5]], np.float64)
    floor = po.Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]))
    lights = po.DirectionalLight((0.3, 0.2, -1.0)), po.PointLight((0.5, 1.0, 4.0))
    return po.Scene(particles, floor, *lights)


def alone(make: Tinted, channel: int) -> po.Scene:
    return make(RGB[channel])


def points_in(scene: po.Scene) -> npt.NDArray[np.float64]:
    low, high = scene.bounds.min, scene.bounds.max
    return np.random.default_rng(7).uniform(low, high, (500, 3))


SCENES = pytest.mark.parametrize("make", [hair, smoke, puffs])


@SCENES
@pytest.mark.parametrize(
    "technique",
    ["fourier_opacity_maps", "bounding_opacity_maps", "moment_opacity_maps", "opacity_shadow_maps"],
)
@pytest.mark.parametrize("device", ["cpu", "gpu"])
def test_channels_equal_three_scalar_runs(make: Tinted, technique: str, device: str) -> None:
    """Red, green and blue of a tinted scene, bit for bit, also at its own points."""
    tinted = make(RGB)
    points = points_in(tinted)
    settings = {"technique": technique, "device": device, "map_size": 64}
    with po.Renderer(tinted, **settings) as renderer:  # type: ignore[arg-type]
        at_points = renderer.transmittance(points)
        on_shape = renderer.transmittance(tinted.shapes[0])
    assert at_points.shape == (len(points), 3)
    for c in range(3):
        scene = alone(make, c)
        with po.Renderer(scene, **settings) as renderer:  # type: ignore[arg-type]
            np.testing.assert_array_equal(at_points[:, c], renderer.transmittance(points))
            np.testing.assert_array_equal(on_shape[:, c], renderer.transmittance(scene.shapes[0]))
    assert at_points[:, 0].mean() > at_points[:, 1].mean() > at_points[:, 2].mean()


@SCENES
def test_rays_have_channels_too(make: Tinted) -> None:
    tinted = make(RGB)
    traced = po.trace_transmittance(tinted, tinted.shapes[0])
    assert traced.shape[1:] == (3,)
    for c in range(3):
        scene = alone(make, c)
        np.testing.assert_array_equal(traced[:, c], po.trace_transmittance(scene, scene.shapes[0]))


@SCENES
def test_a_picture_has_the_channels_of_three(make: Tinted) -> None:
    """Linear RGB of the three scalar pictures, and the mean of their alphas."""
    tinted = make(RGB)
    camera = po.Camera.fit(tinted)
    settings = {"camera": camera, "size": (48, 40), "map_size": 64, "background": (0.1, 0.2, 0.3)}
    with po.Renderer(tinted, **settings) as renderer:  # type: ignore[arg-type]
        picture = renderer.render()
        T = renderer.image("transmittance")
        assert renderer.image("depth").shape == (40, 48)
    alphas = []
    for c in range(3):
        with po.Renderer(alone(make, c), **settings) as renderer:  # type: ignore[arg-type]
            scalar = renderer.render()
            np.testing.assert_array_equal(picture[..., c], scalar[..., c])
            np.testing.assert_array_equal(T[..., c], renderer.image("transmittance"))
            alphas.append(scalar[..., 3])
    np.testing.assert_allclose(picture[..., 3], np.mean(alphas, axis=0), atol=1e-6)


def test_beer_lambert_by_colour() -> None:
    """A slab of even extinction: exp(-extinction x length) in each colour, by maps and by rays."""
    extinction = np.array([0.1, 0.5, 2.0])
    slab = po.Volume(np.broadcast_to(extinction, (4, 8, 8, 3)).copy(), spacing=0.5)
    scene = po.Scene(slab, po.DirectionalLight((0.0, 0.0, -1.0)))
    below = np.array([[1.6, 1.7, -1.0]])
    right = np.exp(-extinction * 4 * 0.5)[None]
    np.testing.assert_allclose(po.trace_transmittance(scene, below), right, rtol=1e-6)
    np.testing.assert_allclose(po.transmittance(scene, below, map_size=64), right, rtol=1e-4)


def test_one_channel_alone_is_opaque() -> None:
    """Opacity 1 in one colour stops that one, and opacity 0 lets all of it pass."""
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float64)
    glass = po.Mesh(square, np.array([[0, 1, 2], [0, 2, 3]]), opacity=(1.0, 0.5, 0.0))
    scene = po.Scene(glass, po.DirectionalLight((0.0, 0.0, -1.0)))
    T = po.transmittance(scene, np.array([[0.1, 0.2, -1.0]]))
    np.testing.assert_allclose(T, [[0.0, 0.5, 1.0]], atol=1e-6)


@pytest.mark.parametrize(
    ("opacity", "kept"),
    [
        (0.3, 0.3),
        ((0.1, 0.2, 0.3), (0.1, 0.2, 0.3)),
        (np.array([0.1, 0.2, 0.3]), (0.1, 0.2, 0.3)),
        (np.array([[0.1, 0.2, 0.3]]), (0.1, 0.2, 0.3)),
    ],
)
def test_what_opacity_takes(opacity: object, kept: object) -> None:
    strands = po.Strands(np.zeros((4, 3)), np.array([0, 4]), opacity=opacity)  # type: ignore[arg-type]
    assert strands.opacity == kept
    assert strands.instance().opacity == kept


def test_an_array_of_three_is_one_a_point_of_three() -> None:
    triangle = po.Mesh(np.eye(3), np.array([[0, 1, 2]]), opacity=np.array([0.1, 0.2, 0.3]))
    assert not po.Scene(triangle).is_tinted
    triangle.opacity = (0.1, 0.2, 0.3)
    assert po.Scene(triangle).is_tinted
    per_point = np.random.default_rng(0).uniform(size=(3, 3)).astype(np.float32)
    triangle.opacity = per_point
    np.testing.assert_array_equal(triangle.opacity, per_point)
    triangle.opacity = 0.5
    assert triangle.opacity == 0.5
    assert not po.Scene(triangle).is_tinted


@pytest.mark.parametrize(
    ("opacity", "words"),
    [
        ((0.1, 1.5, 0.2), "opacity"),
        ((0.1, float("nan"), 0.2), "opacity"),
        (np.full((3, 3), 0.1), "3 entries for 4 points"),
        (np.full((4, 2), 0.1), "shape (N, 3)"),
        ((0.1, 0.2), "2 numbers"),
        ("grey", "a number, three"),
    ],
)
def test_bad_opacity_is_told(opacity: object, words: str) -> None:
    with pytest.raises(po.ParameterError) as error:
        po.Strands(np.zeros((4, 3)), np.array([0, 4]), opacity=opacity)  # type: ignore[arg-type]
    assert words in str(error.value)


def test_bad_extinction_is_told() -> None:
    for extinction in (np.full((2, 2, 2, 2), 0.1), np.full((2, 2, 2, 3), -1.0)):
        with pytest.raises(po.ParameterError, match="extinction"):
            po.Volume(extinction)
    volume = po.Volume(np.full((2, 2, 2, 3), 0.5))
    with pytest.raises(po.ParameterError, match="extinction"):
        volume.extinction = np.full((2, 2, 3, 3), 0.5)
    np.testing.assert_array_equal(volume.extinction, np.full((2, 2, 2, 3), np.float32(0.5)))
    volume.spacing = 2.0
    np.testing.assert_array_equal(volume.extinction, np.full((2, 2, 2, 3), np.float32(0.5)))


def status(renderer: po.Renderer) -> dict[str, str]:
    return {row.name: row.status for row in renderer.report}


def test_what_has_not_changed_is_cached_in_every_channel() -> None:
    """A colour moves no map; an opacity moves maps, but no bounds; a grid moves everything."""
    scene = hair(RGB)
    (strands,) = scene.shapes
    assert isinstance(strands, po.Strands)
    with po.Renderer(scene, size=(32, 24), map_size=32) as renderer:
        first = renderer.render()
        names = status(renderer)
        assert {name.partition("/")[0] for name in names} == set(CHANNELS)
        assert np.array_equal(first, renderer.render())
        assert "ran" not in status(renderer).values()
        strands.color = (0.9, 0.1, 0.2)
        renderer.render()
        ran = {name for name, state in status(renderer).items() if state == "ran"}
        assert ran
        assert not any("opacity_maps" in name for name in ran)
        strands.opacity = (0.2, 0.3, 0.4)
        renderer.render()
        moved = status(renderer)
        for channel in CHANNELS:
            prefix = f"{channel}/bounding_opacity_maps/"
            assert moved[prefix + "bounds"] == "cached"
            assert moved[prefix + "opacity"] == "ran"
        strands.opacity = 0.3
        assert renderer.transmittance(strands).ndim == 1
        assert not any(name.startswith("red/") for name in status(renderer))


def scaled(values: object, factors: tuple[float, float, float]) -> npt.NDArray[np.float32]:
    return np.asarray(values, np.float32) * np.asarray(factors, np.float32)


@pytest.mark.parametrize("device", ["gpu", "cpu"])
@pytest.mark.parametrize("make, part", [(hair, "opacity"), (smoke, "extinction")])
def test_a_colour_that_stays_keeps_its_maps(make: Tinted, part: str, device: str) -> None:
    """Of three colours the one that moves is done anew: T and the picture are as from nothing."""
    scene = make(RGB)
    points = points_in(scene)
    with po.Renderer(scene, size=(32, 24), map_size=32, device=device) as renderer:
        asked: list[Callable[[], npt.NDArray[np.float32]]] = [
            lambda: renderer.transmittance(points)
        ]
        if device == "gpu":
            asked.append(renderer.render)
        (shape,) = scene.shapes
        for answer in asked:
            answer()
            setattr(shape, part, scaled(getattr(shape, part), (1.0, 0.5, 1.0)))
            kept = answer()
            states = status(renderer).items()
            ran = {name.partition("/")[0] for name, state in states if state == "ran"}
            renderer.invalidate()
            assert ran == {"green"}
            np.testing.assert_array_equal(kept, answer())


def test_a_tinted_volume_follows_its_grid() -> None:
    """The extinction of a channel stands for the grid as well."""
    scene, moved = smoke(RGB), smoke(RGB)
    points = points_in(scene)
    with po.Renderer(scene, map_size=32, steady=False) as renderer:
        before = renderer.transmittance(points)
        scene.shapes[0].spacing = 0.2  # type: ignore[attr-defined]
        after = renderer.transmittance(points)
    moved.shapes[0].spacing = 0.2  # type: ignore[attr-defined]
    with po.Renderer(moved, map_size=32, steady=False) as renderer:
        np.testing.assert_array_equal(after, renderer.transmittance(points))
    assert not np.array_equal(before, after)


def test_a_traced_picture_is_tinted() -> None:
    """Within noise of the maps' own picture; the channels of three scalar ones."""
    tinted = hair(RGB)
    camera = po.Camera.fit(tinted)
    picture = po.traced_picture(tinted, camera, size=(32, 24), samples=2)
    for c in range(3):
        scalar = po.traced_picture(alone(hair, c), camera, size=(32, 24), samples=2)
        np.testing.assert_allclose(picture[..., c], scalar[..., c], atol=1e-6)


def test_the_command_line_takes_colours(tmp_path: pathlib.Path, capsys: Any) -> None:
    """As many pixels differ by colour as lie in the shadow; four numbers are an error."""
    out = tmp_path / "tinted.npy"
    options = ["demo:hair?segments=4000", "--size", "48x36", "--map-size", "64", "-o", str(out)]
    assert main(["render", *options, "--opacity", ".1,.4,.8"]) == 0
    tinted = np.load(out)
    assert main(["render", *options, "--opacity", ".1"]) == 0
    red = np.load(out)
    np.testing.assert_array_equal(tinted[..., 0], red[..., 0])
    assert (tinted[..., 2] < red[..., 2]).any()
    assert main(["render", *options, "--opacity", ".1,.2,.3,.4"]) == 2
    assert "one number, or R,G,B" in capsys.readouterr().err
