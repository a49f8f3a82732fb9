"""Runs the scripts of all figures, and writes the tables of README.md from what they found.

    python docs/papers/run_all.py [--quick] [--only PART] [--table]

`--only` takes scripts whose path contains PART; `--table` runs none, and makes the tables of the
results that lie beside the scripts.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from itertools import groupby
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parent))
from common import script

HERE = Path(__file__).resolve().parent
PAGE = HERE / "README.md"
BEGIN, END = "<!-- made by run_all.py: begin -->", "<!-- end -->"
NAMES = {
    "opacity_shadow_maps": "Kim and Neumann 2001, Opacity Shadow Maps",
    "deep_opacity_maps": "Yuksel and Keyser 2008, Deep Opacity Maps",
    "bounding_opacity_maps": "Voicu 2011, Real-time volumetric shadows for dynamic rendering",
    "fourier_opacity_maps": "Jansen and Bavoil 2010, Fourier Opacity Mapping",
}
HEAD = "| figure | picture | what it shows | paper | ours | verdict |\n|---|---|---|---|---|---|"


def results() -> list[tuple[Path, dict[str, Any]]]:
    """What each script found last, where it has been run."""
    files = [(path, path.with_suffix(".json")) for path in script.scripts()]
    return [(path, json.loads(file.read_text("utf-8"))) for path, file in files if file.exists()]


def rows(path: Path, result: dict[str, Any]) -> list[str]:
    """A row a claim; the figure and its pictures stand in the first."""
    folder = path.parent.name
    size = "" if result["size"] == "full" else f" ({result['size']} size)"
    figure = f"[{result['figure']}]({folder}/{path.name}): {result['shows']}{size}"
    pictures = " ".join(
        f"[{i}]({folder}/{name})" for i, name in enumerate(result["pictures"], start=1)
    )
    found = []
    for claim in result["claims"]:
        cells = (claim[key].replace("|", "/") for key in ("what", "paper", "ours", "verdict"))
        found.append(f"| {figure} | {pictures} | " + " | ".join(cells) + " |")
        figure = pictures = ""
    return found


def tables() -> str:
    """One for each paper, and in front of them how many claims hold."""
    found = results()
    claims = [claim for _, result in found for claim in result["claims"]]
    held = sum(claim["holds"] for claim in claims)
    made = sorted({f"{r['machine']}, {r['date']}" for _, r in found})
    parts = [f"{held} of {len(claims)} claims of {len(found)} figures and tables hold."]
    parts.append(f"On {'; '.join(made)}. Of the papers' sizes where no other is told.")
    for folder, of_paper in groupby(found, key=lambda pair: pair[0].parent.name):
        lines = [line for path, result in of_paper for line in rows(path, result)]
        parts.append("\n".join([f"## {NAMES[folder]}\n", HEAD, *lines]))
    return "\n\n".join(parts)


def write_tables() -> None:
    before, _, rest = PAGE.read_text("utf-8").partition(BEGIN)
    after = rest.partition(END)[2]
    PAGE.write_text(f"{before}{BEGIN}\n\n{tables()}\n\n{END}{after}", "utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="scripts whose path contains this")
    parser.add_argument("--table", action="store_true", help="run none")
    script.add_size(parser)
    options = parser.parse_args()
    for path in [] if options.table else script.scripts():
        if options.only in path.relative_to(HERE).as_posix():
            start = time.perf_counter()
            script.show(script.run(path, options.size))
            print(f"  {time.perf_counter() - start:.0f} s\n", flush=True)
    write_tables()


if __name__ == "__main__":
    main()
