"""Figure 6: a translated absorption function, rebuilt by a piecewise constant basis and by Fourier.

One ray through smoke of two billows, seven coefficients. The picture has one translation, the
figures sixteen: how much the error at a place of the smoke changes as the smoke moves, and by how
far T = .5 is misplaced.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import numpy as np
from common import Claim, Run, main
from common.chart import chart
from common.pictures import sheet
from fourier_opacity_maps._rays import ASKED, Values, exact, gaussian, rebuilt

COEFFICIENTS = 7
BASES = {"piecewise_constant": "piecewise constant", "fourier": "Fourier"}
WITHIN = 0.12  # the part of the depths within which the smoke moves
INSIDE = (ASKED > 0.15) & (ASKED < 0.75)  # where it is, in its own frame


def smoke(moved: float = 0.0):
    """Absorption along the ray."""
    billows = (gaussian(0.32, 0.06, 1.6), gaussian(0.52, 0.08, 0.9))
    return lambda z: sum(billow(z - moved) for billow in billows)


def half_at(T: Values) -> float:
    """The depth at which half of the light is gone."""
    return float(ASKED[np.argmax(T < 0.5)])


def unsteadiness(moves: Values, basis: str) -> tuple[float, float]:
    """RMS change of the error in the smoke's own frame; RMS misplacement of T = .5."""
    errors, misplaced = [], []
    for moved in moves:
        right, found = exact(smoke(moved)), rebuilt(smoke(moved), COEFFICIENTS, basis=basis)
        errors.append(np.interp(ASKED[INSIDE] + moved, ASKED, found - right))
        misplaced.append(half_at(found) - half_at(right))
    spread = np.sqrt(np.mean(np.var(errors, axis=0)))
    return float(spread), float(np.sqrt(np.mean(np.square(misplaced))))


def claims(run: Run) -> list[Claim]:
    charts = []
    for moved in (0.0, 0.5 * WITHIN):
        lines = {"exact": (ASKED, exact(smoke(moved)))}
        for basis, name in BASES.items():
            lines[name] = (ASKED, rebuilt(smoke(moved), COEFFICIENTS, basis=basis))
        label = f"moved by {moved:g}" if moved else "where it was"
        charts.append((label, chart(lines, "depth", "T", (0.0, 1.0), (380, 260), dots=False)))
    run.save(sheet(charts, 2))
    moves = np.linspace(0.0, WITHIN, run.pick(16, 16, 3))
    found = {basis: unsteadiness(moves, basis) for basis in BASES}
    piecewise, fourier = found["piecewise_constant"], found["fourier"]
    return [
        Claim(
            "Fourier keeps its shape as smoke moves",
            "preserves location and shape of the transition",
            f"RMS change of the error of T: Fourier {fourier[0]:.4f}, piecewise constant "
            f"{piecewise[0]:.4f}",
            fourier[0] < piecewise[0],
        ),
        Claim(
            "and its place",
            "the same",
            f"RMS misplacement of T = .5: Fourier {fourier[1]:.4f}, piecewise constant "
            f"{piecewise[1]:.4f} of the depths",
            fourier[1] < piecewise[1],
        ),
    ]


if __name__ == "__main__":
    main(__file__, claims)
