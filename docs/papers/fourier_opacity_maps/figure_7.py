"""Figure 7: an outlier apart from the main group has negligible effect on the reconstruction.

One ray, fifteen coefficients. The outlier is a thin, thin-bodied feature far behind; both rays have
the same depths. Beside it stand bounding opacity maps of as many layers, whose layers the outlier
stretches, with an even split.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from common import Claim, Run, main
from common.chart import chart
from common.scenes import along_a_ray, published, sheets
from fourier_opacity_maps._rays import ASKED, SHEETS, exact, gaussian, rebuilt, rmse

COEFFICIENTS = 15
MAIN, OUTLIER = gaussian(0.25, 0.05, 1.5), gaussian(0.85, 0.012, 0.08)
ON_MAIN = (ASKED > 0.08) & (ASKED < 0.42)


def group(z):
    """The main group alone; nothing beyond, so that a texel ends there."""
    return np.where(z < 0.45, MAIN(z), 0.0)


def with_outlier(z):
    return group(z) + np.where(np.abs(z - 0.85) < 0.05, OUTLIER(z), 0.0)


def bounded(absorption) -> np.ndarray:
    """T by bounding opacity maps, whose texel begins and ends with what casts."""
    depths = (np.arange(SHEETS) + 0.5) / SHEETS
    opacities = -np.expm1(-absorption(depths) / SHEETS)
    casts = opacities > 1e-7
    technique = published("bounding_opacity_maps", layers=COEFFICIENTS, split_ratio=0.0)
    # The engine puts depth 0 where casters begin; points are told in the world.
    return along_a_ray(technique, sheets(depths[casts], opacities[casts]), ASKED)


def claims(run: Run) -> list[Claim]:
    right, alone = exact(with_outlier), exact(group)
    found, found_alone = rebuilt(with_outlier, COEFFICIENTS), rebuilt(group, COEFFICIENTS)
    lines = {"exact": (ASKED, right), "Fourier, 15": (ASKED, found)}
    run.save(chart(lines, "depth", "T", (0.0, 1.0), dots=False))
    series = rmse(found[ON_MAIN], right[ON_MAIN]), rmse(found_alone[ON_MAIN], alone[ON_MAIN])
    layers = tuple(
        rmse(bounded(f)[ON_MAIN], T[ON_MAIN]) for f, T in ((with_outlier, right), (group, alone))
    )
    return [
        Claim(
            "the outlier's effect on the series is negligible",
            "negligible",
            f"RMSE of T on the main group {series[0]:.4f} with it, {series[1]:.4f} without",
            abs(series[0] - series[1]) < 0.005,
        ),
        Claim(
            "techniques that narrow the depths suffer from outliers",
            "can have difficulties",
            f"15 bounding layers: {layers[0]:.4f} with it, {layers[1]:.4f} without",
            layers[0] > 2.0 * layers[1],
        ),
    ]


if __name__ == "__main__":
    main(__file__, claims)
