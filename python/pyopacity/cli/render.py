"""``pyopacity render FILE... -o out.png``"""

import argparse
import dataclasses
import json
import pathlib
import time
from typing import Any

import numpy as np

import pyopacity as po
from pyopacity import _native
from pyopacity._attributes import describe
from pyopacity.cli import text
from pyopacity.cli.text import Vector
from pyopacity.image import check_folder, check_path

# In a world whose z points up; turned for another `--up`.
_LIGHT_DIRECTION: Vector = (0.5, 0.3, -0.8)
_VIEW_DIRECTION: Vector = (0.3, 1.0, -0.25)


def add_to(commands: Any) -> None:
    """The command's options."""
    add = text.add_command(commands, "render", run, "render files to one picture").add_argument
    add("files", nargs="+", metavar="FILE", help=".hair, .obj, demo:hair; all go into one scene")
    add("-o", "--output", required=True, metavar="PICTURE", help="the picture: .png or .npy")
    _add_light_and_view(add)
    _add_shadows(add)
    for setting in _settings():
        option = f"--{setting.name.replace('_', '-')}"
        add(option, metavar="N", help=describe(setting).replace("%", "%%"))
    add("--report", metavar="FILE", help="write what each pass did as JSON; - prints a table")
    add("--print-report", action="store_true", help="print what each pass did as a table")


def _add_light_and_view(add: Any) -> None:
    add("--light", metavar="X,Y,Z", help="the direction in which the light travels")
    add(
        "--camera",
        metavar="VIEW",
        help="eye:target[:fov], such as 0,-9,2:0,0,1:35; or a direction to look along, all in view",
    )
    add("--up", default="z", metavar="AXIS", help="x, y, z or a direction (default: z)")
    add("--size", metavar="WxH", help="pixels of the picture (default: 1024x768)")
    add("--background", metavar="R,G,B[,A]", help="linear colour behind everything")


def _add_shadows(add: Any) -> None:
    add("--technique", default="bounding_opacity_maps", metavar="NAME", help="the shadow method")
    add(
        "--param",
        action="append",
        default=[],
        metavar="K=V",
        help="a parameter of the technique; again for more (pyopacity techniques lists them)",
    )
    add("--opacity", metavar="0..1", help="of every strand, instead of the file's")
    add("--width", metavar="N", help="of every strand, instead of the file's")


def run(arguments: argparse.Namespace) -> int:
    """Everything that can be wrong is looked at before the first file is read."""
    output = check_path(arguments.output)
    if arguments.report not in (None, "-"):
        check_folder(pathlib.Path(arguments.report))
    technique = po.technique(arguments.technique, **text.assignments("--param", arguments.param))
    options = _renderer_options(arguments)
    camera = _Camera(arguments)
    light = po.DirectionalLight(_light_direction(arguments))

    scene = _load(arguments)
    scene.add(light)
    text.progress("rendering")
    start = time.perf_counter()
    with po.Renderer(scene, camera.of(scene), technique=technique, **options) as renderer:
        picture = renderer.render()
        seconds = time.perf_counter() - start
        po.save_image(output, picture)
        record = _record(renderer, output, seconds)
        table = str(renderer.report)
    text.clear_progress()
    _tell(arguments, record, table)
    return 0


def _tell(arguments: argparse.Namespace, record: dict[str, Any], table: str) -> None:
    if arguments.report not in (None, "-"):
        document = json.dumps(record, indent=2) + "\n"
        pathlib.Path(arguments.report).write_text(document, encoding="utf-8")
    if arguments.json:
        text.print_json(record)
        return
    if arguments.print_report or arguments.report == "-":
        print(table)
    width, height = record["size"]
    print(
        f"{record['image']}: {width}x{height}, {record['technique']}, "
        f"{record['seconds']:.2f} s on {record['renderer']}"
    )


def _record(renderer: po.Renderer, output: pathlib.Path, seconds: float) -> dict[str, Any]:
    technique = renderer.technique
    return {
        "image": str(output),
        "size": renderer.size,
        "technique": technique.name,
        "parameters": {p.name: getattr(technique, p.name) for p in technique.parameters},
        "seconds": seconds,
        "renderer": renderer.context.renderer,
        "is_software": renderer.context.is_software,
        "passes": [dataclasses.asdict(row) for row in renderer.report],
    }


def _load(arguments: argparse.Namespace) -> po.Scene:
    scene = po.Scene()
    for file in arguments.files:
        text.progress(f"loading {file}")
        scene.add(po.load(file))
    changes = {
        name: text.numbers(f"--{name}", given, (1,), "one number")[0]
        for name in ("opacity", "width")
        if (given := getattr(arguments, name)) is not None
    }
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


# ---- what the options say ----


def _settings() -> list[_native.Parameter]:
    """The renderer's own parameters; the size has an option, and --width is that of strands."""
    parameters = _native.RenderSettings().parameters()
    return [p for p in parameters if p.name not in ("width", "height")]


def _renderer_options(arguments: argparse.Namespace) -> dict[str, Any]:
    checked = _native.RenderSettings()
    options: dict[str, Any] = {}
    for setting in _settings():
        if (given := getattr(arguments, setting.name)) is not None:
            options[setting.name] = text.value(given)
            checked.set(setting.name, options[setting.name])
    if arguments.size is not None:
        options["size"] = text.size("--size", arguments.size)
        for name, pixels in zip(("width", "height"), options["size"], strict=True):
            checked.set(name, pixels)
    if arguments.background is not None:
        options["background"] = text.numbers(
            "--background", arguments.background, (3, 4), "R,G,B or R,G,B,A"
        )
    return options


def _light_direction(arguments: argparse.Namespace) -> Vector:
    if arguments.light is not None:
        return text.vector("--light", arguments.light, "three numbers, such as .5,.3,-.8")
    return _turned(_LIGHT_DIRECTION, text.axis("--up", arguments.up))


class _Camera:
    """The view that `--camera` and `--up` ask for, read before there is a scene."""

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
