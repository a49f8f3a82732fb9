"""``pyopacity doctor``"""

import argparse
import os
import platform
from typing import Any

import numpy as np

import pyopacity as po
from pyopacity import _native
from pyopacity.cli import text

# What changes where OpenGL is looked for, or what it runs.
_VARIABLES = (
    "OPACITY_EGL_DEVICE",
    "OPACITY_SHADER_DIR",
    "OPACITY_GL_DEBUG",
    "OPACITY_THREADS",
    "LIBGL_ALWAYS_SOFTWARE",
)


def add_to(commands: Any) -> None:
    """The command's options."""
    summary = "tell which OpenGL this machine gives, and which package is missing"
    text.add_command(commands, "doctor", run, summary)


def run(arguments: argparse.Namespace) -> int:
    """Prints what there is; without a context, the error that says what is missing comes last."""
    document: dict[str, Any] = {
        "pyopacity": po.__version__,
        "python": platform.python_version(),
        "numpy": np.__version__,
        "system": platform.platform(),
        "variables": {name: os.environ[name] for name in _VARIABLES if name in os.environ},
        "tracers": po.trace_backends(),
        "opengl": None,
    }
    failure: po.ContextError | None = None
    try:
        document["opengl"] = _opengl(_native.Context.headless())
    except po.ContextError as error:
        failure = error
    if arguments.json:
        text.print_json(document)
    else:
        _print(document)
    if failure is not None:
        raise failure
    return 0


def _opengl(context: _native.Context) -> dict[str, Any]:
    return {
        "renderer": context.renderer,
        "version": context.version,
        "is_software": context.is_software,
        "search": context.search,
        "limits": dict(context.limits()),
    }


def _print(document: dict[str, Any]) -> None:
    for name in ("pyopacity", "python", "numpy", "system"):
        print(f"{name:10} {document[name]}")
    print(f"tracers    {', '.join(document['tracers'])}")
    for name, setting in document["variables"].items():
        print(f"{name}={setting}")
    opengl = document["opengl"]
    if opengl is None:
        print("opengl     none")
        return
    where = "in software" if opengl["is_software"] else "on the GPU"
    print(f"opengl     {opengl['version']}\nrenderer   {opengl['renderer']} ({where})")
    for name, limit in opengl["limits"].items():
        print(f"at most    {limit} {name}")
    for line in opengl["search"]:
        print(f"looked at  {line}")
