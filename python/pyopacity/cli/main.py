"""Subcommands, and what becomes of an error."""

import argparse
import contextlib
import logging
import os
import sys
from collections.abc import Iterator, Sequence
from typing import NoReturn

import pyopacity as po
from pyopacity._cmake import cmake_dir
from pyopacity.cli import bench, compare, doctor, info, render, stress, techniques, tune
from pyopacity.cli.text import clear_progress

INTERRUPTED = 130


class Parser(argparse.ArgumentParser):
    """An ArgumentParser whose complaints are errors like all others."""

    def error(self, message: str) -> NoReturn:
        raise po.ParameterError(message, f"{self.prog} --help tells what there is")


class PrintCmakeDir(argparse.Action):
    """Prints :func:`cmake_dir` and ends. Unlike action="version", it never wraps a long path."""

    def __init__(self, option_strings: Sequence[str], dest: str, help: str) -> None:
        super().__init__(option_strings, dest=argparse.SUPPRESS, nargs=0, help=help)

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        print(cmake_dir())
        parser.exit()


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs a command line, by default this process's, and returns its exit code."""
    try:
        parsed = _parser().parse_args(_joined(sys.argv[1:] if arguments is None else arguments))
        for plugin in getattr(parsed, "plugin", []):
            po.load_plugin(plugin)
        with _warnings_of_files():
            return int(parsed.run(parsed))
    except KeyboardInterrupt:
        clear_progress()
        return INTERRUPTED
    except BrokenPipeError:  # the reader, such as `head`, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except (po.Error, MemoryError, OSError) as error:
        clear_progress()
        print(f"pyopacity: {_one_line(_typed(error))}", file=sys.stderr)
        return _exit_code(error)


@contextlib.contextmanager
def _warnings_of_files() -> Iterator[None]:
    """Tells on standard error what a model lacks, such as a picture."""
    logger, handler = logging.getLogger("pyopacity.io"), logging.StreamHandler()
    handler.setFormatter(logging.Formatter("pyopacity: %(message)s"))
    logger.addHandler(handler)
    try:
        yield
    finally:
        logger.removeHandler(handler)


def _parser() -> Parser:
    parser = Parser(prog="pyopacity", description=po.__doc__.partition("\n")[0])
    parser.add_argument("--version", action="version", version=f"pyopacity {po.__version__}")
    parser.add_argument(
        "--cmake-dir", action=PrintCmakeDir, help="print the folder for cmake -Dopacity_DIR="
    )
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for command in (render, compare, bench, stress, tune, techniques, info, doctor):
        command.add_to(commands)
    return parser


def _joined(arguments: Sequence[str]) -> list[str]:
    """`--light -1,0,0` as `--light=-1,0,0`: argparse takes "-1,0,0" for an option."""
    joined: list[str] = []
    for argument in arguments:
        is_negative = argument[:1] == "-" and argument[1:2] in tuple("0123456789.")
        if is_negative and joined and joined[-1].startswith("--") and "=" not in joined[-1]:
            joined[-1] += f"={argument}"
        else:
            joined.append(argument)
    return joined


def _typed(error: Exception) -> po.Error:
    if isinstance(error, po.Error):
        return error
    if isinstance(error, MemoryError):
        return po.OutOfMemoryError("no memory is left", "render a smaller scene, map or picture")
    return po.Error(str(error), "look at the path, its permissions and the room on its disk")


def _one_line(error: po.Error) -> str:
    return " ".join(f"{error.what}; fix: {error.fix}".split())


def _exit_code(error: Exception) -> int:
    if isinstance(error, MemoryError):
        return 4
    return 3 if isinstance(error, po.ContextError) else 2
