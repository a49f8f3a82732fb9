"""deposit: scattered into its own layer, a caster gives what blended into all behind it gives."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest

import pyopacity as po
from scenes import random_shapes, tangle

pytestmark = pytest.mark.gl

MAPS = "bounding_opacity_maps"
LAYERED = (MAPS, "deep_opacity_maps", "opacity_shadow_maps")
ON_WHAT = 1e-4  # of T: docs/accuracy.md
LARGEST = 1 - 2.0**-24  # opacity, of an optical depth of 16.6
Array = npt.NDArray[np.float32]

LIGHTS: dict[str, Callable[[], po.Light]] = {
    "directional": lambda: po.DirectionalLight((0.5, 0.3, -0.8)),
    "far point": lambda: po.PointLight((3, 5, 60)),
    "near point": lambda: po.PointLight((1, 2, 9)),
    "point inside": lambda: po.PointLight((0.1, 0.2, 0.3)),
    "narrow spot": lambda: po.SpotLight((4, 8, 30), (-0.1, -0.25, -0.9), angle_deg=30),
    "wide spot": lambda: po.SpotLight((2, 1, 12), (-0.2, 0, -1), angle_deg=160),
    "area": lambda: po.AreaLight((0, 0, 30), (4, 0, 0), (0, 4, 0), samples=2),
}


def hair(opacity: float = 0.3) -> po.Strands:
    points, offsets = tangle(3, strands=400, points=9, step=0.4)
    return po.Strands(points, offsets, width=0.1, opacity=opacity)


def every_kind(light: po.Light) -> po.Scene:
    """Strands, leaves, particles, a volume, and an opaque sheet that hides some of them."""
    sheet = np.array([[-2, -3, -1], [3, -3, -1], [3, 1, 0], [-2, 1, 0]], float)
    return po.Scene(
        hair(), *random_shapes(5), po.Mesh(sheet, np.array([[0, 1, 2], [0, 2, 3]])), light
    )


class Asked:
    """T at every point of a scene, and what the report and a map say."""

    def __init__(
        self,
        scene: po.Scene,
        technique: str = MAPS,
        device: str = "gpu",
        map_size: int = 96,
        **parameters: object,
    ) -> None:
        made = po.technique(technique, **parameters)
        with po.Renderer(
            scene, technique=made, device=device, map_size=map_size, size=(8, 8)
        ) as renderer:
            self.T = np.concatenate([renderer.transmittance(shape) for shape in scene.shapes])
            self.planes = renderer.read(f"{technique}/opacity")
            self.notes = {
                row.name.removeprefix(f"{technique}/"): row.note for row in renderer.report
            }
            self.start = (
                None if technique == "opacity_shadow_maps" else renderer.read(f"{technique}/start")
            )

    def bits(self) -> bytes:
        return self.T.tobytes() + self.planes.tobytes()


@pytest.mark.parametrize("light", LIGHTS)
@pytest.mark.parametrize("technique", LAYERED)
def test_scatter_gives_what_blending_gives(needs_gl, technique, light):
    scene = every_kind(LIGHTS[light]())
    blended = Asked(scene, technique, deposit="blend")
    scattered = Asked(scene, technique, deposit="scatter")
    assert blended.notes["opacity"].startswith("blend")
    assert scattered.notes["opacity"].startswith("scatter")
    assert np.abs(scattered.T - blended.T).max() <= ON_WHAT
    assert 0.01 < blended.T.mean() < 0.99


@pytest.mark.parametrize("technique", LAYERED)
def test_the_cpu_gives_it_too(needs_gl, technique):
    # Without triangles, on whose edges CPU and rasteriser round differently.
    shapes = [shape for shape in random_shapes(5) if not isinstance(shape, po.Mesh)]
    scene = po.Scene(hair(), *shapes, LIGHTS["directional"]())
    scattered = Asked(scene, technique, deposit="scatter")
    assert np.abs(scattered.T - Asked(scene, technique, "cpu").T).max() <= ON_WHAT


@pytest.mark.parametrize(
    ("technique", "parameters"),
    [
        (MAPS, {"layers": 1}),
        (MAPS, {"layers": 64, "interpolation": "linear"}),
        (MAPS, {"split": "per_texel"}),
        (MAPS, {"search_frames": 11}),
        (MAPS, {"bounds": "depth_func"}),
        (MAPS, {"deposit_rule": "paper"}),
        ("deep_opacity_maps", {"packing": "4n-1", "layers": 7}),
        ("deep_opacity_maps", {"beyond": "ignore", "layer_extent": 2.0}),
        ("deep_opacity_maps", {"depth_bits": 8}),
        ("deep_opacity_maps", {"smoothing": 2}),
        ("opacity_shadow_maps", {"layers": 200, "interpolation": "cubic"}),
        ("opacity_shadow_maps", {"slicing": "density"}),
    ],
)
def test_under_every_way_to_lay_layers(needs_gl, technique, parameters):
    scene = every_kind(LIGHTS["directional"]())
    blended = Asked(scene, technique, deposit="blend", **parameters)
    scattered = Asked(scene, technique, deposit="scatter", **parameters)
    assert np.abs(scattered.T - blended.T).max() <= ON_WHAT


@pytest.mark.parametrize("technique", [MAPS, "deep_opacity_maps"])
def test_bounds_have_the_bits_of_blended_ones(needs_gl, technique):
    scene = every_kind(LIGHTS["directional"]())
    blended = Asked(scene, technique, deposit="blend")
    scattered = Asked(scene, technique, deposit="scatter")
    assert np.array_equal(scattered.start, blended.start)
    assert (blended.start < 1).mean() > 0.1


def test_the_order_of_casters_is_in_no_bit(needs_gl):
    points, offsets = tangle(3, strands=400, points=9, step=0.4)
    order = np.random.default_rng(0).permutation(400)
    shuffled = points.reshape(400, 9, 3)[order].reshape(-1, 3)
    light = LIGHTS["directional"]
    maps = [
        Asked(po.Scene(*shapes, light()), deposit="scatter").planes
        for shapes in (
            [po.Strands(points, offsets, width=0.1, opacity=0.3), *random_shapes(5)],
            [*random_shapes(5)[::-1], po.Strands(shuffled, offsets, width=0.1, opacity=0.3)],
        )
    ]
    assert np.array_equal(*maps)


def stack(count: int, opacity: float) -> po.Scene:
    """Ribbons one behind the other, each over the same texels of the middle of the map, whole."""
    z = -np.arange(count) / count
    ends = np.zeros((count, 2, 3), np.float32)
    ends[:, 0, 0], ends[:, 1, 0] = -1, 1
    ends[:, :, 2] = z[:, None]
    strands = po.Strands(ends.reshape(-1, 3), 2 * np.arange(count + 1), width=2.0, opacity=opacity)
    return po.Scene(strands, po.DirectionalLight((0, 0, -1)))


@pytest.mark.parametrize(
    ("opacity", "tau"), [(LARGEST, 24 * np.log(2)), (0.5, np.log(2)), (1e-8, 1e-8)]
)
@pytest.mark.parametrize("interpolation", ["linear", "mean_depth"])
def test_a_million_overlaps_are_counted(needs_gl, opacity, tau, interpolation):
    count, layers = 1_000_000, 4
    with po.Renderer(
        stack(count, opacity),
        technique=po.technique(
            MAPS,
            layers=layers,
            split="linear",
            interpolation=interpolation,
            deposit="scatter",
            bias=0,
        ),
        map_size=8,
        size=(8, 8),
    ) as renderer:
        z = np.float32([0.1, -0.3, -0.6, -1.1])
        T = renderer.transmittance(np.stack([0 * z, 0 * z, z], 1))
        middle = renderer.read(f"{MAPS}/opacity")[:, 4, 4, 0]
        note = next(row.note for row in renderer.report if row.name == f"{MAPS}/opacity")
    planes = tau * count * np.arange(1, layers + 1) / layers
    assert middle == pytest.approx(planes, rel=1e-5, abs=count * 2.0**-38)
    assert pytest.approx(np.exp(-tau * count * np.clip(-z, 0, 1)), abs=ON_WHAT) == T
    assert ("twice for carries" in note) == (opacity > 0.1)


def test_a_faint_caster_beside_the_densest_keeps_its_digits(needs_gl):
    dense, faint = stack(1000, LARGEST).shapes[0], stack(1, 1e-5).shapes[0]
    faint.transform = np.array([[1, 0, 0, 8], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], float)
    scene = po.Scene(dense, faint, po.DirectionalLight((0, 0, -1)))
    with po.Renderer(
        scene, technique=po.technique(MAPS, deposit="scatter", bias=0), map_size=64, size=(8, 8)
    ) as renderer:
        T = renderer.transmittance(np.float32([[8, 0, -1], [0, 0, -1]]))
    assert T[0] == pytest.approx(1 - 1e-5, abs=2e-7)
    assert T[1] == 0


@pytest.mark.parametrize("technique", [*LAYERED, "adaptive_opacity_maps"])
def test_what_moves_leaves_no_bit_behind(needs_gl, technique):
    """Texels that have become empty are skipped, and hold what they hold in a new map."""
    near, far = hair(), hair()
    far.transform = np.array([[1, 0, 0, 9], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], float)
    scene = po.Scene(near, far, LIGHTS["directional"]())
    turned = np.diag([-1.0, 1.0, 0.5, 1.0])
    made = po.technique(technique, deposit="scatter")
    with po.Renderer(scene, technique=made, map_size=96, size=(8, 8), steady=False) as renderer:
        renderer.transmittance(near)
        before = renderer.read(f"{technique}/opacity")
        near.transform = turned
        T = np.concatenate([renderer.transmittance(shape) for shape in scene.shapes])
        planes = renderer.read(f"{technique}/opacity")
    anew = Asked(scene, technique, deposit="scatter")
    assert np.array_equal(planes, anew.planes)
    assert np.array_equal(T, anew.T)
    assert ((before[-1] > 0) & (planes[-1] == 0)).mean() > 0.01


def test_a_scatter_keeps_no_more_than_blending(needs_gl):
    """Sums turn into planes where they lie; one texel waits for carries."""

    def kept(deposit: str) -> int:
        scene = po.Scene(hair(), LIGHTS["directional"]())
        made = po.technique(MAPS, deposit=deposit)
        with po.Renderer(scene, technique=made, map_size=96, size=(8, 8)) as renderer:
            renderer.transmittance(scene.shapes[0])
            return sum(row.bytes for row in renderer.memory() if row.name.startswith(MAPS))

    assert kept("scatter") <= kept("blend") + 64


def test_automatic_goes_by_casters_and_texels(needs_gl):
    scene = po.Scene(hair(), LIGHTS["directional"]())
    many, few = Asked(scene, map_size=96), Asked(scene, map_size=512)
    assert many.notes["opacity"].startswith("scatter")
    assert few.notes["opacity"].startswith("blend")
    for notes in (many.notes, few.notes):
        assert "3200 segments and particles for" in notes["opacity"]


def test_automatic_blends_what_the_papers_sum_in(needs_gl):
    scene = po.Scene(hair(), LIGHTS["directional"]())
    assert "accumulator is float16" in Asked(scene, accumulator="float16").notes["opacity"]
    with pytest.raises(po.ParameterError, match="fixed point"):
        Asked(scene, accumulator="unorm8", deposit="scatter")


def test_small_casters_alone_are_not_drawn(needs_gl):
    points, offsets = tangle()
    wide = po.Strands(points, offsets, width=8.0, opacity=0.2)
    veil = po.Mesh(points[:3], np.array([[0, 1, 2]]), opacity=0.5)
    for light, dispatched in (("directional", 1), ("far point", 1), ("point inside", 0)):
        scene = po.Scene(hair(), wide, veil, LIGHTS[light]())
        note = Asked(scene, deposit="scatter", map_size=256).notes["opacity"]
        assert note.startswith(f"scatter: {dispatched} of 3 shapes without rasteriser")


def test_a_new_opacity_leaves_the_bounds(needs_gl):
    scene = po.Scene(hair(), LIGHTS["directional"]())
    technique = po.technique(MAPS, deposit="scatter")
    with po.Renderer(scene, technique=technique, map_size=96, size=(8, 8)) as renderer:
        renderer.transmittance(scene.shapes[0])
        scene.shapes[0].opacity = 0.4
        again = renderer.transmittance(scene.shapes[0])
        status = {row.name: row.status for row in renderer.report}
        assert status[f"{MAPS}/bounds"] == "cached"
        assert status[f"{MAPS}/opacity"] == "ran"
        renderer.invalidate()
        assert np.array_equal(renderer.transmittance(scene.shapes[0]), again)
