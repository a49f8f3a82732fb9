"""The command ``pyopacity``: one file a subcommand.

Exit codes: 0; 2 bad usage or bad input (one line on standard error: what, then how to fix it); 3 no
OpenGL context; 4 out of memory; 130 interrupted.
"""

from pyopacity.cli.main import main

__all__ = ["main"]
