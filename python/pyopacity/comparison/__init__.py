"""The three errors of every technique on a scene (docs/accuracy.md), and what shows them.

``plan`` says what is measured, ``truth`` what against, ``rows`` measures; ``page`` and ``plot``
show it, ``results`` writes it. The command is ``pyopacity compare``.
"""

from pyopacity.comparison.plan import Plan, Variant
from pyopacity.comparison.rows import Result, available_device, compare
from pyopacity.comparison.truth import DepthReference, Receivers, Truth, sample_receivers

__all__ = [
    "DepthReference",
    "Plan",
    "Receivers",
    "Result",
    "Truth",
    "Variant",
    "available_device",
    "compare",
    "sample_receivers",
]
