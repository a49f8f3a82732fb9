"""Binary shadows: opaque scenes are right, and hair is as dark as the papers say."""

import numpy as np
import pytest

import pyopacity as po
from scenes import CASTING, hair_over_ball, random_shapes, tangle

LIGHT = (0.5, 0.3, -0.8)
DEVICES = pytest.mark.parametrize("device", ["gpu", "cpu"])

pytestmark = pytest.mark.usefixtures("needs_gl")


def answered(
    scene: po.Scene, points: np.ndarray | po.Shape, name: str, device: str = "cpu", **parameters
) -> np.ndarray:
    technique = po.technique(name, **parameters)
    with po.Renderer(scene, technique=technique, map_size=64, device=device) as renderer:
        return renderer.transmittance(points)


def points_in(reach: float) -> np.ndarray:
    return np.random.default_rng(2).uniform(-reach, reach, (5000, 3))


@DEVICES
def test_a_texel_is_dark_behind_the_first_caster_that_takes_any_light(device: str) -> None:
    for scene, reach in (
        (po.Scene(random_shapes(3), po.DirectionalLight(LIGHT)), 2.5),
        (hair_over_ball(), 8.0),
    ):
        points = points_in(reach)
        exact = answered(scene, points, "exact", device, filter="none")
        binary = answered(scene, points, "shadow_map", device, filter="none", splits=1)
        assert set(binary) == {0.0, 1.0}
        noticed = (exact == 1.0) | (exact < 1.0 - 1e-6)  # what float32 tells from 1
        assert np.mean(noticed) > 0.99
        assert (binary == (exact == 1.0))[noticed].mean() > 0.999


@DEVICES
@pytest.mark.parametrize("filter", ["none", "box", "pcf", "gaussian"])
def test_opaque_scenes_are_those_of_exact(device: str, filter: str) -> None:
    scene = po.Scene(hair_over_ball().shapes[1], po.DirectionalLight(LIGHT))
    points = points_in(4.0)
    binary = answered(scene, points, "shadow_map", device, filter=filter, splits=1)
    assert np.array_equal(binary, answered(scene, points, "exact", device, filter=filter))
    assert binary.min() == 0.0 and binary.max() == 1.0
    assert ((binary > 0.0) & (binary < 1.0)).any() == (filter != "none")


@DEVICES
def test_a_caster_casts_as_opaque_unless_it_is_invisible(device: str) -> None:
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    sheet = po.Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]]), opacity=0.01)
    scene = po.Scene(sheet, po.DirectionalLight((0, 0, -1)))
    points = np.array([[0.1, 0.2, 1.0], [0.1, 0.2, 0.0], [0.1, 0.2, -1.0]])
    assert answered(scene, points, "shadow_map", device).tolist() == [1.0, 1.0, 0.0]
    sheet.opacity = 0.0
    assert answered(scene, points, "shadow_map", device).tolist() == [1.0, 1.0, 1.0]


@DEVICES
def test_the_last_caster_of_all_casts_and_nothing_beyond_it(device: str) -> None:
    """Strands across the light at both ends of its depths: one at 0, one at 1."""
    points = np.array([[-9.0, -4, 5], [9, -4, 5], [-9, 4, -5], [9, 4, -5]])
    strands = po.Strands(points, np.array([0, 2, 4]), width=2.0, opacity=0.5)
    scene = po.Scene(strands, po.DirectionalLight((0, 0, -1)))
    below = np.array([[0.0, -4, -6], [0, 4, -6], [0, 0, -6], [0, 0, -600]])
    T = answered(scene, below, "shadow_map", device, bias=0.0)
    assert T.tolist() == [0.0, 0.0, 1.0, 1.0]


def test_hair_is_far_too_dark() -> None:
    points, offsets = tangle(3, strands=400, step=0.5)
    hair = po.Strands(points, offsets, width=0.05, opacity=0.5)
    scene = po.Scene(hair, po.DirectionalLight(LIGHT))
    truth = answered(scene, hair, "exact")
    binary, layers = (
        answered(scene, hair, "shadow_map"),
        answered(scene, hair, "bounding_opacity_maps"),
    )
    assert np.mean(binary - truth) < -0.2
    assert po.metrics.rmse(binary, truth) > 10.0 * po.metrics.rmse(layers, truth)


# ---- parallel splits ----


def plate(center: tuple[float, float, float], half: float, **looks: float) -> po.Mesh:
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    return po.Mesh(np.array(center) + half * corners, triangles, **looks)


def checker(opacity: float) -> po.Mesh:
    """Every second square of .25 of a board 6 x 6, .5 above the ground."""
    i, j = (k.ravel() for k in np.meshgrid(np.arange(24), np.arange(24)))
    black = (i + j) % 2 == 0
    low = np.stack([0.25 * i - 3.0, 0.25 * j - 3.0, np.full(i.size, 0.5)], 1)[black]
    square = 0.25 * np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
    first = 4 * np.arange(len(low))[:, None]
    triangles = np.concatenate([first + [0, 1, 2], first + [0, 2, 3]])
    return po.Mesh((low[:, None] + square).reshape(-1, 3), triangles, opacity=opacity)


def long_ground(*casters: po.Shape) -> po.Scene:
    """200 x 200 with a caster in each far corner, so that the light's map spans all of it."""
    ground = plate((0, 0, 0), 100)
    ground.casts = False
    corners = [plate((x, y, 3), 5) for x in (-95, 95) for y in (-95, 95)]
    return po.Scene([ground, *casters, *corners], po.DirectionalLight((0.2, 0.3, -1)))


CAMERA = po.Camera.look_at((0, -8, 3), (0, 0, 0))


def split_renderer(scene: po.Scene, device: str = "cpu", **parameters: float) -> po.Renderer:
    technique = po.technique("shadow_map", **parameters)
    return po.Renderer(scene, CAMERA, (160, 120), technique=technique, map_size=128, device=device)


def on_the_ground(reach: float, count: int = 4000) -> np.ndarray:
    points = np.random.default_rng(4).uniform(-reach, reach, (count, 3))
    points[:, 2] = 1e-3
    return points


@DEVICES
@pytest.mark.parametrize("opacity", [1.0, 0.999])
def test_splits_make_shadows_near_the_camera_finer(device: str, opacity: float) -> None:
    scene, points = long_ground(checker(opacity)), on_the_ground(1.5)
    truth = np.round(po.trace_transmittance(scene, points))
    errors = []
    for splits in (1, 4):
        with split_renderer(scene, device, splits=splits) as renderer:
            renderer.map_size = 256
            errors.append(po.metrics.rmse(renderer.transmittance(points), truth))
    assert errors[0] > 0.5  # a texel is three squares wide
    assert errors[1] < 0.5 * errors[0]


def test_both_devices_see_the_same_through_splits() -> None:
    points = np.random.default_rng(5).uniform(-3, 3, (20000, 3))
    scene = po.Scene(
        [*random_shapes(3), *long_ground(checker(0.5)).shapes], po.DirectionalLight(LIGHT)
    )
    T = []
    for device in ("gpu", "cpu"):
        with split_renderer(scene, device) as renderer:
            T.append(renderer.transmittance(points))
    assert np.mean(np.abs(T[0] - T[1]) > 1e-3) < 1e-3


@DEVICES
def test_no_gap_lies_between_two_splits(device: str) -> None:
    """Below a roof wider than several splits all is dark, beside it all is lit."""
    x, y = np.meshgrid(np.linspace(-12, 12, 49), np.linspace(-7, 60, 400))
    points = np.stack([x.ravel(), y.ravel(), np.full(x.size, 1e-3)], 1)
    with split_renderer(long_ground(plate((0, 20, 4), 45)), device) as renderer:
        assert np.all(renderer.transmittance(points) == 0.0)
        sides = 1.0 / renderer._engine.texel_sides(points, 0)
        assert len(np.unique(sides.round(6))) >= 4  # borders of splits lie among the points
    with split_renderer(long_ground(), device) as renderer:
        assert np.all(renderer.transmittance(points) == 1.0)


@DEVICES
def test_what_the_camera_does_not_see_still_casts(device: str) -> None:
    """A plate high above and behind the camera, between the light and what it sees."""
    with split_renderer(long_ground(plate((-8, -12, 40), 3)), device) as renderer:
        T = renderer.transmittance(np.array([[0.0, 0, 1e-3], [0, 6, 1e-3]]))
    assert T.tolist() == [0.0, 1.0]


def statuses(renderer: po.Renderer) -> dict[str, str]:
    return {row.name: row.status for row in renderer.report}


def test_a_camera_that_moves_by_less_than_a_texel_moves_no_shadow() -> None:
    points = on_the_ground(4.0)
    with split_renderer(long_ground(checker(1.0))) as renderer:
        first = renderer.transmittance(points)
        texel = renderer._engine.texel_sides(points[:1], 0)[0]
        renderer.camera = po.Camera.look_at((0.9 * texel, -8, 3), (0.9 * texel, 0, 0))
        assert np.array_equal(renderer.transmittance(points), first)
        assert statuses(renderer)["opaque_moved"] == "cached"
        # Farther on windows move by whole texels: only where another split answers T changes.
        for step in range(1, 40):
            eye = 0.9 * texel * step
            renderer.camera = po.Camera.look_at((eye, -8, 3), (eye, 0, 0))
            before, sides = first, renderer._engine.texel_sides(points, 0)
            first = renderer.transmittance(points)
            same = sides == renderer._engine.texel_sides(points, 0)
            assert np.array_equal(before[same], first[same])
            assert np.mean(same) > 0.3


@pytest.mark.parametrize("name", [*CASTING, "shadow_map, splits=1"])
def test_a_camera_that_moves_draws_no_map_that_is_not_split(name: str) -> None:
    name, _, one = name.partition(",")
    technique = po.technique(name, **({"splits": 1} if one else {}))
    scene, points = long_ground(checker(0.5)), on_the_ground(2.0, 100)
    with po.Renderer(scene, CAMERA, technique=technique, map_size=64, device="cpu") as renderer:
        first = renderer.transmittance(points)
        renderer.camera = po.Camera.look_at((30, -8, 3), (0, 60, 0))
        second = renderer.transmittance(points)
        ran = {row for row, status in statuses(renderer).items() if status == "ran"}
    if name == "shadow_map" and not one:
        assert ran == {"opaque_depth", "opaque_moved", "shadow_map/half_depth", "transmittance"}
    else:
        assert ran == set()
        assert np.array_equal(first, second)


@DEVICES
def test_one_split_is_the_whole_map_and_lies_beside_the_others_as_well(device: str) -> None:
    scene = po.Scene([*random_shapes(3), plate((0, 0, -2), 9)], po.DirectionalLight(LIGHT))
    maps = []
    for splits in (1, 4):
        with split_renderer(scene, device, splits=splits) as renderer:
            renderer.transmittance(points_in(2.0))
            maps.append(renderer.read("shadow_map/half_depth"))
    assert maps[0].shape == (128, 128) and maps[1].shape == (256, 384)
    # A rasteriser clips, and rounds by the size of all maps.
    rounding = 1e-6 if device == "gpu" else 0.0
    differs = np.abs(maps[1][:128, :128] - maps[0]) > rounding
    assert np.mean(differs) < 2e-3 if device == "gpu" else not differs.any()


@pytest.mark.parametrize(
    "light",
    [
        po.PointLight((3, 2, 20)),
        po.SpotLight((3, 2, 20), (-3, -2, -20), 60),
        po.AreaLight((3, 2, 20), (1, 0, 0), (0, 1, 0), 2),
    ],
    ids=["point", "spot", "area"],
)
def test_a_light_at_a_place_keeps_its_map(light: po.Light) -> None:
    scene = po.Scene([plate((0, 0, 0), 9), checker(0.5)], light)
    T = []
    for splits in (1, 4):
        with split_renderer(scene, splits=splits) as renderer:
            T.append(renderer.transmittance(on_the_ground(2.0)))
    assert np.array_equal(T[0], T[1]) and T[0].min() < T[0].max()
