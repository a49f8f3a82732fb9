"""Truth by rays against Mitsuba 3, where it is installed (extra ``truth``).

Mitsuba intersects in float32, with code that shares nothing with ours; its ``mask`` lets through
1 - opacity of a ray.
"""

import pathlib
from typing import Any

import numpy as np
import pytest

import pyopacity as po

mi = pytest.importorskip("mitsuba")

LIGHT = np.array((0.3, 0.2, -0.9)) / np.linalg.norm((0.3, 0.2, -0.9))
RAYS = 400


@pytest.fixture(autouse=True, scope="module")
def variant() -> None:
    mi.set_variant("scalar_rgb")


def masked(shape: dict[str, Any], opacity: float) -> dict[str, Any]:
    bsdf = {"type": "mask", "opacity": opacity, "nested": {"type": "diffuse"}}
    return {**shape, "bsdf": bsdf}


def triangles(mesh: po.Mesh, path: pathlib.Path, opacity: float) -> dict[str, Any]:
    """Mitsuba's copy of a mesh, through a file."""
    vertices = "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in mesh.points.tolist())
    faces = "".join(f"f {a} {b} {c}\n" for a, b, c in (mesh.triangles + 1).tolist())
    path.write_text(vertices + faces)
    return masked({"type": "obj", "filename": str(path), "face_normals": True}, opacity)


def transmittance(scene: Any, points: np.ndarray) -> np.ndarray:
    """Every surface on the way to the light, one after the other."""
    result = np.ones(len(points))
    for i, point in enumerate(points):
        ray = mi.Ray3f(mi.Point3f(*point.tolist()), mi.Vector3f(*(-LIGHT).tolist()))
        for _ in range(100):
            surface = scene.ray_intersect(ray)
            if not surface.is_valid():
                break
            result[i] *= surface.bsdf().eval_null_transmission(surface)[0]
            ray = surface.spawn_ray(ray.d)
    return result


def test_triangles_agree(tmp_path: pathlib.Path) -> None:
    random = np.random.default_rng(1)
    shapes, copies = [], {}
    for name, opacity, count in (("leaves", 0.25, 80), ("veils", 0.6, 20), ("stones", 1.0, 3)):
        corners = random.uniform(-1, 1, (count, 1, 3)) + random.normal(0, 0.4, (count, 3, 3))
        triangle = np.arange(3 * count).reshape(-1, 3)
        xyz = corners.reshape(-1, 3).astype(np.float32)
        mesh = po.Mesh(xyz, triangle, opacity=opacity)
        shapes.append(mesh)
        copies[name] = triangles(mesh, tmp_path / f"{name}.obj", opacity)
    at = random.uniform(-1.5, 1.5, (RAYS, 3)).astype(np.float32)
    scene = po.Scene(shapes, po.DirectionalLight(tuple(LIGHT)))
    T = po.trace_transmittance(scene, at, bias=0.0)
    theirs = transmittance(mi.load_dict({"type": "scene", **copies}), at)
    error = np.abs(T - theirs)
    # An edge within float32 of a ray may be decided differently: seldom.
    assert np.mean(error > 1e-5) <= 0.005 and 0.1 < T.mean() < 0.9
    assert len(np.unique(np.round(theirs, 5))) > 10


def test_strands_agree_away_from_their_ends(tmp_path: pathlib.Path) -> None:
    """Straight ones: at a bend, and beyond its ends, Mitsuba's round tube is another shape."""
    random = np.random.default_rng(2)
    count, width, opacity = 60, 0.15, 0.4
    ends = random.uniform(-1, 1, (count, 1, 3)) + random.normal(0, 0.7, (count, 2, 3))
    ends = ends.astype(np.float32)
    lines = (
        "\n".join(f"{x!r} {y!r} {z!r} {width / 2}" for x, y, z in pair) for pair in ends.tolist()
    )
    path = tmp_path / "strands.txt"
    path.write_text("\n\n".join(lines) + "\n")
    curves = {"type": "linearcurve", "filename": str(path)}
    theirs = mi.load_dict({"type": "scene", "curves": masked(curves, opacity)})
    at = random.uniform(-1.5, 1.5, (4 * RAYS, 3)).astype(np.float32)
    # Where a tube is met decides for Mitsuba, its axis for us: no receiver inside one, and none
    # whose ray passes a round end.
    apart = at[:, None] - ends.reshape(1, -1, 3).astype(np.float64)
    apart -= (apart @ LIGHT)[..., None] * LIGHT
    below = at + 4.0 * LIGHT
    at = np.ascontiguousarray(below[(np.linalg.norm(apart, axis=-1) > 0.51 * width).all(axis=1)])
    strands = po.Strands(ends.reshape(-1, 3), np.arange(0, 2 * count + 1, 2), width, opacity)
    scene = po.Scene(strands, po.DirectionalLight(tuple(LIGHT)))
    T = po.trace_transmittance(scene, at.astype(np.float32), bias=0.0)
    error = np.abs(T - transmittance(theirs, at))
    assert len(at) > 100 and np.mean(error > 1e-5) <= 0.005 and 0.1 < T.mean() < 0.9
