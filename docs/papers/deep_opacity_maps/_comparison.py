"""What figures 1, 3 and 5 have in common: one hair, five ways, pictures and frames a second."""

from collections.abc import Mapping

from common import Claim, Run, frame_cost, in_same_order, medians_in_turns
from common.pictures import picture, sheet
from common.scenes import lit, published, renderer, seen, strands

import pyopacity as po

NONE, DEEP, CLUSTERS = "no shadows", "DOM, 3 layers", "density clustering, 4 layers"
SLACK = 0.1  # of what is timed
LIT = 0.95  # T of what no caster shades, but for a strand at its side


def slices(layers: int) -> str:
    return f"OSM, {layers} layers"


def ways(few: int, many: int) -> dict[str, po.Technique]:
    """As published: the layers of deep opacity maps have sizes that are given, not searched."""
    return {
        NONE: po.technique("unshadowed"),
        slices(few): published("opacity_shadow_maps", layers=few),
        slices(many): published("opacity_shadow_maps", layers=many),
        CLUSTERS: published("density_clustering", clusters=4),
        DEEP: published("deep_opacity_maps", layers=3, packing="4n-1"),
    }


def fixed_extent(scene: po.Scene) -> float:
    """World units from the first caster to the end of the layers: a third of the hair's height."""
    box = po.Bounds.union(shape.bounds for shape in scene.shapes if isinstance(shape, po.Strands))
    return float(max(box.max - box.min)) / 3.0


def compared(
    run: Run, scene: po.Scene, view: po.Camera, fps: Mapping[str, float], few: int, many: int
) -> list[Claim]:
    """Pictures of all ways; errors of T where they look it up; times of their frames.

    Args:
        fps: of the paper, by way.
    """
    size, map_size = run.pick((250, 300), (250, 300), (50, 60)), run.pick(512, 256, 64)
    techniques = ways(few, many)
    techniques[DEEP].layer_extent = fixed_extent(scene)
    shown, error = [], {}
    with renderer(scene, view, size, map_size, technique="exact") as used:
        points = seen(used)
        exact = used.transmittance(points)
        for name, technique in techniques.items():
            used.technique = technique
            shown.append((name, picture(used.render())))
            found = used.transmittance(points)
            lit = exact > LIT
            error[name] = po.metrics.rmse(found[lit], exact[lit])
        used.technique = "exact"
        shown.append(("exact lists", picture(used.render())))
    run.save(sheet(shown, 3))
    return [*errors(error, few, many), *times(run, scene, view, techniques, fps, map_size)]


def hair(
    run: Run,
    style: str,
    segments: int,
    color: tuple[float, float, float],
    fps: Mapping[str, float],
) -> list[Claim]:
    """:func:`compared` on demo:hair of a style, with as many segments as in the paper."""
    scene = lit(f"demo:hair?style={style}&segments={run.pick(segments, 60_000, 3_000)}")
    strands(scene).color = color
    return compared(run, scene, po.Camera.fit(strands(scene)), fps, 8, 256)


def errors(error: Mapping[str, float], few: int, many: int) -> list[Claim]:
    """Claims about where light arrives unshaded, the first to show layers."""
    told = ", ".join(f"{name} {error[name]:.3f}" for name in error if name != NONE)
    return [
        Claim(
            f"{few} slices show as bands, {many} far less",
            "severe artefacts, then slight or none",
            f"RMSE of T where nothing shades: {told}",
            error[slices(few)] > 2.0 * error[slices(many)],
        ),
        Claim(
            "three deep layers show no bands where light arrives",
            "free of artefacts; clustering noisier",
            f"the same: {error[DEEP]:.3f}, {CLUSTERS} {error[CLUSTERS]:.3f}",
            error[DEEP] < min(error[slices(few)], error[CLUSTERS]),
        ),
    ]


def times(
    run: Run,
    scene: po.Scene,
    view: po.Camera,
    techniques: Mapping[str, po.Technique],
    fps: Mapping[str, float],
    map_size: int,
) -> list[Claim]:
    """Claims about what shadows cost beyond a frame without: in order, and as ratios to three
    deep layers."""
    size = run.pick((1024, 768), (512, 384), (60, 40))
    cost = {}
    with renderer(scene, view, size, map_size, antialiasing=1) as used:

        def frame(technique: po.Technique) -> dict[str, float]:
            used.technique = technique
            return frame_cost(used)

        measured = medians_in_turns(
            {name: lambda way=way: frame(way) for name, way in techniques.items()},
            run.pick(3, 2, 1),
        )
    bare = measured[NONE]["frame"]
    for name in techniques:
        if name != NONE:
            cost[name] = measured[name]["frame"] - bare
    paper = {name: 1.0 / fps[name] - 1.0 / fps[NONE] for name in cost}
    ratios = {name: value / cost[DEEP] for name, value in cost.items()}
    of_paper = {name: value / paper[DEEP] for name, value in paper.items()}
    return [
        Claim(
            f"order of what shadows cost (to {100 * SLACK:.0f} %), over three deep layers",
            ", ".join(f"{name} {value:.2f}" for name, value in of_paper.items()),
            ", ".join(f"{name} {value:.2f}" for name, value in ratios.items())
            + f"; three deep layers take {cost[DEEP]:.0f} ms of a frame",
            in_same_order(of_paper, ratios, SLACK),
            note="here a pass fills 32 slices, there one where there are more than 16",
        )
    ]
