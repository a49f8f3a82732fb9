"""Print what .venv needs, from pyproject.toml: to build, to run, to test, to check."""

import pathlib
import tomllib

root = pathlib.Path(__file__).parent.parent
pyproject = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))
project = pyproject["project"]
extras = project["optional-dependencies"]
requirements = [
    *pyproject["build-system"]["requires"],
    *project["dependencies"],
    *extras["compare"],
    *extras["papers"],
    *extras["test"],
    *extras["dev"],
]
print("\n".join(r for r in requirements if not r.startswith(f"{project['name']}[")))
