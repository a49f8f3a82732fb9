"""What the scripts of this folder share: scenes, times in turns, pictures, charts, verdicts."""

from common.claims import Claim, in_same_order, line_fit, rises
from common.script import Run, main
from common.timing import frame_cost, medians_in_turns, seconds

__all__ = [
    "Claim",
    "Run",
    "frame_cost",
    "in_same_order",
    "line_fit",
    "main",
    "medians_in_turns",
    "rises",
    "seconds",
]
