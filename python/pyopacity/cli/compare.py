"""``pyopacity compare FILE... -o DIR``"""

import argparse
import dataclasses
from typing import Any

import pyopacity as po
from pyopacity import _native
from pyopacity.cli import measure_options, scene_options, text
from pyopacity.comparison import Plan, Variant, compare
from pyopacity.comparison.results import Results

# Of the renderer's settings, what the comparison itself decides.
_WITHOUT = ("map_size", "antialiasing", "compositing")


def add_to(commands: Any) -> None:
    """The command's options."""
    summary = "measure the errors of every technique on files"
    add = text.add_command(commands, "compare", run, summary).add_argument
    scene_options.add_files(add)
    measure_options.add_output(add, "index.html, results.csv, pictures")
    _add_techniques(add)
    _add_measures(add)
    scene_options.add_light_and_view(add)
    scene_options.add_strands(add)
    scene_options.add_settings(add, _WITHOUT)


def _add_techniques(add: Any) -> None:
    add(
        "--technique",
        action="append",
        default=[],
        metavar="NAME",
        help="a shadow method; again for more (default: all)",
    )
    scene_options.add_parameters(add)
    add(
        "--layers",
        default="16",
        metavar="N,...",
        help="of techniques with layers, a row for each (default: 16)",
    )
    add(
        "--map-size",
        default="512",
        metavar="N,...",
        help="texels along each side of the light's maps, or auto; a row for each (default: 512)",
    )


def _add_measures(add: Any) -> None:
    measure_options.add_device(add)
    add("--receivers", default="20000", metavar="N", help="vertices compared (default: 20000)")
    add("--seed", default="0", metavar="N", help="of their random choice (default: 0)")
    add("--samples", default="64", metavar="N", help="rays over each footprint (default: 64)")
    add(
        "--footprint",
        metavar="N",
        help="side of the square over which T by rays is averaged, in world units, the same for "
        "all maps (default: two texels of each map)",
    )
    add("--image-size", default="256x192", metavar="WxH", help="of pictures (default: 256x192)")
    add("--image-samples", default="4", metavar="N", help="n x n a pixel, 1..8 (default: 4)")


def run(arguments: argparse.Namespace) -> int:
    """Everything that can be wrong is looked at before the first file is read."""
    folder = measure_options.folder(arguments.output)
    plan = _plan(arguments)
    rows = len(plan.variants()) * len(plan.map_sizes)
    view = scene_options.View(arguments)
    lights = scene_options.lights(arguments)

    plan = dataclasses.replace(plan, device=measure_options.device(arguments))

    scene = scene_options.load(arguments)
    scene.add(lights)
    results = Results(
        folder, plan, " + ".join(arguments.files), measure_options.command("compare", arguments)
    )

    def tell(what: str) -> None:
        text.progress(f"row {len(results.rows) + 1} of {rows}: {what}")

    for result in compare(scene, view.of(scene), plan, tell):
        results.add(result)
        if not arguments.json:
            text.clear_progress()
            print(_line(result.variant, results.rows[-1]), flush=True)
    text.clear_progress()
    if arguments.json:
        text.print_json(results.rows)
    else:
        print(folder / "index.html")
    return 0


def _plan(arguments: argparse.Namespace) -> Plan:
    settings = _native.RenderSettings()
    map_sizes = tuple(_map_size(part) for part in arguments.map_size.split(","))
    for map_size in map_sizes:
        settings.set("map_size", map_size)
    image_samples = text.whole("--image-samples", arguments.image_samples, 1, 8)
    footprint = arguments.footprint
    if footprint is not None:
        footprint = text.numbers("--footprint", footprint, (1,), "one number")[0]
        if not 0.0 <= footprint < 1e18:
            raise po.ParameterError(f"--footprint {footprint} is outside 0..1e18", "choose another")
    return Plan(
        techniques=tuple(arguments.technique),
        layers=measure_options.whole_numbers("--layers", arguments.layers),
        parameters=text.assignments("--param", arguments.param),
        map_sizes=map_sizes,
        receivers=text.whole("--receivers", arguments.receivers, 1, 10**8),
        seed=text.whole("--seed", arguments.seed, 0, 2**63),
        samples=text.whole("--samples", arguments.samples, 1, 65536),
        footprint=footprint,
        image_size=scene_options.size("--image-size", arguments.image_size),
        image_samples=image_samples,
        settings=scene_options.settings(arguments, _WITHOUT),
    )


def _map_size(part: str) -> int | str:
    return part if part == "auto" else text.whole("--map-size", part, 1, 2**31 - 1)


def _line(variant: Variant, row: dict[str, Any]) -> str:
    flip = "" if row["flip"] is None else f"  FLIP {row['flip']:.4f}"
    rmse = row["image_rmse"]
    image = "" if rmse is None else f"  image {rmse:.4f}"
    return (
        f"{variant.label}, map {row['map_size']}: RMSE depth {row['depth_rmse']:.4f}  "
        f"total {row['total_rmse']:.4f}{image}{flip}  "
        f"{row['seconds']:.3f} s  {row['passes']} passes  "
        f"{row['bytes_per_texel']:.0f} bytes a texel"
    )
