"""The maps in C++: the same conventions as the shaders, and no OpenGL at all."""

import concurrent.futures
import json
import pathlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pyopacity as po
from scenes import hair_over_ball, tangle

LIGHT = (0.5, 0.3, -0.8)
TECHNIQUES: list[tuple[str, dict[str, Any]]] = [
    ("exact", {}),
    ("bounding_opacity_maps", {}),
    ("bounding_opacity_maps", {"layers": 1}),
    ("bounding_opacity_maps", {"layers": 40, "split": "linear"}),
    ("bounding_opacity_maps", {"split": "logarithmic", "own_correction": False}),
    ("bounding_opacity_maps", {"deposit_rule": "paper", "bias": 0.3}),
    ("bounding_opacity_maps", {"search_frames": 11, "similarity": "correlation"}),
    ("opacity_shadow_maps", {}),
    ("opacity_shadow_maps", {"layers": 100, "slicing": "density"}),
    ("opacity_shadow_maps", {"slicing": "gamma", "interpolation": "cubic"}),
    ("deep_opacity_maps", {}),
    ("deep_opacity_maps", {"layers": 3, "beyond": "ignore", "layer_extent": 20.0}),
    ("deep_opacity_maps", {"layers": 7, "beyond": "extend", "layer_sizes": "constant"}),
    ("deep_opacity_maps", {"layers": 37, "packing": "4n-1", "depth_bits": 16}),
    ("deep_opacity_maps", {"layers": 6, "packing": "4n-1", "smoothing": 2}),
    ("density_clustering", {}),
    ("density_clustering", {"clusters": 1, "iterations": 0}),
    ("density_clustering", {"clusters": 13, "iterations": 2}),
    ("fourier_opacity_maps", {}),
    ("fourier_opacity_maps", {"coefficients": 63, "window": "lanczos", "filter_radius": 1.2}),
    ("fourier_opacity_maps", {"basis": "legendre", "bounds": "per_texel"}),
    ("fourier_opacity_maps", {"basis": "cosine", "coefficients": 8, "own_correction": False}),
    ("fourier_opacity_maps", {"basis": "piecewise_constant", "margin": 0.1}),
    ("fourier_opacity_maps", {"prefilter": "gaussian", "prefilter_radius": 3}),
    ("fourier_opacity_maps", {"prefilter": "mip-chain", "prefilter_radius": 2}),
    ("unshadowed", {}),
]


def tufts() -> po.Scene:
    """Strands of every width, opaque to the light and not, under a transform; no surface."""
    points, offsets = tangle(3, strands=150)
    rng = np.random.default_rng(4)
    widths = rng.uniform(0.01, 0.8, len(points))
    opacities = rng.uniform(0.0, 1.0, len(points))
    thick = po.Strands(points, offsets, width=widths, opacity=opacities)
    thin = po.Strands(points.astype(np.float32) * 0.5, offsets, width=0.05, opacity=0.9)
    thin.transform = np.array([[0, -1, 0, 2.0], [1, 0, 0, 0], [0, 0, 2, -1], [0, 0, 0, 1]])
    return po.Scene([thick, thin], po.DirectionalLight(LIGHT))


def on_both(
    scene: po.Scene, technique: po.Technique, ask: Callable[[po.Renderer], Any], **settings: Any
) -> tuple[Any, Any]:
    with (
        po.Renderer(scene, technique=technique, **settings) as gpu,
        po.Renderer(scene, technique=technique, device="cpu", **settings) as cpu,
    ):
        return ask(gpu), ask(cpu)


@pytest.mark.parametrize(("name", "parameters"), TECHNIQUES)
@pytest.mark.parametrize("map_size", [3, 150])
def test_agrees_with_the_gpu(
    needs_gl: None, name: str, parameters: dict[str, Any], map_size: int
) -> None:
    scene = tufts()
    rng = np.random.default_rng(5)
    points = rng.uniform(-12, 12, (2000, 3))
    technique = po.technique(name, **parameters)
    for where in (scene.shapes[0], scene.shapes[1], points):
        gpu, cpu = on_both(
            scene, technique, lambda r, w=where: r.transmittance(w), map_size=map_size
        )
        assert np.abs(gpu - cpu).max() < 1e-4
    assert gpu.min() < 0.7 or name == "unshadowed"


@pytest.mark.parametrize("filter", ["none", "box", "bartlett", "gaussian", "pcf"])
@pytest.mark.parametrize("domain", ["transmittance", "density"])
def test_filters_agree_with_the_gpu(needs_gl: None, filter: str, domain: str) -> None:
    scene = tufts()
    for extent in ({"filter_radius": 0.5}, {"filter_radius": 2.3}, {"filter_width": 1.1}):
        technique = po.technique(
            "bounding_opacity_maps", filter=filter, filter_domain=domain, **extent
        )
        gpu, cpu = on_both(
            scene, technique, lambda r: r.transmittance(scene.shapes[0]), map_size=96
        )
        assert np.abs(gpu - cpu).max() < 1e-4


@pytest.mark.parametrize("name", ["exact", "bounding_opacity_maps"])
def test_surfaces_agree_with_the_gpu_but_at_their_edges(needs_gl: None, name: str) -> None:
    """Within 1/256 of a texel of an edge rasterisers may differ, and with them whole texels."""
    scene = hair_over_ball()
    scene.add(po.Mesh(*sheet_at(4.0), opacity=np.array([0.2, 0.4, 0.6, 0.8], np.float32)))
    points = np.random.default_rng(6).uniform(-8, 8, (4000, 3))
    for where in (*scene.shapes, points):
        gpu, cpu = on_both(
            scene, po.technique(name), lambda r, w=where: r.transmittance(w), map_size=128
        )
        assert np.quantile(np.abs(gpu - cpu), 0.98) < 1e-4
        assert np.abs(gpu - cpu).mean() < 2e-3


def sheet_at(height: float) -> tuple[Any, Any]:
    corners = [(-7, -6.5, height), (6.9, -6, height + 1), (7, 7, height + 1.5), (-6, 6.6, height)]
    return np.array(corners), np.array([[0, 1, 2], [0, 2, 3]])


def test_every_texture_agrees_with_the_gpu(needs_gl: None) -> None:
    scene = tufts()
    technique = po.technique("bounding_opacity_maps", layers=8, deposit="blend")

    def textures(renderer: po.Renderer) -> list[Any]:
        renderer.transmittance(scene.shapes[0])
        names = ("start", "end", "opacity")
        return [renderer.read(f"bounding_opacity_maps/{name}") for name in names]

    gpu, cpu = on_both(scene, technique, textures, map_size=64)
    for of_gpu, of_cpu in zip(gpu, cpu, strict=True):
        assert of_gpu.shape == of_cpu.shape
        assert np.abs(of_gpu - of_cpu).max() < 1e-4


# ---- without OpenGL ----

WITHOUT_OPENGL = """
import json, numpy as np, pyopacity as po
scene = po.Scene(po.load("demo:hair?segments=900"), po.DirectionalLight((.5, .3, -.8)))
hair = scene.shapes[0]
T = po.transmittance(scene, hair, technique="exact", map_size=64)
points = np.asarray(hair.points)
with po.Renderer(scene, device="cpu", map_size=64) as renderer:
    first = renderer.transmittance(hair)
    same = renderer.transmittance(hair)
    report = [(row.name, row.status) for row in renderer.report]
    errors = []
    for ask in (renderer.render, renderer.receivers, lambda: renderer.context):
        try:
            ask()
        except po.ContextError as error:
            errors.append(error.fix)
try:
    po.Renderer(scene)
    gpu = "there is one"
except po.ContextError:
    gpu = "none"
print(json.dumps([len(points), T.shape, float(T.min()), float(T.max()),
                  bool((first == same).all()), report, errors, gpu, repr(renderer)]))
"""


def test_needs_no_opengl(python: Callable[..., Any], tmp_path: pathlib.Path) -> None:
    result = python("-c", WITHOUT_OPENGL, OPACITY_LIBEGL="/nope")
    assert (result.returncode, result.stderr) == (0, "")
    count, shape, low, high, same, report, errors, gpu, text = json.loads(result.stdout)
    assert gpu == "none"
    assert shape == [count] and 0.0 <= low < 0.5 < high == 1.0
    assert same
    status = dict(report)
    assert status["transmittance"] == "cached"
    for_pictures = ("lighting", "receivers", "first_surface", "strand_shadows")
    names = [name for name in status if name.rpartition("/")[2] in for_pictures]
    assert len(names) >= 3 and {status.pop(name) for name in names} == {"culled"}
    assert set(status.values()) == {"cached"} and "bounding_opacity_maps/opacity" in status
    assert len(errors) == 3 and all('device="gpu"' in fix for fix in errors)
    assert text == "<Renderer: closed>"


def test_runs_what_has_moved_and_no_more() -> None:
    scene = tufts()
    with po.Renderer(scene, device="cpu", map_size=64) as renderer:

        def ran() -> set[str]:
            renderer.transmittance(scene.shapes[0])
            return {r.name.rpartition("/")[2] for r in renderer.report if r.status == "ran"}

        everything = ran()
        assert {"bounds", "split_search", "opacity"} < everything
        assert ran() == set()
        scene.shapes[0].color = (1.0, 0.0, 0.0)
        assert ran() == set()
        scene.shapes[0].opacity = 0.2
        changed = ran()
        assert "opacity" in changed and "bounds" not in changed
        kept = renderer.transmittance(scene.shapes[0])
        renderer.invalidate()
        assert (renderer.transmittance(scene.shapes[0]) == kept).all()  # skipped equals forced


def test_points_that_changed_in_place_are_asked_anew() -> None:
    scene = tufts()
    points = np.random.default_rng(7).uniform(-9, 9, (300, 3))
    with po.Renderer(scene, device="cpu", map_size=64) as renderer:
        renderer.transmittance(points)
        points[17] += 1.0
        moved = renderer.transmittance(points)
        assert statuses(renderer)["transmittance"] == "ran"
        renderer.transmittance(points.copy())
        assert statuses(renderer)["transmittance"] == "cached"
    assert (moved == po.transmittance(scene, points, map_size=64)).all()


def test_a_shape_is_asked_anew_where_its_answer_may_differ() -> None:
    scene = tufts()
    thick, thin = scene.shapes
    changes: list[Callable[[], Any]] = [
        lambda: setattr(thick, "opacity", 0.4),
        lambda: setattr(thick, "width", 0.3),
        lambda: setattr(thick, "points", thick.points * 0.9),
        lambda: setattr(thick, "transform", np.diag([1.0, 1.0, 1.1, 1.0])),
        lambda: setattr(scene.lights[0], "direction", (0.2, 0.1, -1.0)),
        lambda: setattr(thin, "casts", False),
        lambda: scene.remove(thick),
    ]
    with po.Renderer(scene, device="cpu", map_size=64) as renderer:
        renderer.transmittance(thick)
        for change in changes:
            change()
            found = renderer.transmittance(thick)
            assert statuses(renderer)["transmittance"] == "ran"
            assert (renderer.transmittance(thick) == found).all()
            assert statuses(renderer)["transmittance"] == "cached"
            renderer.invalidate()
            assert (renderer.transmittance(thick) == found).all()


def statuses(renderer: po.Renderer) -> dict[str, str]:
    return {row.name: row.status for row in renderer.report}


def test_transmittance_fills_an_array_that_is_there() -> None:
    scene = tufts()
    points = np.random.default_rng(8).uniform(-9, 9, (40, 3)).astype(np.float32)
    with po.Renderer(scene, device="cpu", map_size=64) as renderer:
        for where, count in ((points, 40), (scene.shapes[1], len(scene.shapes[1].points))):
            out = np.full(count, -1.0, np.float32)
            assert renderer.transmittance(where, out=out) is out
            assert (out == renderer.transmittance(where)).all()
        read_only = np.empty(40, np.float32)
        read_only.flags.writeable = False
        bad = (np.empty(39, np.float32), np.empty(40), np.empty((40, 3), np.float32), read_only)
        for wrong in (*bad, np.empty(80, np.float32)[::2], [0.0] * 40):
            with pytest.raises(po.ParameterError):
                renderer.transmittance(points, out=wrong)  # type: ignore[arg-type]


def test_threads_take_turns() -> None:
    scene = tufts()
    with po.Renderer(scene, device="cpu", map_size=64) as renderer:
        expected = [renderer.transmittance(shape) for shape in scene.shapes]
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            asked = [pool.submit(renderer.transmittance, scene.shapes[i % 2]) for i in range(40)]
            for i, answer in enumerate(asked):
                assert (answer.result() == expected[i % 2]).all()


def test_an_empty_scene_is_lit() -> None:
    points = np.zeros((3, 3))
    assert po.transmittance(po.Scene(), points).tolist() == [1.0] * 3
    lit = po.Scene(po.DirectionalLight(LIGHT))
    assert po.transmittance(lit, points, technique="exact").tolist() == [1.0] * 3
    assert po.transmittance(lit, np.empty((0, 3))).shape == (0,)


def test_bad_arguments_are_typed() -> None:
    scene = tufts()
    bad: list[dict[str, Any]] = [
        {"technique": "exakt"},
        {"map_size": 0},
        {"map_size": "huge"},
        {"light": 1},
        {"points": np.array([[0.0, np.nan, 0.0]])},
        {"points": np.zeros((2, 2))},
    ]
    for arguments in bad:
        with pytest.raises(po.ParameterError) as caught:
            po.transmittance(scene, **{"points": np.zeros((1, 3)), **arguments})
        assert caught.value.fix
