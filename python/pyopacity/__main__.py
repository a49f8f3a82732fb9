"""``python -m pyopacity`` is the command ``pyopacity``."""

from pyopacity.cli import main

raise SystemExit(main())
