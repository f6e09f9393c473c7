"""What goes wrong, each with place, rule and value in its message."""

from __future__ import annotations

from typing import Any, Dict, List

__all__ = ["ProgramError", "SceneError", "UnsupportedScene"]


class SceneError(ValueError):
    """A scene that cannot be used.

    Attributes
    ----------
    faults : list of dict
        Every fault: ``file``, ``line`` and ``column`` (from 1, 0 where unknown), ``key`` (``"bodies[1].sphere.radius"``),
        ``rule`` and ``value``.
    """

    faults: List[Dict[str, Any]] = []


class UnsupportedScene(ValueError):
    """A valid scene with a model that no solver knows; the message names it."""


class ProgramError(RuntimeError):
    """The program ``slipcheck`` could not do what it was asked.

    Attributes
    ----------
    exit_code : int
        2 bad input, 4 the results could not be written, 130 interrupted.
    """

    def __init__(self, message: str, exit_code: int) -> None:
        super().__init__(message)
        self.exit_code = exit_code
