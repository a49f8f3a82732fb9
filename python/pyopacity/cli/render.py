"""``pyopacity render FILE... -o out.png``"""

import argparse
import dataclasses
import json
import pathlib
import time
from typing import Any

import pyopacity as po
from pyopacity._files import whole_file
from pyopacity.cli import scene_options, text
from pyopacity.image import check_folder, check_path

_OUTPUTS = ("transmittance", "depth", "coverage", "object_id")


def add_to(commands: Any) -> None:
    """The command's options."""
    add = text.add_command(commands, "render", run, "render files to one picture").add_argument
    scene_options.add_files(add)
    add("-o", "--output", required=True, metavar="PICTURE", help="the picture: .png or .npy")
    scene_options.add_light_and_view(add)
    add("--size", metavar="WxH", help="pixels of the picture (default: 1024x768)")
    add(
        "--outputs",
        metavar="NAME,...",
        help=f"arrays beside the picture, as PICTURE.NAME.npy: {', '.join(_OUTPUTS)}",
    )
    add("--technique", default="bounding_opacity_maps", metavar="NAME", help="the shadow method")
    scene_options.add_parameters(add)
    scene_options.add_strands(add)
    scene_options.add_settings(add)
    add("--report", metavar="FILE", help="write what each pass did as JSON; - prints a table")
    add("--print-report", action="store_true", help="print what each pass did as a table")


def run(arguments: argparse.Namespace) -> int:
    """Everything that can be wrong is looked at before the first file is read."""
    output = check_path(arguments.output)
    if arguments.report not in (None, "-"):
        check_folder(pathlib.Path(arguments.report))
    outputs = _outputs(arguments.outputs)
    technique = po.technique(arguments.technique, **text.assignments("--param", arguments.param))
    options = scene_options.settings(arguments)
    if arguments.size is not None:
        options["size"] = scene_options.size("--size", arguments.size)
    view = scene_options.View(arguments)
    lights = scene_options.lights(arguments)

    scene = scene_options.load(arguments)
    scene.add(lights)
    text.progress("rendering")
    start = time.perf_counter()
    with po.Renderer(scene, view.of(scene), technique=technique, **options) as renderer:
        picture = renderer.render()
        seconds = time.perf_counter() - start
        po.save_image(output, picture)
        record = _record(renderer, output, seconds)
        table = str(renderer.report)
        for name in outputs:
            po.save_image(output.with_suffix(f".{name}.npy"), renderer.image(name))
    text.clear_progress()
    _tell(arguments, record, table)
    return 0


def _outputs(given: str | None) -> list[str]:
    """What ``--outputs`` asks for, checked before anything is loaded."""
    names = [] if given is None else given.split(",")
    for name in names:
        if name not in _OUTPUTS:
            raise po.ParameterError(
                f'--outputs {given}: there is no image "{name}"',
                f"choose from {', '.join(_OUTPUTS)}",
            )
    return names


def _tell(arguments: argparse.Namespace, record: dict[str, Any], table: str) -> None:
    if arguments.report not in (None, "-"):
        with whole_file(pathlib.Path(arguments.report)) as file:
            file.write(f"{json.dumps(record, indent=2)}\n".encode())
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
