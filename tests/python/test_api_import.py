"""What `import pyopacity` gives, and what it leaves alone."""

import ast
import pathlib
from collections.abc import Callable

import pytest

import pyopacity as po
from pyopacity import _native

LOOK = """
import pathlib, pyopacity
maps = pathlib.Path("/proc/self/maps").read_text()
assert "libopacity" in maps, maps
print([name for name in ("libEGL", "libGL", "libglfw", "libGLX") if name in maps])
"""


@pytest.mark.skipif(not pathlib.Path("/proc/self/maps").exists(), reason="needs Linux's /proc")
def test_import_opens_no_opengl(python: Callable[..., object]) -> None:
    result = python("-c", LOOK)
    assert (result.returncode, result.stdout.strip()) == (0, "[]"), result.stderr


def test_a_message_without_a_listener_is_not_printed(python: Callable[..., object]) -> None:
    script = "import logging, pyopacity; logging.getLogger('pyopacity').error('heard?')"
    result = python("-c", script)
    assert (result.returncode, result.stderr) == (0, "")
    assert python("-c", f"import logging; logging.basicConfig(); {script}").stderr.endswith(
        "heard?\n"
    )


def test_every_public_name_is_there_and_documented() -> None:
    assert po.__all__ == sorted(po.__all__)
    for name in po.__all__:
        assert getattr(po, name).__doc__, name


def test_version_is_three_numbers() -> None:
    assert len([int(part) for part in po.__version__.split(".")]) == 3


@pytest.mark.parametrize(
    ("error", "builtin"),
    [
        (po.ParameterError, ValueError),
        (po.FileFormatError, ValueError),
        (po.ContextError, RuntimeError),
        (po.OutOfMemoryError, MemoryError),
        (po.UnknownNameError, AttributeError),
        (po.ForkedContextError, po.ContextError),
        (po.DeviceLostError, po.ContextError),
        (po.ShaderError, po.Error),
        (po.PluginError, ImportError),
    ],
)
def test_errors_keep_what_and_fix_and_are_the_builtin_that_fits(
    error: type[po.Error], builtin: type[BaseException]
) -> None:
    raised = error("it broke", "mend it")
    assert isinstance(raised, builtin) and isinstance(raised, po.Error)
    assert (raised.what, raised.fix) == ("it broke", "mend it")
    assert str(raised) == "it broke\n  fix: mend it"


def names(cls: type) -> set[str]:
    return {name for name in vars(cls) if not name.startswith("_")}


def test_the_type_file_names_what_the_module_holds() -> None:
    typed = ast.parse(pathlib.Path(po.__file__).with_name("_native.pyi").read_text("utf-8"))
    classes = {node.name: node for node in typed.body if isinstance(node, ast.ClassDef)}
    functions = {node.name for node in typed.body if isinstance(node, ast.FunctionDef)}
    public = {name for name in vars(_native) if not name.startswith("_")}
    assert set(classes) | functions == public
    for name, node in classes.items():
        written = {entry.name for entry in node.body if isinstance(entry, ast.FunctionDef)}
        assert written - {"__init__"} == names(getattr(_native, name)), name
