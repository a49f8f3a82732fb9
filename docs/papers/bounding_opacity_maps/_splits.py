"""The ratios of the tables A.11.1 to A.11.6 and 5.2.3.1 of the thesis, on generated scenes.

    python docs/papers/bounding_opacity_maps/_splits.py [--map-size 256] > table.md

In the paper's mode: its deposit, its look-up texture, linear interpolation, and its two measures on
optical depth at 8 bits over all texels; beside them our forms of both measures in our mode. Prints
the tables of docs/accuracy_tables.md. Maps of the CPU.
"""

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from common.scenes import ABOVE, SIDEWAYS

import pyopacity as po

MAPS = "bounding_opacity_maps"
LIGHTS = {"above": ABOVE, "sideways": SIDEWAYS}
SCENES = {
    "tree": "demo:tree?leaves=10000",
    "grass": "demo:grass?segments=20000",
    "dense grass": "demo:dense_grass?segments=100000",
}
SMALLEST = {
    "tree": "demo:tree?leaves=300",
    "grass": "demo:grass?segments=1000",
    "dense grass": "demo:dense_grass?segments=3000",
}
# Of a leaf or a blade. In 8 bits an optical depth of 1 is all, so that the scenes' own opacities
# leave nothing to compare.
OPACITY = 0.1
PAPER = {
    "deposit_rule": "paper",
    "paper_lut": True,
    "interpolation": "linear",
    "own_correction": False,
    "filter": "pcf",
    "filter_radius": 2.0,
}
THESIS = ("sum of absolute differences", "correlation")
MEASURES = {
    "sum of absolute differences, thesis": ("paper_absolute_difference", PAPER),
    "correlation, thesis": ("paper_correlation", PAPER),
    "absolute differences, ours": ("absolute_difference", {}),
    "correlation, ours": ("correlation", {}),
}


def maps(scene: po.Scene, map_size: int, **parameters: Any) -> po.Renderer:
    """A renderer whose maps have been drawn."""
    technique = po.technique(MAPS, **parameters)
    renderer = po.Renderer(scene, technique=technique, device="cpu", map_size=map_size)
    renderer.transmittance(np.zeros((1, 3)))
    return renderer


def picked(scene: po.Scene, map_size: int, measure: str, layers: int) -> float:
    """The ratio that a search finds."""
    similarity, mode = MEASURES[measure]
    with maps(scene, map_size, layers=layers, similarity=similarity, **mode) as renderer:
        note = next(row.note for row in renderer.report if row.name == f"{MAPS}/split_search")
    return float(note.rpartition(" ")[2])


def in_8_bits(optical_depth: np.ndarray) -> np.ndarray:
    return np.rint(255.0 * np.minimum(optical_depth.astype(np.float64), 1.0))


def mean_correlation(scene: po.Scene, map_size: int, layers: int, ratio: float) -> float:
    """Of neighbouring layers, as the thesis reads them: in two passes over float64."""
    mode = {**PAPER, "layers": layers, "split": "hybrid", "split_ratio": ratio}
    with maps(scene, map_size, **mode) as renderer:
        read = renderer.read(f"{MAPS}/opacity")  # (targets, H, W, 4)
    images = in_8_bits(np.moveaxis(read, -1, 1).reshape(-1, read.shape[1] * read.shape[2]))
    pairs = zip(images[: layers - 1], images[1:layers], strict=True)
    found = [1.0 if a.std() == 0.0 or b.std() == 0.0 else np.corrcoef(a, b)[0, 1] for a, b in pairs]
    return float(np.mean(found))


def scenes(of: dict[str, str] | None = None) -> Iterator[tuple[str, str, po.Scene]]:
    """Name, light and scene of each table."""
    for name, file in (of or SCENES).items():
        for light, direction in LIGHTS.items():
            scene = po.Scene(po.load(file), po.DirectionalLight(direction))
            for shape in scene.shapes:
                shape.casts = not (isinstance(shape, po.Mesh) and shape.opaque)
                if shape.casts:
                    shape.opacity = OPACITY
            yield name, light, scene


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--map-size", type=int, default=256)
    size = parser.parse_args().map_size
    counts = (4, 8, 16, 32)
    print(f"| scene, {size}^2 | light | measure | " + " | ".join(map(str, counts)) + " |")
    print("|---|---|---|" + "---|" * len(counts))
    for name, light, scene in scenes():
        for measure in MEASURES:
            ratios = (f"{picked(scene, size, measure, count):.1f}" for count in counts)
            print(f"| {name} | {light} | {measure} | " + " | ".join(ratios) + " |", flush=True)
        for ratio in (0.0, 1.0):
            found = (f"{mean_correlation(scene, size, count, ratio):.2f}" for count in counts)
            row = f"| {name} | {light} | mean correlation at ratio {ratio:.0f}, thesis | "
            print(row + " | ".join(found) + " |", flush=True)


if __name__ == "__main__":
    main()
