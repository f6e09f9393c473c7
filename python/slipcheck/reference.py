"""The reference without a process: scenes, observables and trajectories as numpy arrays.

Needs the compiled module of a wheel or of Debian's ``python3-slipcheck``; where that is missing, importing this raises
ImportError, and the rest of the package works.
"""

from __future__ import annotations

import json
import math
import os
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, NamedTuple, Optional, Sequence, Union

import numpy
from numpy.typing import ArrayLike, NDArray

try:
    from . import _reference
except ImportError as missing:
    raise ImportError("slipcheck.reference needs the package's compiled module, which a pure Python wheel has not: "
                      f"see docs/python.md ({missing})") from missing

if TYPE_CHECKING:
    import xarray

__all__ = ["Collisions", "Scene", "Solution", "Value"]

Array = NDArray[numpy.float64]


class Value(NamedTuple):
    """A number of the reference and how uncertain it is, in the same SI unit."""

    value: float
    uncertainty: float


class Solution(NamedTuple):
    """What the reference says of a scene."""

    solver: str  #: ``event``, ``contact`` or ``steps``
    observables: Dict[str, Value]  #: by full name, ``"i.sliding_time"`` (docs/observables.md) [SI]
    closed_form: Dict[str, float]  #: the same from a formula, where one applies [SI]
    end_time: float  #: [s]
    reached: bool  #: whether the run came to what the scene's ``run`` asks for
    failed: bool  #: it has no result; ``reason`` says why
    reason: str
    first_contact: float  #: time of the first collision or landing [s], maybe infinite
    collisions: int
    events: int
    steps: int
    cpu_seconds: float
    warnings: List[str]

    def __getitem__(self, observable: Any) -> Any:
        """The value of an observable by its name, and as of any tuple the field of that number."""
        if isinstance(observable, str):
            return self.observables[observable].value
        return tuple.__getitem__(self, observable)


class Collisions(NamedTuple):
    """Collisions of two bodies, each an array of the shape of the speeds."""

    normal_restitution: Array  #: ε^N = −g_N'/g_N [-]
    tangential_restitution: Array  #: ε^T = g_T'/g_T at the contact point [-]
    duration: Array  #: [s]; 0 of hard contacts
    energy_change: Array  #: kinetic, after minus before [J], <= 0


class Scene:
    """A scene, read and compiled once.

    Parameters
    ----------
    scene
        A file, or a dict of what a file says (docs/scenario-format.md). Quantities may carry units.

    Raises
    ------
    SceneError
        With every fault of the scene.
    UnsupportedScene
        A model that no solver knows.
    """

    def __init__(self, scene: Union[str, "os.PathLike[str]", Mapping[str, Any]]) -> None:
        if isinstance(scene, Mapping):
            self._scene = _reference.LoadedScene.parse(json.dumps(scene), str(scene.get("name", "scene")))
        else:
            self._scene = _reference.LoadedScene.load(os.fspath(scene))

    @classmethod
    def parse(cls, text: str, name: str = "scene") -> "Scene":
        """A scene from the text of a file; ``name`` stands for the file in messages."""
        made = cls.__new__(cls)
        made._scene = _reference.LoadedScene.parse(text, name)
        return made

    def __repr__(self) -> str:
        return f"<slipcheck.Scene {self.name!r}: {len(self.bodies)} bodies, {self.solver}>"

    @property
    def name(self) -> str:
        return self._scene.name

    @property
    def bodies(self) -> List[str]:
        """Names, in the order of all arrays."""
        return self._scene.bodies

    @property
    def solver(self) -> str:
        """``event``, ``contact`` or ``steps``."""
        return self._scene.solver

    @property
    def warnings(self) -> List[str]:
        """Where a law leaves the range in which it holds."""
        return self._scene.warnings

    @property
    def radius(self) -> Array:
        """Of each body [m]; shape (bodies,)."""
        return self._scene.radius

    @property
    def mass(self) -> Array:
        """Of each body [kg]; shape (bodies,)."""
        return self._scene.mass

    @property
    def position(self) -> Array:
        """Centres at the start [m]; shape (bodies, 3)."""
        return self._scene.position

    @property
    def velocity(self) -> Array:
        """At the start [m/s]; shape (bodies, 3)."""
        return self._scene.velocity

    @property
    def angular_velocity(self) -> Array:
        """At the start [rad/s]; shape (bodies, 3)."""
        return self._scene.angular_velocity

    def solve(self, time_limit: float = math.inf) -> Solution:
        """The scene's answer with uncertainties and closed forms, as ``slipcheck run`` has it.

        ``time_limit``: of wall time [s], > 0; a run that takes longer has failed, with the reason.
        """
        found = self._scene.solve(_positive("time_limit", time_limit))
        found["observables"] = {name: Value(*value) for name, value in found["observables"].items()}
        return Solution(**found)

    def trajectory(self, times: ArrayLike, time_limit: float = math.inf) -> "xarray.Dataset":
        """All bodies at these times.

        Parameters
        ----------
        times
            Rising, >= 0 [s]; shape (n,).
        time_limit
            Of wall time [s], > 0; TimeoutError beyond it.

        Returns
        -------
        xarray.Dataset
            ``position`` [m], ``velocity`` [m/s], ``angular_velocity`` [rad/s] of the dimensions (``time``, ``body``,
            ``axis``), in the laboratory. Where a cascade of collisions never ends, the times that the solver did not
            come to are missing.
        """
        import xarray

        at = numpy.ascontiguousarray(times, dtype=float)
        vectors = self._scene.trajectory(at, _positive("time_limit", time_limit))
        dimensions = ("time", "body", "axis")
        units = {"position": "m", "velocity": "m/s", "angular_velocity": "rad/s"}
        variables = {name: (dimensions, array, {"units": units[name]}) for name, array in zip(units, vectors)}
        coordinates = {"time": ("time", at[:len(vectors[0])], {"units": "s"}), "body": self.bodies,
                       "axis": ["x", "y", "z"]}
        return xarray.Dataset(variables, coordinates, {"scene": self.name})

    def solve_many(self, observables: Sequence[str], *, position: Optional[ArrayLike] = None,
                   velocity: Optional[ArrayLike] = None,
                   angular_velocity: Union[None, str, ArrayLike] = None) -> "xarray.Dataset":
        """The scene from many initial states, one run of the solver each (no uncertainties): for maps and fits.

        Parameters
        ----------
        observables
            Full names, ``"i-j.effective_restitution"``.
        position, velocity
            [m], [m/s]; any shape that broadcasts to (n, bodies, 3). Left out: the scene's own.
        angular_velocity
            [rad/s], the same; ``"rolling"``: k̂×v/R, what rolls on a still, level substrate has at its velocity.

        Returns
        -------
        xarray.Dataset
            Each observable of the dimension ``run`` [SI], NaN where a run does not show it; ``end_time`` [s]; ``reached``:
            whether the run came to its end by the solver that was asked (``Scene.solve`` hands over where contacts last).
        """
        import xarray

        states = [self.position if position is None else position, self.velocity if velocity is None else velocity]
        rolling = isinstance(angular_velocity, str)
        if rolling and angular_velocity != "rolling":
            raise ValueError(f"angular_velocity: must be an array or 'rolling', got {angular_velocity!r}")
        if not rolling:
            states.append(self.angular_velocity if angular_velocity is None else angular_velocity)
        arrays = [numpy.asarray(each, dtype=float) for each in states]
        try:
            shape = numpy.broadcast_shapes((1, len(self.bodies), 3), *(each.shape for each in arrays))
        except ValueError:
            shape = ()
        if len(shape) != 3 or shape[1:] != (len(self.bodies), 3):
            shapes = ", ".join(str(each.shape) for each in arrays)
            raise ValueError(f"states: must broadcast to (n, {len(self.bodies)}, 3), got {shapes}")
        full = [numpy.ascontiguousarray(numpy.broadcast_to(each, shape)) for each in arrays]
        if rolling:
            v = full[1]
            full.append(numpy.stack([-v[..., 1], v[..., 0], numpy.zeros(v.shape[:-1])], axis=-1) / self.radius[:, None])
        values, end_time, reached = self._scene.solve_many(*full, list(observables))
        variables: Dict[str, Any] = {name: ("run", values[:, k]) for k, name in enumerate(observables)}
        variables["end_time"] = ("run", end_time, {"units": "s"})
        variables["reached"] = ("run", reached)
        return xarray.Dataset(variables, attrs={"scene": self.name})

    def collide(self, first: str, second: str, normal_speed: ArrayLike, tangential_speed: ArrayLike = 1e-300,
                steps: int = 200) -> Collisions:
        """Many collisions of two of the scene's bodies, free and without gravity, by the law of their contact.

        Parameters
        ----------
        first, second
            Names of two bodies.
        normal_speed, tangential_speed
            Of the contact point [m/s], > 0; any shapes that broadcast. Without a tangential one: central impacts, whose
            ε^T is that of a vanishing slip.
        steps
            In the duration of a collision without damping, >= 8: errors are of second order in their length. Hard
            contacts need none.
        """
        normal, tangential = numpy.broadcast_arrays(numpy.asarray(normal_speed, dtype=float),
                                                    numpy.asarray(tangential_speed, dtype=float))
        columns = self._scene.collide(first, second, normal.ravel(), tangential.ravel(), steps)
        return Collisions(*(column.reshape(normal.shape) for column in columns))


def _positive(name: str, value: float) -> float:
    if not value > 0:
        raise ValueError(f"{name}: must be > 0, got {value}")
    return float(value)
