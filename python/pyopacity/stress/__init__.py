"""Inputs that break numbers, with their right answers: what ``pyopacity stress`` runs.

``way`` says how T is asked for, ``bench`` asks, ``case`` is an input with a right answer and a
tolerance; a file for each family of cases holds these. ``suite`` judges all of them, and
``exceptions`` is what cannot hold by a technique's nature. ``oracle`` is a deposit and look-up in
float64 that shares no code with the engine.
"""

from pyopacity.stress.bench import Bench
from pyopacity.stress.case import Case, Finding
from pyopacity.stress.exceptions import EXCEPTIONS, NamedException
from pyopacity.stress.suite import CASES, Verdict, chosen, judge, run
from pyopacity.stress.way import Way, ways

__all__ = [
    "CASES",
    "EXCEPTIONS",
    "Bench",
    "Case",
    "Finding",
    "NamedException",
    "Verdict",
    "Way",
    "chosen",
    "judge",
    "run",
    "ways",
]
