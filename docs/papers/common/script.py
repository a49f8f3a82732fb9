"""How a script of a figure runs: its sizes, where its pictures go, and what it prints and keeps."""

from __future__ import annotations

import argparse
import datetime
import importlib.util
import json
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import TypeVar

from PIL import Image

import pyopacity as po
from common.claims import Claim
from common.pictures import save

PAPERS = Path(__file__).resolve().parents[1]
SIZES = ("full", "quick", "smallest")
T = TypeVar("T")


@dataclass
class Run:
    """One run of a script.

    Attributes:
        size: "full" has the paper's sizes, "quick" takes a minute, "smallest" is for tests.
        folder: where pictures go.
        name: of the script, and of its pictures.
        pictures: that were saved.
    """

    size: str
    folder: Path
    name: str
    pictures: list[str] = field(default_factory=list)

    def pick(self, full: T, quick: T, smallest: T) -> T:
        """What fits the size of this run."""
        return (full, quick, smallest)[SIZES.index(self.size)]

    def save(self, picture: Image.Image, part: str = "") -> None:
        """As a PNG with a palette, named after the script and a part of it."""
        file = f"{self.name}_{part}.png" if part else f"{self.name}.png"
        save(self.folder / file, picture)
        self.pictures.append(file)


def scripts() -> list[Path]:
    """Of all figures, by paper."""
    found = [path for path in PAPERS.glob("*/*.py") if path.parent.name != "common"]
    return sorted(path for path in found if not path.name.startswith("_"))


def load(path: Path) -> ModuleType:
    """The module of a script, under a name of its own."""
    name = f"papers.{path.parent.name}.{path.stem}"
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses look themselves up
    spec.loader.exec_module(module)
    return module


def title(module: ModuleType) -> tuple[str, str]:
    """The figure's name in its paper, and what it shows: the docstring's first line."""
    name, _, shows = (module.__doc__ or "").splitlines()[0].rstrip(".").partition(": ")
    return name, shows


def machine() -> str:
    """What draws, and on how many cores."""
    try:
        with po.Renderer(po.Scene(), size=(8, 8)) as renderer:
            device = renderer.device
    except po.ContextError:  # some figures need none
        device = "no OpenGL"
    return f"{device}, {len(os.sched_getaffinity(0))} cores"


def run(path: Path, size: str, out: Path | None = None) -> dict[str, object]:
    """Runs a script, and keeps what it found beside its pictures, as JSON."""
    module = load(path)
    folder = out or path.parent
    folder.mkdir(parents=True, exist_ok=True)
    made = Run(size, folder, path.stem)
    claims: list[Claim] = module.claims(made)
    figure, shows = title(module)
    result: dict[str, object] = {
        "figure": figure,
        "shows": shows,
        "size": size,
        "machine": machine(),
        "date": datetime.date.today().isoformat(),
        "pictures": made.pictures,
        "claims": [
            {
                "what": c.what,
                "paper": c.paper,
                "ours": c.ours,
                "holds": bool(c.holds),
                "verdict": c.verdict,
            }
            for c in claims
        ],
    }
    text = json.dumps(result, indent=1, ensure_ascii=False)
    (folder / f"{path.stem}.json").write_text(text + "\n", "utf-8")
    return result


def show(result: dict[str, object]) -> None:
    """Paper, ours and verdict, a claim a line."""
    print(f"{result['figure']}: {result['shows']}  [{result['size']}; {result['machine']}]")
    for claim in result["claims"]:  # type: ignore[attr-defined]
        print(f"- {claim['what']}: paper {claim['paper']} | ours {claim['ours']}")
        print(f"  {claim['verdict']}", flush=True)


def add_size(parser: argparse.ArgumentParser) -> None:
    """Its options for how much is done."""
    sizes = parser.add_mutually_exclusive_group()
    sizes.add_argument("--quick", dest="size", action="store_const", const="quick")
    sizes.add_argument("--smallest", dest="size", action="store_const", const="smallest")
    parser.set_defaults(size="full")


def main(file: str, claims: Callable[[Run], list[Claim]]) -> None:
    """What a script does when it is run by itself."""
    parser = argparse.ArgumentParser(description=sys.modules[claims.__module__].__doc__)
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.add_argument("-o", dest="out", type=Path, help="folder of pictures and results")
    add_size(parser)
    options = parser.parse_args()
    show(run(Path(file).resolve(), options.size, options.out))
