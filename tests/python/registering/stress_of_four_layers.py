"""The stress suite, asked of the example of docs/plugins.md alone; run with ``-p
registering.four_layers``."""

import pytest

from pyopacity.stress import CASES, Bench, Case, judge

# What four layers of even depth, that end before the last caster, cannot hold.
BY_NATURE = {
    "receivers_on_the_planes": "its planes lie elsewhere",
    "two_clusters_far_apart": "the second lies behind its layers",
    "directional_range": "so does the far caster",
    "point_range": "so does the far caster",
    "light_inside": "layers begin anew around the light",
    "finer": "layers move with the first depth of a texel",
    "scaled": "layers have a depth in the world",
}
OF_OTHERS = {"auto_is_near_the_best"}  # asks `auto`


def marked(case: Case) -> object:
    why = BY_NATURE.get(case.name)
    marks = [pytest.mark.xfail(reason=why, strict=True)] if why else []
    return pytest.param(case, id=case.name, marks=marks)


@pytest.mark.parametrize(
    "case", [marked(c) for c in CASES if not c.is_slow and c.name not in OF_OTHERS]
)
def test_holds(case: Case) -> None:
    with Bench(["gpu"], on_gpu=["four_layers"]) as bench:
        verdicts = judge(case, bench)
    if not any(str(verdict.worst.way) == "gpu four_layers" for verdict in verdicts):
        pytest.skip("asks nothing of a technique")
    for verdict in verdicts:
        assert verdict.verdict == "holds", f"{verdict.worst.error:.3g}, {verdict.worst.got}"
