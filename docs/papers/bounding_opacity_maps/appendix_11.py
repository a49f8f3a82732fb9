"""Tables A.11.1 to A.11.6, figures 5.2.3.5 and 5.2.3.6: the ratio that a search picks, by layers.

Generated trees and grass from above and from sideways, in the thesis's mode: its deposit, its
look-up texture, its measures on optical depth at 8 bits (`_splits.py`). Its column of one layer is
left out: one layer has no plane to place.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from bounding_opacity_maps import _splits
from common import Claim, Run, main
from common.chart import chart
from common.pictures import sheet

DIFFERENCES, CORRELATION = (f"{name}, thesis" for name in _splits.THESIS)
COUNTS, TRIED = (4, 8, 16, 32), (0.0, 0.3, 0.6, 1.0)
# Ratios of 16 and 32 layers by scene and light, of both measures.
PAPER = {
    ("tree", "above"): {DIFFERENCES: (0.4, 0.2), CORRELATION: (0.2, 0.2)},
    ("tree", "sideways"): {DIFFERENCES: (0.6, 0.2), CORRELATION: (0.3, 0.1)},
    ("grass", "above"): {DIFFERENCES: (0.9, 1.0), CORRELATION: (0.3, 0.2)},
    ("grass", "sideways"): {DIFFERENCES: (1.0, 1.0), CORRELATION: (0.8, 0.7)},
    ("dense grass", "above"): {DIFFERENCES: (1.0, 1.0), CORRELATION: (0.4, 0.3)},
    ("dense grass", "sideways"): {DIFFERENCES: (1.0, 1.0), CORRELATION: (0.9, 0.8)},
}
Ratios = dict[tuple[str, str], dict[str, tuple[float, ...]]]


def found(run: Run) -> tuple[Ratios, dict[tuple[str, str], float]]:
    """Ratios of 4, 8, 16 and 32 layers; and by how much the mean correlation of 32 layers changes
    between ratios, which is all that a search has to go by."""
    size = run.pick(512, 128, 32)
    ratios, changes = {}, {}
    for name, light, scene in _splits.scenes(
        run.pick(_splits.SCENES, _splits.SCENES, _splits.SMALLEST)
    ):
        ratios[name, light] = {
            measure: tuple(_splits.picked(scene, size, measure, count) for count in COUNTS)
            for measure in (DIFFERENCES, CORRELATION)
        }
        means = [_splits.mean_correlation(scene, size, COUNTS[-1], ratio) for ratio in TRIED]
        changes[name, light] = max(means) - min(means)
    return ratios, changes


def table(name: str, light: str, ratios: Ratios, change: float) -> Claim:
    """One of the six, by its correlations; both measures are told."""

    def told(row: dict[str, tuple[float, ...]]) -> str:
        names = ((DIFFERENCES, "differences"), (CORRELATION, "correlation"))
        return "; ".join(f"{n} {row[m][-2]:.1f}, {row[m][-1]:.1f}" for m, n in names)

    ours = ratios[name, light]
    return Claim(
        f"{name} from {light}: by correlation 32 layers have no higher ratio than 16",
        told(PAPER[name, light]),
        told(ours),
        ours[CORRELATION][-1] <= ours[CORRELATION][-2],
        "the search has next to nothing to go by",
        f"between ratios 0 and 1 the mean correlation of 32 layers changes by {change:.4f}",
    )


def differences(ratios: Ratios) -> Claim:
    """What absolute differences pick, which the engine's own form of the measure mends."""

    def mean(table: Ratios, *names: str) -> float:
        found = [v for (n, _), row in table.items() if n in names for v in row[DIFFERENCES][-2:]]
        return sum(found) / len(found)

    told = [
        f"trees {mean(table, 'tree'):.2f}, grass {mean(table, 'grass', 'dense grass'):.2f}"
        for table in (PAPER, ratios)
    ]
    return Claim(
        "absolute differences pick logarithmic splits for grass, not for trees (means)",
        *told,
        mean(ratios, "grass", "dense grass") > mean(ratios, "tree") + 0.3,
        "optical depth only grows, so the sum is that of the last layer less the first, and the "
        "table's first layer alone decides, the same on every scene (docs/accuracy.md)",
    )


def of_grass(table: Ratios, measure: str) -> list[float]:
    """Of 16 and 32 layers, from above and from sideways, grass and dense grass."""
    return [v for (name, _), row in table.items() if "grass" in name for v in row[measure][-2:]]


def lower(what: str, less: tuple[str, str], more: tuple[str, str], ratios: Ratios) -> Claim:
    """Whether one scene under a light has the lower mean ratio of 16 and 32 layers."""
    means = [[sum(t[key][CORRELATION][-2:]) / 2 for key in (less, more)] for t in (PAPER, ratios)]
    told = [f"{less[0]} from {less[1]} {a:.2f}, {more[0]} from {more[1]} {b:.2f}" for a, b in means]
    why = (
        "ratios of 32 layers differ by less than .004 in what judges them; of grass it holds with "
        "128 x 128 texels (tests/python/test_thesis_splits.py), not with the thesis's 512 x 512"
    )
    return Claim(f"{what}: a lower ratio (correlation)", *told, means[1][0] < means[1][1], why)


def trends(ratios: Ratios) -> list[Claim]:
    """What the text says of all six."""
    dense, above, sideways = ("dense grass", "above"), ("grass", "above"), ("grass", "sideways")
    spans = [
        [max(found) - min(found) for found in (of_grass(t, m) for m in (CORRELATION, DIFFERENCES))]
        for t in (PAPER, ratios)
    ]
    return [
        lower("sparser casters", above, dense, ratios),
        lower("from above, not from sideways", above, sideways, ratios),
        lower("leaves, not blades", ("tree", "sideways"), ("dense grass", "sideways"), ratios),
        Claim(
            "correlation spans more than absolute differences (grass)",
            *("{:.1f} over {:.1f}".format(*span) for span in spans),
            spans[1][0] > spans[1][1],
        ),
    ]


def claims(run: Run) -> list[Claim]:
    ratios, changes = found(run)
    charts = [
        (
            f"{measure.partition(',')[0]}, from {light}",
            chart(
                {name: (COUNTS, ratios[name, light][measure]) for name in _splits.SCENES},
                "layers",
                "split ratio",
                (0.0, 1.05),
                (330, 230),
            ),
        )
        for measure in (DIFFERENCES, CORRELATION)
        for light in _splits.LIGHTS
    ]
    run.save(sheet(charts, 2))
    tables = [table(*key, ratios, changes[key]) for key in PAPER]
    return [*tables, differences(ratios), *trends(ratios)]


if __name__ == "__main__":
    main(__file__, claims)
