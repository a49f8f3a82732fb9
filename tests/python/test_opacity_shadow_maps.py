"""Kim and Neumann 2001: what the paper claims, and what its options do."""

import time

import numpy as np
import pytest

import pyopacity as po
from layer_errors import LIGHT, Errors, hair, rmse
from scenes import random_shapes

OSM, DOM = "opacity_shadow_maps", "deep_opacity_maps"


@pytest.fixture(scope="module")
def errors() -> Errors:
    return Errors(*hair())


def sheets(*opacities: float) -> po.Scene:
    """One above the other, a unit apart, toward a light from above."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    meshes = [
        po.Mesh(corners - [0, 0, k], triangles, opacity=opacity)
        for k, opacity in enumerate(opacities)
    ]
    return po.Scene(meshes, po.DirectionalLight((0.0, 0.0, -1.0)))


def behind(scene: po.Scene, **parameters: object) -> float:
    technique = po.technique(OSM, **parameters)
    return float(po.transmittance(scene, np.array([[0.1, 0.2, -90.0]]), technique, 32)[0])


@pytest.mark.gl
def test_passes_grow_with_slices_and_hold_32() -> None:
    for layers, passes in ((1, 1), (32, 1), (33, 2), (500, 16)):
        scene = sheets(0.3, 0.4)
        slices = po.technique(OSM, layers=layers, deposit="blend")
        with po.Renderer(scene, map_size=8, technique=slices) as renderer:
            renderer.transmittance(scene.shapes[1])
            ran = [row.name for row in renderer.report if row.name.startswith(f"{OSM}/opacity")]
            assert len(ran) == passes
            assert renderer.read(f"{OSM}/opacity").shape == (-(-layers // 4), 8, 8, 4)


def test_five_hundred_slices_are_nearly_exact(errors: Errors) -> None:
    found = [rmse(errors.of(OSM, layers=layers)) for layers in (6, 32, 500)]
    assert found == sorted(found, reverse=True)
    assert found[2] < 0.02 < found[0]


def test_few_slices_err_most_where_light_enters(errors: Errors) -> None:
    """Plate 3: artefacts are visible at brighter regions, with a small number of maps only."""
    few, many = errors.of(OSM, layers=6), errors.of(OSM, layers=500)
    dark = errors.exact < 0.3
    assert rmse(few[errors.is_lit]) > 3 * rmse(few[dark])
    assert rmse(many[errors.is_lit]) < 0.2 * rmse(few[errors.is_lit])


def test_slices_show_as_bands(errors: Errors) -> None:
    """Dark stripes on the lit surface, one a slice; deep opacity maps have none."""
    assert errors.bands(8, OSM, layers=8) > 0.1
    assert abs(errors.bands(8, DOM, layers=8)) < 0.01


def test_the_farthest_map_shades_what_lies_behind() -> None:
    scene = sheets(0.3, 0.4, 0.5)
    for parameters in ({}, {"layers": 1}, {"layers": 77, "slicing": "density"}):
        assert behind(scene, **parameters) == pytest.approx(0.7 * 0.6 * 0.5, abs=1e-6)


def test_dense_slices_lie_where_light_is_lost() -> None:
    scene = po.Scene(po.load("demo:tree?leaves=2000"), po.DirectionalLight(LIGHT))
    tree = Errors(scene, scene.shapes[0], 96)
    assert rmse(tree.of(OSM, slicing="density")) < 0.9 * rmse(tree.of(OSM))


def test_gamma_1_is_uniform_and_more_moves_slices_to_the_light() -> None:
    points = np.array([[0.1, 0.2, -0.15], [0.1, 0.2, -0.9]])
    scene = sheets(0.5, 0.5)

    def at(**parameters: object) -> list[float]:
        technique = po.technique(OSM, layers=4, bias=0.0, **parameters)
        return po.transmittance(scene, points, technique, 32).tolist()

    assert at(slicing="gamma", gamma=1.0) == at()
    # The first sheet lies in the first slice, which gamma makes thin.
    assert at(slicing="gamma")[0] < at()[0]


def test_cubic_interpolation_is_smoother_and_never_rises() -> None:
    scene = po.Scene(po.load("demo:smoke?voxels=20000"), po.DirectionalLight(LIGHT))
    box = scene.bounds
    axis = np.array(LIGHT) / np.linalg.norm(LIGHT)
    starts = np.random.default_rng(1).uniform(*box, (60, 3)) - 3 * axis
    points = (starts[:, None] + np.linspace(0, 6, 200)[:, None] * axis).reshape(-1, 3)
    exact = po.transmittance(scene, points, "exact", 64)
    found = {}
    for interpolation in ("linear", "cubic"):
        technique = po.technique(OSM, interpolation=interpolation)
        T = po.transmittance(scene, points, technique, 64)
        assert (np.diff(T.reshape(60, 200), axis=1) <= 1e-6).all()
        found[interpolation] = rmse(T - exact)
    assert found["cubic"] < 0.9 * found["linear"]


def test_eight_bits_end_at_kappa_and_lose_what_is_small() -> None:
    """exp(-kappa) = 2^-8 for auto: what is darker cannot be told, and small things are lost."""
    eight = {"accumulator": "unorm8"}
    assert behind(sheets(0.99, 0.99, 0.99), **eight) == pytest.approx(2.0**-8, rel=1e-5)
    assert behind(sheets(0.99, 0.99, 0.99)) == pytest.approx(1e-6, rel=1e-2)
    step = 8 * np.log(2) / 255
    assert behind(sheets(-np.expm1(-0.45 * step)), **eight) == 1.0
    assert behind(sheets(-np.expm1(-0.55 * step)), **eight) == pytest.approx(np.exp(-step))
    assert behind(sheets(0.99, 0.99), kappa=2.0, **eight) == pytest.approx(np.exp(-2.0))


@pytest.mark.parametrize("accumulator", ["float16", "unorm8"])
def test_fewer_bits_change_little_on_both_devices(needs_gl: None, accumulator: str) -> None:
    scene, strands = hair(3000)
    technique = po.technique(OSM)
    with po.Renderer(scene, technique=technique, map_size=48) as renderer:
        full = renderer.transmittance(strands)
        technique.accumulator = accumulator
        on_gpu = renderer.transmittance(strands)
        values = renderer.read(f"{OSM}/opacity")
    on_cpu = po.transmittance(scene, strands, technique, 48)
    assert 0.0 < rmse(on_gpu - full) < 0.03
    # Drivers round sums of half floats each as they like.
    assert np.quantile(np.abs(on_gpu - on_cpu), 0.99) < (5e-3 if accumulator == "float16" else 1e-4)
    assert values.dtype == np.float32 and values.max() > 0.0
    assert accumulator == "float16" or values.max() <= 1.0


def test_the_box_of_the_paper_is_3_x_3() -> None:
    """A receiver in the middle of a texel sees nine, all alike."""
    scene = po.Scene(
        po.Particles(np.zeros((1, 3)), radius=0.02, opacity=0.9), po.DirectionalLight((0, 0, -1))
    )
    scene.add(po.Particles(np.array([[1.0, 1, -1], [-1, -1, -1]]), radius=0.02, opacity=0.9))
    technique = po.technique(OSM, filter_radius=1.5)
    x = np.linspace(-0.2, 0.2, 81)
    with po.Renderer(scene, device="cpu", technique=technique, map_size=34) as renderer:
        T = renderer.transmittance(np.stack([x, 0 * x, 0 * x - 5], 1))
        texel = 1 / np.linalg.norm(renderer.light_from_world[0, :3])
    dark = x[T < 1 - 1e-6]
    assert texel > 0.05
    assert np.ptp(dark) == pytest.approx(4 * texel, abs=texel)


# ---- two buffers: the pseudo code ----


LIGHTS = {
    "directional": lambda middle: po.DirectionalLight(LIGHT),
    "inside": po.PointLight,
    "area": lambda middle: po.AreaLight(middle + [0, 0, 6], (2, 0, 0), (0, 2, 0), samples=1),
}


@pytest.mark.parametrize("device", ["cpu", "gpu"])
@pytest.mark.parametrize("light", LIGHTS)
def test_two_buffers_answer_as_all_do(
    request: pytest.FixtureRequest, device: str, light: str
) -> None:
    """On every kind of caster; surfaces that lean lie in several slices at once."""
    if device == "gpu":
        request.getfixturevalue("needs_gl")
    shapes = random_shapes(3)
    scene = po.Scene(shapes, LIGHTS[light](np.zeros(3)))
    points = np.random.default_rng(1).uniform(-4, 4, (500, 3))
    options = [
        {"layers": 9, "interpolation": "cubic", "filter_radius": 2.5},
        {"layers": 13, "slicing": "gamma", "accumulator": "unorm8"},
    ]
    if device == "cpu":  # the same code: both kinds of light and of filter are enough
        options.append({"layers": 5, "filter_domain": "density"})
    for parameters in options:
        technique = po.technique(OSM, **parameters)
        with po.Renderer(scene, device=device, technique=technique, map_size=24) as renderer:
            for where in (*shapes, points):
                technique.buffers = "all"
                T = renderer.transmittance(where)
                technique.buffers = "two"
                swept = renderer.transmittance(where)
                assert np.abs(swept - T).max() < 2e-5 and swept.max() <= 1.0, parameters


def test_memory_of_two_buffers_does_not_grow() -> None:
    scene, strands = hair(600)
    for layers in (1, 16, 300):
        technique = po.technique(OSM, buffers="two", layers=layers)
        with po.Renderer(scene, device="cpu", technique=technique, map_size=24) as renderer:
            renderer.transmittance(strands)
            row = next(row for row in renderer.report if row.name == "transmittance")
            assert row.note.startswith(f"{layers} slices in turn")
            assert renderer.read(f"{OSM}/slices").shape == (24, 24, 4)
            with pytest.raises(po.ParameterError, match="no texture"):
                renderer.read(f"{OSM}/opacity")


@pytest.mark.parametrize("device", ["cpu", "gpu"])
@pytest.mark.parametrize("light", LIGHTS)
def test_a_cloud_behind_others_loads_what_is_stored_of_them(
    request: pytest.FixtureRequest, device: str, light: str
) -> None:
    """Section 4 of the paper. One shape that holds them all is drawn for every slice."""
    if device == "gpu":
        request.getfixturevalue("needs_gl")
    random = np.random.default_rng(2)
    clouds = [random.normal((0, 0, 3 * k), 0.3, (40, 3)) for k in range(-4, 5)]
    points = np.concatenate(clouds) + random.normal(0, 0.2, (360, 3))
    toward = LIGHTS[light](np.array([0.0, 0.0, 1.0]))
    technique = po.technique(OSM, buffers="two", layers=40)
    found, notes = [], []
    for groups in (clouds, [np.concatenate(clouds)]):
        scene = po.Scene([po.Particles(c, radius=0.2, opacity=0.6) for c in groups], toward)
        with po.Renderer(scene, device=device, technique=technique, map_size=24) as renderer:
            found.append(renderer.transmittance(points))
            notes.append(next(r.note for r in renderer.report if r.name == "transmittance"))
    assert np.abs(found[0] - found[1]).max() < 5e-6  # each cloud has an origin of its own
    assert found[0].min() < 0.5 < found[0].max()
    drawn, every = (int(word) for word in notes[0].split() if word.isdigit() and int(word) > 40)
    assert all(note.startswith("40 slices in turn") for note in notes) and every == 9 * 40
    assert drawn < (0.3 if light == "directional" else 0.6) * every


def test_pictures_keep_all_slices(needs_gl: None) -> None:
    scene, _ = hair(600)
    images = []
    for buffers in ("all", "two"):
        technique = po.technique(OSM, buffers=buffers)
        with po.Renderer(scene, size=(32, 24), technique=technique, map_size=24) as renderer:
            images.append(renderer.render())
    assert (images[0] == images[1]).all()


def test_without_casters_two_buffers_let_all_light_through() -> None:
    scene = po.Scene(po.DirectionalLight(LIGHT))
    T = po.transmittance(scene, np.zeros((3, 3)), po.technique(OSM, buffers="two"))
    assert T.tolist() == [1.0] * 3


@pytest.mark.slow
def test_time_is_linear_in_slices(needs_gl: None) -> None:
    """Figure 4."""
    scene, strands = hair()
    seconds: dict[int, list[float]] = {128: [], 512: []}
    with po.Renderer(scene, technique=OSM, map_size=128) as renderer:
        for _ in range(5):  # in turns: what else the machine does slows both
            for layers, taken in seconds.items():
                renderer.technique.layers = layers
                renderer.invalidate()
                start = time.perf_counter()
                renderer.transmittance(strands)
                taken.append(time.perf_counter() - start)
    assert 2.0 < min(seconds[512][1:]) / min(seconds[128][1:]) < 6.0
