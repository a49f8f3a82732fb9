"""What `render` and `compare` have in common: files, light, view, and the renderer's settings."""

import argparse
from collections.abc import Collection
from typing import Any

import numpy as np

import pyopacity as po
from pyopacity import _native
from pyopacity._attributes import describe
from pyopacity.cli import light_options, text
from pyopacity.cli.text import Vector

# In a world whose z points up; turned for another `--up`.
_LIGHT_DIRECTION: Vector = (0.5, 0.3, -0.8)
_VIEW_DIRECTION: Vector = (0.3, 1.0, -0.25)


# ---- which options there are ----


def add_files(add: Any) -> None:
    """The files, which go into one scene."""
    add("files", nargs="+", metavar="FILE", help=f"{text.FILES}; all files go into one scene")


def add_light_and_view(add: Any) -> None:
    """From where light comes, and from where the picture is taken."""
    add("--light", action="append", default=[], metavar="LIGHT", help=light_options.HELP)
    add(
        "--camera",
        metavar="VIEW",
        help="eye:target[:fov], such as 0,-9,2:0,0,1:35; or a direction to look along, all in view",
    )
    add("--up", default="z", metavar="AXIS", help="x, y, z or a direction (default: z)")
    add("--background", metavar="R,G,B[,A]", help="linear colour behind everything")


def add_parameters(add: Any) -> None:
    """Parameters of a technique, and plugins that bring it."""
    text.add_plugins(add)
    add(
        "--param",
        action="append",
        default=[],
        metavar="K=V",
        help="a parameter of the technique; again for more (pyopacity techniques lists them)",
    )


def add_strands(add: Any) -> None:
    """What replaces that of the file."""
    add("--opacity", metavar="A|R,G,B", help="of every strand, instead of the file's: 0..1")
    add("--width", metavar="N", help="of every strand, instead of the file's")


def add_settings(add: Any, without: Collection[str] = ()) -> None:
    """The renderer's settings, each by its own name."""
    for setting in _settings(without):
        option = f"--{setting.name.replace('_', '-')}"
        add(option, metavar="N", help=describe(setting).replace("%", "%%"))


# ---- what they say ----


def load(arguments: argparse.Namespace) -> po.Scene:
    """The scene of all files, without a light."""
    scene = po.Scene()
    for file in arguments.files:
        text.progress(f"loading {file}")
        scene.add(po.load(file))
    changes = strand_changes(arguments)
    strands = [shape for shape in scene.shapes if isinstance(shape, po.Strands)]
    if changes and not strands:
        raise po.ParameterError(
            f"there are no strands for --{next(iter(changes))}",
            "leave it out, or render a file with strands",
        )
    for shape in strands:
        for name, new in changes.items():
            setattr(shape, name, new)
    return scene


def strand_changes(arguments: argparse.Namespace) -> dict[str, Any]:
    """What :func:`add_strands` asks for: name and value of an attribute."""
    kinds = {"opacity": ((1, 3), "one number, or R,G,B"), "width": ((1,), "one number")}
    changes: dict[str, Any] = {}
    for name, (counts, wanted) in kinds.items():
        if (given := getattr(arguments, name)) is not None:
            numbers = text.numbers(f"--{name}", given, counts, wanted)
            changes[name] = numbers if len(numbers) > 1 else numbers[0]
    return changes


def lights(arguments: argparse.Namespace) -> list[po.Light]:
    """The lights that `--light` asks for, or the usual one."""
    if arguments.light:
        return [light_options.read(given) for given in arguments.light]
    return [po.DirectionalLight(_turned(_LIGHT_DIRECTION, text.axis("--up", arguments.up)))]


def settings(arguments: argparse.Namespace, without: Collection[str] = ()) -> dict[str, Any]:
    """What :func:`add_settings` and `--background` ask for, checked before anything is loaded."""
    checked = _native.RenderSettings()
    options: dict[str, Any] = {}
    for setting in _settings(without):
        if (given := getattr(arguments, setting.name)) is not None:
            options[setting.name] = text.value(given)
            checked.set(setting.name, options[setting.name])
    if arguments.background is not None:
        options["background"] = text.numbers(
            "--background", arguments.background, (3, 4), "R,G,B or R,G,B,A"
        )
    return options


def size(option: str, given: str) -> tuple[int, int]:
    """WIDTHxHEIGHT of a picture that the renderer takes."""
    pixels = text.size(option, given)
    checked = _native.RenderSettings()
    for name, count in zip(("width", "height"), pixels, strict=True):
        checked.set(name, count)
    return pixels


class View:
    """The camera that `--camera` and `--up` ask for, read before there is a scene."""

    def __init__(self, arguments: argparse.Namespace) -> None:
        self.up = text.axis("--up", arguments.up)
        self.direction = _turned(_VIEW_DIRECTION, self.up)
        self.fixed: po.Camera | None = None
        if arguments.camera is None:
            return
        example = "eye:target, such as 0,-9,2:0,0,1, or a direction, such as 0,1,0"
        parts = arguments.camera.split(":")
        vectors = [text.vector("--camera", part, example) for part in parts[:2]]
        fov = [text.numbers("--camera", part, (1,), example)[0] for part in parts[2:3]]
        if len(parts) > 3:
            raise po.ParameterError(f'--camera "{arguments.camera}" has too many parts', example)
        if len(parts) == 1:
            self.direction = vectors[0]
        else:
            eye, target = vectors
            self.fixed = po.Camera.look_at(eye, target, self.up, *fov)
        po.Camera.fit([], self.direction, self.up)  # refuses what no scene can be seen with

    def of(self, scene: po.Scene) -> po.Camera:
        """Frames what casts: a wide ground need not be in view to its end."""
        casters = [shape for shape in scene.shapes if shape.casts]
        return self.fixed or po.Camera.fit(casters or scene, self.direction, self.up)


def _settings(without: Collection[str]) -> list[_native.Parameter]:
    """The renderer's own parameters; the size has an option, and --width is that of strands."""
    hidden = {"width", "height", *without}
    return [p for p in _native.RenderSettings().parameters() if p.name not in hidden]


def _turned(direction: Vector, up: Vector) -> Vector:
    """A direction of the world whose z points up, in the world whose `up` does."""
    z = np.array(up) / (np.linalg.norm(up) or 1.0)
    # The shortest turn from (0, 0, 1) to z (Rodrigues), a their cross product:
    # v + a x v + (a x (a x v)) / (1 + cos).
    if z[2] < -0.999999:
        return direction[0], -direction[1], -direction[2]
    axis = np.cross((0.0, 0.0, 1.0), z)
    v = np.array(direction)
    once = np.cross(axis, v)
    x, y, z_turned = (v + once + np.cross(axis, once) / (1.0 + z[2])).tolist()
    return x, y, z_turned
