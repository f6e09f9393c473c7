"""Slipcheck in Python: run the program, read its results into pandas and xarray, and ask the reference without a process.

>>> import slipcheck
>>> results = slipcheck.run("scenarios/symmetric-30cms.yaml", phases=64)   # needs the program
>>> table = results.table()                                                # one long pandas table
>>> solution = slipcheck.Scene("scenarios/symmetric-30cms.yaml").solve()    # needs the compiled module
>>> solution["i-j.effective_restitution"]
0.35714285714285715
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .errors import ProgramError, SceneError, UnsupportedScene
from .program import bundled_scene, program_path, run
from .results import Results
from .store import Store

if TYPE_CHECKING:
    from .reference import Collisions, Scene, Solution, Value

__version__ = "0.1.0"
__all__ = ["Collisions", "ProgramError", "Results", "Scene", "SceneError", "Solution", "Store", "UnsupportedScene", "Value",
           "bundled_scene", "program_path", "run"]


def __getattr__(name: str) -> Any:
    # Of the compiled module, which a pure Python wheel has not.
    if name in ("Collisions", "Scene", "Solution", "Value"):
        from . import reference
        return getattr(reference, name)
    raise AttributeError(f"module 'slipcheck' has no attribute {name!r}")
