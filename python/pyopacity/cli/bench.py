"""``pyopacity bench -o DIR``"""

import argparse
import dataclasses
from typing import Any

import pyopacity as po
from pyopacity import _native, benchmark, comparison
from pyopacity.benchmark import Plan, Results, Run, Table
from pyopacity.cli import measure_options, scene_options, text

# Options, and the sections that they change.
_USED_BY = {
    "scenes": ("errors",),
    "map_size": ("errors", "P6", "goals"),
    "layers": ("errors", "P6", "goals"),
}


def add_to(commands: Any) -> None:
    """The command's options."""
    summary = "measure time against error, how costs grow, and whether the project's goals hold"
    add = text.add_command(commands, "bench", run, summary).add_argument
    add(
        "files",
        nargs="*",
        metavar="FILE",
        help=f"{text.FILES}; each a scene of its own, in the place of those of time against error; "
        "the first also of P6, P7, P11, costs and Mitsuba; all else stays on demo:hair",
    )
    measure_options.add_output(add, "index.html, results.json, a .csv for each table, plots")
    add("--quick", action="store_true", help="small scenes: minutes instead of hours")
    add(
        "--only",
        metavar="NAME,...",
        help=f"some sections: {', '.join(benchmark.SECTIONS)} (default: all)",
    )
    add(
        "--scenes",
        metavar="NAME,...",
        help="of the generated scenes of time against error, such as hair,plume (default: all)",
    )
    add("--map-size", metavar="N,...", help="texels along each side, of time against error and P6")
    add("--layers", metavar="N,...", help="of techniques that have them, as --map-size")
    measure_options.add_device(add)
    scene_options.add_strands(add)


def run(arguments: argparse.Namespace) -> int:
    """Writes every table as soon as it is there, and prints it at the end."""
    folder = measure_options.folder(arguments.output)
    only = _names("--only", arguments.only, benchmark.SECTIONS)
    _check_used(arguments, only)
    plan = _plan(arguments)
    plan = plan.on(measure_options.device(arguments))

    running = Run(plan, text.progress)
    for file in arguments.files:
        running.scene(file)  # whatever is wrong with it shows before anything is measured
    command = measure_options.command("bench", arguments)
    results = Results(folder, running.machine, command)
    for table in benchmark.measure(running, only):
        results.put(table)
    text.clear_progress()
    if arguments.json:
        text.print_json(results.document())
        return 0
    for table in results.tables.values():
        _print(table)
    print(folder / "index.html")
    return 0


def _check_used(arguments: argparse.Namespace, only: tuple[str, ...]) -> None:
    """Refuses what changes nothing of the sections that are asked for."""
    for name, sections in _USED_BY.items():
        if only and getattr(arguments, name) is not None and not set(only) & set(sections):
            option = f"--{name.replace('_', '-')}"
            raise po.ParameterError(
                f"{option} changes nothing of {', '.join(only)}",
                f"leave it out, or name what it is of: --only {' or '.join(sections)}",
            )


def _plan(arguments: argparse.Namespace) -> Plan:
    plan = benchmark.QUICK if arguments.quick else benchmark.FULL
    changes: dict[str, Any] = {"changes": scene_options.strand_changes(arguments)}
    if arguments.files:
        changes |= {"scenes": tuple(arguments.files), "hair": arguments.files[0]}
    elif changes["changes"]:
        raise po.ParameterError(
            f"--{next(iter(changes['changes']))} is of files, and there are none",
            "leave it out, or name a file",
        )
    if arguments.scenes is not None:
        changes |= {"scenes": _scenes(plan, arguments)}
    settings = _native.RenderSettings()
    if arguments.map_size is not None:
        sizes = measure_options.whole_numbers("--map-size", arguments.map_size)
        for size in sizes:
            settings.set("map_size", size)
        changes |= {"map_sizes": sizes, "large_map_sizes": sizes}
    if arguments.layers is not None:
        changes["layers"] = measure_options.whole_numbers("--layers", arguments.layers)
        comparison.Plan(layers=changes["layers"]).variants()  # refuses what none takes
    return dataclasses.replace(plan, **changes)


def _scenes(plan: Plan, arguments: argparse.Namespace) -> tuple[str, ...]:
    """Those of the plan whose demo has one of these names."""
    if arguments.files:
        raise po.ParameterError("--scenes is of generated scenes", "leave it out beside files")
    demos = {name: name.removeprefix("demo:").partition("?")[0] for name in plan.scenes}
    wanted = _names("--scenes", arguments.scenes, tuple(dict.fromkeys(demos.values())))
    return tuple(name for name, demo in demos.items() if demo in wanted)


def _names(option: str, given: str | None, known: tuple[str, ...]) -> tuple[str, ...]:
    """NAME,... each of those that there are."""
    names = tuple(given.split(",")) if given is not None else ()
    for name in names:
        if name not in known:
            raise po.ParameterError(
                f'{option} "{name}" is not known',
                f'did you mean "{_native.nearest_name(name, list(known))}"? There are '
                f"{', '.join(known)}",
            )
    return names


def _print(table: Table) -> None:
    """As a document can have it."""
    print(f"## {table.title}\n\n{' '.join(table.note.split())}\n\n{table.markdown()}\n")
