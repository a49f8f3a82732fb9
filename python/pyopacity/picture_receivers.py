"""Where a picture looks light up."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt


@dataclass(frozen=True, eq=False, slots=True)
class PictureReceivers:
    """What the centre of each pixel sees, top row first; from :meth:`pyopacity.Renderer.receivers`.

    Attributes:
        points: (H, W, 3) float64, world units: where the picture looks T up. On a strand that is
            its centre line. 0 where nothing is seen.
        bias: (H, W) float32, world units: the automatic bias there, the width of the strand, at
            least 1e-4 of the casters' radius (docs/accuracy.md). 0 outside ``mask``.
        mask: (H, W) bool: whether shadows can fall on what is seen there.
    """

    points: npt.NDArray[np.float64]
    bias: npt.NDArray[np.float32]
    mask: npt.NDArray[np.bool_]
