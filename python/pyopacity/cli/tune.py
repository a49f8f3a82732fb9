"""``pyopacity tune FILE...``"""

import argparse
import dataclasses
from typing import Any

import pyopacity as po
from pyopacity.cli import scene_options, text
from pyopacity.comparison import available_device
from pyopacity.tuning import LayerChoice, LayerTrial


def add_to(commands: Any) -> None:
    """The command's options."""
    summary = "choose the number of layers for a frame time or an error"
    add = text.add_command(commands, "tune", run, summary).add_argument
    scene_options.add_files(add)
    add("--budget-ms", metavar="MS", help="the most that a frame may take, everything moving")
    add("--error", metavar="RMSE", help="the most that T may be off from the exact lists")
    add("--frames", default="9", metavar="N", help="frames of the flight (default: 9)")
    add("--size", metavar="WxH", help="pixels of the picture (default: 1024x768)")
    add(
        "--device",
        default="auto",
        choices=("auto", "gpu", "cpu"),
        help="auto: gpu where there is OpenGL (default)",
    )
    scene_options.add_light_and_view(add)
    add("--technique", default="bounding_opacity_maps", metavar="NAME", help="one with layers")
    scene_options.add_parameters(add)
    scene_options.add_strands(add)
    scene_options.add_settings(add)


def run(arguments: argparse.Namespace) -> int:
    """Prints every trial as it is made, then the choice."""
    technique = po.technique(arguments.technique, **text.assignments("--param", arguments.param))
    budgets = {
        name: text.numbers(f"--{name.replace('_', '-')}", given, (1,), "one number")[0]
        for name in ("budget_ms", "error")
        if (given := getattr(arguments, name)) is not None
    }
    if len(budgets) != 1:
        raise po.ParameterError("tune takes one budget", "give --budget-ms, or --error")
    frames = text.whole("--frames", arguments.frames, 1, 1000)
    options = scene_options.settings(arguments)
    if arguments.size is not None:
        options["size"] = scene_options.size("--size", arguments.size)
    view, lights = scene_options.View(arguments), scene_options.lights(arguments)
    device = available_device() if arguments.device == "auto" else arguments.device

    scene = scene_options.load(arguments)
    scene.add(lights)
    text.clear_progress()
    tell = (lambda trial: None) if arguments.json else _print
    with po.Renderer(
        scene, view.of(scene), technique=technique, device=device, **options
    ) as renderer:
        choice = po.tune(renderer, frames=frames, progress=tell, **budgets)
    _tell(arguments, choice)
    return 0


def _print(trial: LayerTrial) -> None:
    cost = f"{trial.ms:8.1f} ms" if trial.error is None else f"error {trial.error:.4f}"
    print(
        f"{trial.layers:4d} layers  {cost}  {'fits' if trial.fits else 'does not fit'}", flush=True
    )


def _tell(arguments: argparse.Namespace, choice: LayerChoice) -> None:
    if arguments.json:
        text.print_json(dataclasses.asdict(choice))
        return
    what = f"--technique {arguments.technique} --param layers={choice.layers}"
    print(what if choice.fits else f"nothing fits; nearest: {what}")
