"""Figure 4: rendering time as a function of the number of maps.

The paper draws 340,000 lines of hair, slice by slice between two buffers of 512 x 512, and looks
every end of a line up once. Ours is demo:hair with as many segments, `buffers="two"`, and T of
every vertex. Drawn is the time over the number of maps; beside it stands the time when all maps are
kept, which newer hardware fills many at a time.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from common import Claim, Run, line_fit, main, medians_in_turns, seconds
from common.chart import chart
from common.scenes import lit, published, strands

import pyopacity as po

SLOPE, CONSTANT = 0.25, 0.09 + 2.21 + 0.24  # seconds: "about 4 maps per second", and the rest
LINEAR = 0.98  # r^2


def measure(renderer: po.Renderer, hair: po.Strands, layers: int) -> dict[str, float]:
    """Seconds for T of every vertex from nothing, and bytes that maps take."""
    renderer.technique.layers = layers
    renderer.invalidate()
    start = seconds(renderer)
    renderer.transmittance(hair)
    taken = seconds(renderer) - start
    maps = [row.bytes for row in renderer.memory() if row.name.startswith("opacity_shadow_maps/")]
    return {"seconds": taken, "bytes": float(sum(maps))}


def measured(run: Run, buffers: str, counts: tuple[int, ...]) -> dict[str, dict[str, float]]:
    scene = lit(f"demo:hair?segments={run.pick(340_000, 60_000, 3_000)}")
    hair = strands(scene)
    technique = published("opacity_shadow_maps", buffers=buffers, filter_radius=1.5)
    with po.Renderer(scene, technique=technique, map_size=run.pick(512, 256, 64)) as renderer:
        ways = {str(n): lambda n=n: measure(renderer, hair, n) for n in counts}
        return medians_in_turns(ways, run.pick(3, 2, 1))


def claims(run: Run) -> list[Claim]:
    counts = run.pick((10, 20, 40, 60, 80, 100, 150, 200), (10, 20, 40, 60, 80), (4, 8, 16))
    two, kept = measured(run, "two", counts), measured(run, "all", counts)
    slope, constant, linear = line_fit(counts, [two[str(n)]["seconds"] for n in counts])
    lines = {
        name: (counts, [found[str(n)]["seconds"] for n in counts])
        for name, found in (("two buffers, as published", two), ("all maps kept", kept))
    }
    run.save(chart(lines, "maps", "seconds"))
    few, many = str(counts[0]), str(counts[-1])
    sizes = {row["bytes"] for row in two.values()}
    grown = kept[many]["bytes"] / kept[few]["bytes"]
    return [
        Claim(
            "time is linear in the maps",
            f"linear, {SLOPE:g} s a map and {CONSTANT:.2f} s",
            f"r^2 {linear:.4f}, {slope:.4f} s a map and {constant:.2f} s",
            linear >= LINEAR,
        ),
        Claim(
            "memory does not grow with the maps",
            "two buffers, whatever N is",
            f"{max(sizes) / 2**20:.1f} MiB for {few} to {many} maps; {grown:.0f} times as much "
            "where all are kept",
            len(sizes) == 1,
        ),
    ]


if __name__ == "__main__":
    main(__file__, claims)
