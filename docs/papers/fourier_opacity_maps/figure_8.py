"""Figure 8: ringing around a thin feature: 15 coefficients, 7, and 7 of four times the opacity.

One ray through one thin feature. Ringing is the largest rise of T along the ray, which no caster
can cause. Drawn are the series as published, equation 3 of the map's own coefficients, and what the
engine makes of it, which keeps optical depth between nothing and all.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from common import Claim, Run, main, rises
from common.chart import chart
from common.pictures import sheet
from fourier_opacity_maps._rays import ASKED, exact, gaussian, rebuilt, ringing, unclamped

WIDTH, OPTICAL_DEPTH = 0.055, 0.5
CASES = {
    "15 coefficients": (15, 1.0),
    "7 coefficients": (7, 1.0),
    "7, four times the opacity": (7, 4.0),
}


def claims(run: Run) -> list[Claim]:
    charts, rings, kept = [], {}, {}
    for name, (coefficients, factor) in CASES.items():
        feature = gaussian(0.5, WIDTH, factor * OPTICAL_DEPTH)
        published, ours = (
            unclamped(feature, coefficients),
            rebuilt(feature, coefficients, margin=0.0),
        )
        rings[name], kept[name] = ringing(published), ringing(ours)
        lines = {
            "exact": (ASKED, exact(feature)),
            "Fourier, equation 3": (ASKED, published),
            "Fourier, clamped": (ASKED, ours),
        }
        charts.append((name, chart(lines, "depth", "T", (0.0, 1.2), (300, 250), dots=False)))
    run.save(sheet(charts, 3))

    def told(values: dict[str, float]) -> str:
        return ", ".join(f"{name} {value:.4f}" for name, value in values.items())

    return [
        Claim(
            "ringing: none of 15, little of 7, more of four times the opacity",
            "none, small, increased",
            f"largest rise of T: {told(rings)}",
            rises(list(rings.values())),
        ),
        Claim(
            "clamping takes ringing away",
            "some of the over-brightening (section 7.3)",
            f"largest rise of T: {told(kept)}",
            all(kept[name] <= rings[name] for name in CASES),
        ),
    ]


if __name__ == "__main__":
    main(__file__, claims)
