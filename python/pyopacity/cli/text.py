"""What commands read from the command line as text, and how they write for people and programs."""

import argparse
import json
import sys
from collections.abc import Callable, Iterable
from typing import Any

from pyopacity import ParameterError, _native

# What po.load takes.
FILES = (
    ".hair, .obj, .gltf, .glb, .ply, .nrrd, or a generated scene, demo:NAME, where NAME is "
    f"{', '.join(_native.demo_names())}"
)

Vector = tuple[float, float, float]

_AXES: dict[str, Vector] = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


def add_command(
    commands: Any, name: str, run: Callable[[argparse.Namespace], int], summary: str
) -> argparse.ArgumentParser:
    """A subcommand with what all of them have: a summary, what runs it, and ``--json``."""
    sentence = f"{summary[0].upper()}{summary[1:]}."
    parser: argparse.ArgumentParser = commands.add_parser(name, help=summary, description=sentence)
    parser.set_defaults(run=run)
    parser.add_argument("--json", action="store_true", help="print the result as JSON")
    return parser


def add_plugins(add: Any) -> None:
    """Plugins, which are loaded before the command runs."""
    add(
        "--plugin",
        action="append",
        default=[],
        metavar="PATH",
        help="a shared library with techniques of its own; again for more (docs/plugins.md)",
    )


def numbers(option: str, text: str, counts: tuple[int, ...], example: str) -> tuple[float, ...]:
    """Numbers with commas between them, as many as one of ``counts``."""
    try:
        values = tuple(float(part) for part in text.split(","))
    except ValueError:
        values = ()
    if len(values) not in counts:
        raise ParameterError(f'{option} "{text}" is not understood', f"write {example}")
    return values


def vector(option: str, text: str, example: str) -> Vector:
    """x,y,z"""
    x, y, z = numbers(option, text, (3,), example)
    return x, y, z


def axis(option: str, text: str) -> Vector:
    """A direction: x, y or z, or three numbers."""
    return _AXES.get(text.lower()) or vector(option, text, "x, y or z, or a direction: 0,1,0")


def size(option: str, text: str) -> tuple[int, int]:
    """WIDTHxHEIGHT"""
    width, _, height = text.lower().partition("x")
    if not (width.isdecimal() and height.isdecimal() and len(text) < 20):
        raise ParameterError(
            f'{option} "{text}" is not understood', "write WIDTHxHEIGHT, such as 1024x768"
        )
    return int(width), int(height)


def whole(option: str, text: str, low: int, high: int) -> int:
    """A whole number of a range."""
    number = int(text) if text.isdecimal() and len(text) < 20 else None
    if number is None or not low <= number <= high:
        raise ParameterError(
            f'{option} "{text}" is not a whole number in {low}..{high}', "choose one"
        )
    return number


def value(text: str) -> bool | int | float | str:
    """What a parameter's value most plainly says: true, 8, .5, a word."""
    if text.lower() in ("true", "false"):
        return text.lower() == "true"
    for convert in (int, float):
        try:
            return convert(text)
        except ValueError:
            continue
    return text


def assignments(option: str, pairs: Iterable[str]) -> dict[str, bool | int | float | str]:
    """name=value, any number of times."""
    found = {}
    for pair in pairs:
        name, equals, text = pair.partition("=")
        if not (name and equals and text):
            raise ParameterError(f'{option} "{pair}" is not understood', "write name=value")
        found[name] = value(text)
    return found


def print_json(document: Any) -> None:
    """One document for programs."""
    print(json.dumps(document, indent=2))


def progress(text: str) -> None:
    """Says what is being done, on a terminal; the next call overwrites it."""
    if sys.stderr.isatty():
        print(f"\r\x1b[K{text}", end="", file=sys.stderr, flush=True)


def clear_progress() -> None:
    """Leaves the line empty for what comes next."""
    progress("")
