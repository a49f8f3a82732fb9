"""``pyopacity techniques``"""

import argparse
from typing import Any

import pyopacity as po
from pyopacity.cli import text


def add_to(commands: Any) -> None:
    """The command's options."""
    summary = "list the shadow methods and their parameters: type, range, default"
    text.add_plugins(text.add_command(commands, "techniques", run, summary).add_argument)


def run(arguments: argparse.Namespace) -> int:
    """Prints the registry."""
    found = po.techniques()
    if arguments.json:
        text.print_json({name: _document(info) for name, info in found.items()})
        return 0
    for name, info in found.items():
        print(f"{name}\n    {info.summary}\n    Paper: {info.paper}")
        for parameter in info.parameters:
            print(f"    {parameter.name} ({parameter.range}; default {parameter.default})")
            print(f"        {parameter.doc}")
        print()
    return 0


def _document(info: po.TechniqueInfo) -> dict[str, Any]:
    return {
        "summary": info.summary,
        "paper": info.paper,
        "parameters": {
            parameter.name: {
                "type": parameter.type,
                "range": parameter.range,
                "default": parameter.default,
                "doc": parameter.doc,
            }
            for parameter in info.parameters
        },
    }
