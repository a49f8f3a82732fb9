"""The picture that Mitsuba 3 makes of the same strands: volpath through masked linear curves.

Only what arrives straight from the light is asked for, so that a pixel is albedo x T in both.
In Mitsuba a strand is a round tube that reflects by Lambert's cosine; the engine shades an axis, by
the sine of its angle to the light (Kajiya and Kay 1989). The tube has that sine too, times the mean
cosine over the side that is seen: this factor, in closed form, goes into the engine's colours.
"""

from __future__ import annotations

import importlib.util
import pathlib
import tempfile
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from pyopacity import metrics
from pyopacity.benchmark import ways
from pyopacity.benchmark.clock import WHOLE, Parts, Turns, seconds_of, timed
from pyopacity.benchmark.run import LIGHT, Run, has_strands, strands_of
from pyopacity.camera import Camera
from pyopacity.light import DirectionalLight
from pyopacity.renderer import Renderer
from pyopacity.scene import Scene
from pyopacity.shapes import Strands
from pyopacity.technique import technique

F32 = npt.NDArray[np.float32]
F64 = npt.NDArray[np.float64]
OURS, THEIRS = "pyopacity", "Mitsuba"
INSTALL = "install mitsuba: pip install 'pyopacity[truth]'"
_ALBEDO = (0.7, 0.5, 0.3)


@dataclass(frozen=True, slots=True)
class Pictures:
    """Of the same strands by both.

    Attributes:
        where: the scene, the picture, the samples.
        turns: of both, everything anew; scenes are loaded, and programs compiled, before.
        difference: RMSE of linear RGB against Mitsuba's with many samples.
        on_strands: the same of the pixels in which Mitsuba sees any; None where there are none.
        noise: the whole picture's, of Mitsuba's with few samples.
    """

    where: str
    turns: Turns
    difference: float
    on_strands: float | None
    noise: float


def missing(run: Run) -> str | None:
    """What a comparison needs that is not there; None where nothing is."""
    if run.plan.device == "cpu":
        return "pictures need OpenGL"
    if not is_installed():
        return INSTALL
    return None if has_strands(run.scene(run.plan.hair)) else "the scene has no strands"


def is_installed() -> bool:
    """Whether there is a Mitsuba to compare with."""
    return importlib.util.find_spec("mitsuba") is not None


def measure(run: Run) -> Pictures:
    """Both take turns, and have all cores."""
    plan = run.plan
    size = plan.goals.picture_size
    few, many = plan.goals.picture_samples
    scene, camera = _scene(run)
    where = f"{plan.hair}, {size[0]}x{size[1]}, {few} samples, errors against {many}"
    with (
        tempfile.TemporaryDirectory() as folder,
        _renderer(scene, camera, size) as renderer,
    ):
        theirs = _Mitsuba(strands_of(scene), camera, size, pathlib.Path(folder))
        run.tell(f"Mitsuba: {where}")
        reference = theirs.render(many)
        noise = metrics.rmse(theirs.render(few), reference)
        ours = renderer.render()[..., :3]

        def draw() -> Parts:
            renderer.invalidate()
            return {WHOLE: seconds_of(renderer.render)}

        turns = plan.clock.in_turns({OURS: draw, THEIRS: timed(lambda: theirs.render(few))})
    seen = reference.any(axis=-1)
    return Pictures(
        where=where,
        turns=turns,
        difference=metrics.rmse(ours, reference),
        on_strands=metrics.rmse(ours[seen], reference[seen]) if seen.any() else None,
        noise=noise,
    )


def _renderer(scene: Scene, camera: Camera, size: tuple[int, int]) -> Renderer:
    """No search of planes, and a map as fine as the picture."""
    return Renderer(
        scene,
        camera,
        size=size,
        technique=technique(ways.BOUNDING, **ways.FIXED_SPLIT),
        map_size=max(size),
        ambient=0.0,
        specular=0.0,
    )


def _scene(run: Run) -> tuple[Scene, Camera]:
    """The strands alone, in the world and of one opacity, and a camera on the light's side."""
    given = strands_of(run.scene(run.plan.hair))
    toward = -np.asarray(LIGHT) / np.linalg.norm(LIGHT)
    camera = Camera.fit(Scene(given), tuple(-toward + (0.6, 0.0, 0.0)))
    matrix = given.transform
    strands = Strands(
        np.asarray(given.points, np.float64) @ matrix[:3, :3].T + matrix[:3, 3],
        given.offsets,
        width=np.asarray(given.width) * abs(np.linalg.det(matrix[:3, :3])) ** (1.0 / 3.0),
        opacity=float(np.mean(given.opacity)),
    )
    strands.color = np.asarray(_ALBEDO) * _mean_cosine(strands, toward, camera)[:, None]
    return Scene(strands, DirectionalLight(LIGHT)), camera


def _mean_cosine(strands: Strands, toward: F64, camera: Camera) -> F64:
    """(N,): of Lambert's cosine over the visible side of a tube, without the sine to its axis.

    At an angle phi between the light and the eye about the axis it is the integral of cos(a)
    cos(a - phi) over the half of the tube that is seen and lit, over 2, the seen width:
    ((pi - |phi|) cos phi + sin |phi|) / 4.
    """
    points = np.asarray(strands.points, np.float64)
    axis = np.gradient(points, axis=0)
    for first, end in zip(strands.offsets[:-1], strands.offsets[1:], strict=True):
        axis[first:end] = np.gradient(points[first:end], axis=0)
    axis /= np.maximum(np.linalg.norm(axis, axis=1, keepdims=True), 1e-30)
    to_light = _about(axis, np.broadcast_to(toward, points.shape))
    to_eye = _about(axis, np.asarray(camera.eye) - points)
    phi = np.arccos(np.clip((to_light * to_eye).sum(axis=1), -1.0, 1.0))
    mean: F64 = ((np.pi - phi) * np.cos(phi) + np.sin(phi)) / 4.0
    return mean


def _about(axis: F64, vectors: F64) -> F64:
    """The part of vectors across an axis, of length 1."""
    across = vectors - (vectors * axis).sum(axis=1, keepdims=True) * axis
    unit: F64 = across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-30)
    return unit


class _Mitsuba:
    """The same strands, light and camera there."""

    def __init__(
        self, strands: Strands, camera: Camera, size: tuple[int, int], folder: pathlib.Path
    ) -> None:
        import mitsuba

        mitsuba.set_variant("scalar_rgb")
        self._mitsuba = mitsuba
        path = folder / "strands.txt"
        path.write_text(_curves(strands))
        self._scene: Any = mitsuba.load_dict(_description(strands, camera, size, path))

    def render(self, samples: int) -> F32:
        """(H, W, 3) float32, linear."""
        picture = np.array(self._mitsuba.render(self._scene, spp=samples), np.float32)
        return np.ascontiguousarray(picture[..., :3])


def _curves(strands: Strands) -> str:
    """A line a point: x y z radius; an empty one between strands."""
    radius = np.broadcast_to(np.asarray(strands.width) / 2.0, len(strands.points))
    rows = [
        f"{x!r} {y!r} {z!r} {r!r}"
        for (x, y, z), r in zip(np.asarray(strands.points).tolist(), radius.tolist(), strict=True)
    ]
    ends = zip(strands.offsets[:-1], strands.offsets[1:], strict=True)
    return "\n\n".join("\n".join(rows[first:end]) for first, end in ends) + "\n"


def _description(
    strands: Strands, camera: Camera, size: tuple[int, int], path: pathlib.Path
) -> dict[str, Any]:
    """The scene: a surface of albedo a sends back a cos of this light."""
    albedo = {"type": "rgb", "value": list(_ALBEDO)}
    return {
        "type": "scene",
        "integrator": {"type": "volpath", "max_depth": 2, "rr_depth": 1000},
        "sensor": _sensor(camera, size),
        "light": {
            "type": "directional",
            "direction": list(LIGHT),
            "irradiance": {"type": "rgb", "value": [float(np.pi)] * 3},
        },
        "strands": {
            "type": "linearcurve",
            "filename": str(path),
            "bsdf": {
                "type": "mask",
                "opacity": float(np.mean(strands.opacity)),
                "nested": {"type": "diffuse", "reflectance": albedo},
            },
        },
    }


def _sensor(camera: Camera, size: tuple[int, int]) -> dict[str, Any]:
    from mitsuba import ScalarTransform4f

    width, height = size
    look_at = ScalarTransform4f().look_at(
        origin=list(camera.eye), target=list(camera.target), up=list(camera.up)
    )
    return {
        "type": "perspective",
        "fov": camera.fov_deg,
        "fov_axis": "y",
        "to_world": look_at,
        "film": {
            "type": "hdrfilm",
            "width": width,
            "height": height,
            "rfilter": {"type": "box"},
            "pixel_format": "rgb",
        },
        "sampler": {"type": "independent"},
    }
