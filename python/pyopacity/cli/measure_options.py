"""What `compare` and `bench` have in common: a folder, a device, and a command to do it again."""

import argparse
import pathlib
import shlex
from typing import Any, Literal

import pyopacity as po
from pyopacity import _arrays
from pyopacity.cli import text
from pyopacity.comparison import available_device

# What changes no figure.
_NOT_IN_COMMAND = ("files", "output", "json", "run")


def add_output(add: Any, what: str) -> None:
    """The folder of what is measured."""
    add("-o", "--output", required=True, metavar="DIR", help=what)


def add_device(add: Any) -> None:
    """On what to measure."""
    add(
        "--device",
        default="auto",
        metavar="NAME",
        help="gpu; cpu, which needs no OpenGL and makes no pictures; auto: gpu where there is "
        "OpenGL (default: auto)",
    )


def whole_numbers(option: str, given: str) -> tuple[int, ...]:
    """N,... each above 0."""
    return tuple(text.whole(option, part, 1, 2**31 - 1) for part in given.split(","))


def device(arguments: argparse.Namespace) -> Literal["gpu", "cpu"]:
    """What `--device` comes to, which is what the command of a row says."""
    given = arguments.device
    _arrays.choice("--device", given, ("auto", "gpu", "cpu"))
    if given != "auto":
        return "cpu" if given == "cpu" else "gpu"
    found = available_device()
    arguments.device = found
    if found == "cpu" and not arguments.json:
        print("no OpenGL here (see pyopacity doctor): T on the CPU, and no pictures", flush=True)
    return found


def folder(given: str) -> pathlib.Path:
    """Where results may go, as far as that shows before there are any."""
    folder = pathlib.Path(given)
    if folder.exists() and not folder.is_dir():
        raise po.ParameterError(f"{folder} is a file", "name a folder for the results")
    if not folder.absolute().parent.is_dir():
        raise po.ParameterError(
            f"{folder} cannot be made: there is no folder {folder.parent}",
            "make the folder first, or choose another",
        )
    return folder


def command(name: str, arguments: argparse.Namespace) -> str:
    """The command line that measures this again, without what leaves the figures as they are."""
    words = ["pyopacity", name, *arguments.files]
    for option, value in sorted(vars(arguments).items()):
        if option in _NOT_IN_COMMAND or value in (None, [], False):
            continue
        flag = f"--{option.replace('_', '-')}"
        for each in value if isinstance(value, list) else [value]:
            words.append(flag if each is True else f"{flag}={each}")
    return shlex.join(words)
