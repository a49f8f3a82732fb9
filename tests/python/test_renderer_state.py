"""What a renderer keeps between frames never shows: a picture equals that of a new renderer."""

import numpy as np
import pytest

import pyopacity as po
from scenes import hair_over_ball, tangle

OPTIONS = {"size": (48, 32), "map_size": 64, "antialiasing": 1}
NAMES = sorted(po.techniques())


def picture(scene, technique, **options):
    with po.Renderer(scene, technique=technique, **(OPTIONS | options)) as r:
        return r.render()


@pytest.mark.parametrize("name", NAMES)
def test_another_technique_of_the_same_name(needs_gl, name):
    scene = hair_over_ball()
    with po.Renderer(scene, technique=name, **OPTIONS) as r:
        r.render()
        for bias in (0.01, 1.0):
            r.technique = po.technique(name, bias=bias)
            assert np.array_equal(r.render(), picture(scene, po.technique(name, bias=bias)))


@pytest.mark.parametrize("name", NAMES)
def test_one_technique_in_two_renderers(needs_gl, name):
    technique = po.technique(name)
    near, far = hair_over_ball(), hair_over_ball()
    far.shapes[0].opacity = 0.8
    with (
        po.Renderer(near, technique=technique, **OPTIONS) as a,
        po.Renderer(far, technique=technique, **OPTIONS) as b,
    ):
        first, second = a.render(), b.render()
        a.invalidate()
        assert np.array_equal(a.render(), first)
        assert np.array_equal(b.render(), second)
        assert np.array_equal(first, picture(near, name))
        assert np.array_equal(second, picture(far, name))


def test_questions_after_a_change_before_the_next_frame(needs_gl):
    with po.Renderer(hair_over_ball(), technique="bounding_opacity_maps", **OPTIONS) as r:
        r.render()
        r.technique = "exact"
        assert "bounding_opacity_maps/opacity" in r.graph_dot()
        assert r.read("bounding_opacity_maps/start").shape == (64, 64)
        assert r.report
        r.render()
        assert "exact/sort" in r.graph_dot()
        with pytest.raises(po.ParameterError):
            r.read("bounding_opacity_maps/start")


@pytest.mark.parametrize("antialiasing", [1, 2])
def test_every_texture_that_can_be_read_was_written(needs_gl, antialiasing):
    with po.Renderer(
        hair_over_ball(),
        technique="exact",
        **(OPTIONS | {"antialiasing": antialiasing, "compositing": "opaque"}),
    ) as r:
        image = r.render()
        assert np.array_equal(r.read("image"), image)
        depth = r.read("camera_depth")
        assert depth.shape == (32 * antialiasing, 48 * antialiasing)
        assert (depth > 0).mean() == pytest.approx(image[..., 3].mean(), abs=1e-6)


def test_the_target_of_the_camera_is_a_direction_only(needs_gl):
    scene = hair_over_ball()
    pictures = [
        picture(scene, "unshadowed", camera=po.Camera.look_at((0, -30, 0), (0, distance, 0)))
        for distance in (0, 1e2, 1e6)
    ]
    assert pictures[0][..., 3].max() == 1.0
    for other in pictures[1:]:
        assert np.array_equal(pictures[0], other)


def test_what_stands_elsewhere_leaves_the_shadows_within_hair(needs_gl):
    """The automatic bias is the receiver's own: no ground and no thick strand moves it."""
    points, offsets = tangle(11, strands=200)
    hair = po.Strands(points, offsets, width=0.05, opacity=0.3)
    far = np.array([[80.0, 80.0, -1.0], [80.0, 80.0, 1.0]])
    thick = po.Strands(far, np.array([0, 2]), width=1.0, opacity=0.3)
    side = 1e4 * np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float) - [0, 0, 20]
    ground = po.Mesh(side, np.array([[0, 1, 2], [0, 2, 3]]))
    ground.casts = False

    def shadow(*others):
        scene = po.Scene(hair, *others, po.DirectionalLight(direction=(0.2, 0.1, -1.0)))
        with po.Renderer(scene, technique="exact", **(OPTIONS | {"map_size": 2048})) as r:
            return float(r.transmittance(hair).mean())

    alone = shadow()
    assert shadow(ground) == pytest.approx(alone, abs=1e-6)
    assert shadow(thick) == pytest.approx(alone, abs=0.02)  # a coarser map, no other bias


def test_a_map_of_few_texels_leaks_no_light(needs_gl):
    side = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    roof = po.Mesh(side, np.array([[0, 1, 2], [0, 2, 3]]))
    scene = po.Scene(roof, po.DirectionalLight(direction=(0, 0, -1)))
    below = 0.9 * side - [0, 0, 1]
    for size in (1, 2, 3):
        with po.Renderer(scene, technique="exact", **(OPTIONS | {"map_size": size})) as r:
            assert r.transmittance(below).max() == 0.0


def test_a_misspelt_keyword_names_the_nearest(needs_gl):
    with pytest.raises(po.ParameterError, match="background"):
        po.Renderer(po.Scene(), backgruond=(0, 0, 0))
    with pytest.raises(po.ParameterError, match="map_size"):
        po.Renderer(po.Scene(), map_sze=64)


def test_a_picture_that_its_samples_make_too_large_says_so(needs_gl):
    with po.Renderer(po.Scene(), size=(16384, 1), antialiasing=8) as r:
        with pytest.raises(po.ParameterError, match="antialiasing"):
            r.render()
        r.size = (4, 4)
        assert r.render().shape == (4, 4, 4)


def test_the_least_change_of_the_background_is_a_change(needs_gl):
    with po.Renderer(po.Scene(), background=(1e-8, 0, 0), **OPTIONS) as r:
        r.render()
        r.background = (2e-8, 0, 0)
        assert r.render()[0, 0, 0] == np.float32(2e-8)
        assert [row.why for row in r.report if row.name == "lighting"] == ["no solids"]
