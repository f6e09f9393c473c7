"""Result files (docs/result-file.md) as tables: pandas and xarray."""

from __future__ import annotations

import json
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, Iterable, Iterator, List, Optional, Union

if TYPE_CHECKING:
    import pandas
    import xarray

__all__ = ["Results"]

_RUN_KEYS = ("engine", "version", "precision", "profile", "rate", "scale")
_STANDS_FOR = {"nan": math.nan, "infinite": math.inf, "minus_infinite": -math.inf, "absent": math.nan}


def _number(record: Dict[str, Any], key: str) -> float:
    """A number of a record, whose null stands for what ``nulls`` says."""
    value = record.get(key)
    if value is None:
        return _STANDS_FOR.get(record.get("nulls", {}).get(key, "nan"), math.nan)
    return float(value)


def _phases(seen: Dict[str, Any]) -> Iterator[float]:
    for place, value in enumerate(seen["values"]):
        if value is None:
            yield _STANDS_FOR.get(seen.get("nulls", {}).get(f"values[{place}]", "nan"), math.nan)
        else:
            yield float(value)


class Results:
    """What ``slipcheck run`` found of one scene or of several.

    Attributes
    ----------
    scenes : list of dict
        Each scene's object as the file has it.
    """

    def __init__(self, scenes: Iterable[Dict[str, Any]]) -> None:
        self.scenes: List[Dict[str, Any]] = list(scenes)

    @classmethod
    def read(cls, path: Union[str, "os.PathLike[str]"]) -> "Results":
        """Reads a result file, or all result files of a folder that ``slipcheck run --out`` wrote.

        Raises ValueError for a file that is something else.
        """
        path = Path(path)
        if path.is_dir():
            scenes = []
            for file in sorted(path.glob("*.json")):
                content = json.loads(file.read_text(encoding="utf-8"))
                if isinstance(content, dict) and str(content.get("schema", "")).startswith("slipcheck-result"):
                    scenes += cls._scenes_of(content, file)
            if not scenes:
                raise ValueError(f"{path}: must hold result files of slipcheck run --out")
            return cls(scenes)
        return cls(cls._scenes_of(json.loads(path.read_text(encoding="utf-8")), path))

    @staticmethod
    def _scenes_of(content: Any, path: Path) -> List[Dict[str, Any]]:
        schema = content.get("schema") if isinstance(content, dict) else None
        if schema == "slipcheck-result/1":
            return [content]
        if schema == "slipcheck-results/1":
            return list(content["results"])
        raise ValueError(f"{path}: schema: must be slipcheck-result/1 or slipcheck-results/1, got {schema!r}")

    def __len__(self) -> int:
        return len(self.scenes)

    @property
    def verdicts(self) -> Dict[str, str]:
        """By scene: ``within``, ``deviates``, ``undecided``, ``failed``, ``not judged`` or ``reference alone``."""
        return {scene["scenario"]["name"]: scene["verdict"] for scene in self.scenes}

    def table(self) -> "pandas.DataFrame":
        """One long tidy table, a row for each number.

        Columns: ``scene``, ``engine``, ``version``, ``precision``, ``profile``, ``rate`` [Hz], ``scale`` [-], ``phase``,
        ``observable``, ``value`` [SI]. Rows of the reference have the engine ``reference``, its solver as the profile,
        and neither rate nor phase (NaN, <NA>). ``phase`` counts runs of the ensemble from 0; observables that the file
        has no phases of (those without a tolerance) are their median, without a phase. NaN: that run does not show it.
        """
        import pandas

        rows: List[Dict[str, Any]] = []
        for scene in self.scenes:
            name, reference = scene["scenario"]["name"], scene["reference"]
            start = {"scene": name, "engine": "reference", "version": scene["slipcheck"]["version"],
                     "precision": "double", "profile": reference["solver"], "rate": math.nan, "scale": 1.0, "phase": None}
            for observable, value in reference.get("observables", {}).items():
                rows.append({**start, "observable": observable, "value": _number(value, "value")})
            for run in scene["runs"]:
                start = {"scene": name, **{key: run.get(key) for key in _RUN_KEYS}}
                start["scale"] = float(run.get("scale", 1.0))
                for observable, seen in run.get("observables", {}).items():
                    if "values" not in seen:
                        rows.append({**start, "phase": None, "observable": observable, "value": _number(seen, "median")})
                        continue
                    for phase, value in enumerate(_phases(seen)):
                        rows.append({**start, "phase": phase, "observable": observable, "value": value})
        columns = ["scene", *_RUN_KEYS, "phase", "observable", "value"]
        table = pandas.DataFrame(rows, columns=columns)
        return table.astype({"phase": "Int64", "rate": float, "scale": float, "value": float})

    def runs(self) -> "pandas.DataFrame":
        """A row for each run: scene, engine, version, precision, profile, rate, scale, ``status``, ``reason``,
        ``cpu_seconds`` [s] (all phases), ``steps``, ``phases``."""
        import pandas

        rows = []
        for scene in self.scenes:
            for run in scene["runs"]:
                rows.append({"scene": scene["scenario"]["name"], **{key: run.get(key) for key in _RUN_KEYS},
                             "scale": float(run.get("scale", 1.0)), "status": run["status"], "reason": run.get("reason", ""),
                             "cpu_seconds": _number(run, "cpu_seconds"), "steps": run.get("steps", 0),
                             "phases": run.get("phases", 0)})
        return pandas.DataFrame(rows, columns=["scene", *_RUN_KEYS, "status", "reason", "cpu_seconds", "steps", "phases"])

    def errors(self) -> "pandas.DataFrame":
        """A row for each run and observable: scene, engine, …, ``observable``, ``median``, ``max`` and ``rms`` of the
        deviations over the phases (relative to the reference, or absolute where ``absolute``), ``tolerance`` (NaN
        where the scene states none), ``within``."""
        import pandas

        rows = []
        for scene in self.scenes:
            for run in scene["runs"]:
                start = {"scene": scene["scenario"]["name"], **{key: run.get(key) for key in _RUN_KEYS}}
                start["scale"] = float(run.get("scale", 1.0))
                for observable, error in run.get("errors", {}).items():
                    rows.append({**start, "observable": observable,
                                 **{key: _number(error, key) for key in ("median", "max", "rms", "tolerance")},
                                 "absolute": bool(error.get("absolute", False)), "within": error.get("within")})
        columns = ["scene", *_RUN_KEYS, "observable", "median", "max", "rms", "tolerance", "absolute", "within"]
        return pandas.DataFrame(rows, columns=columns)

    def reference(self) -> "pandas.DataFrame":
        """A row for each observable of the reference: ``scene``, ``solver``, ``observable``, ``value``, ``uncertainty``
        and, where a formula applies, ``closed_form`` [SI]."""
        import pandas

        rows = []
        for scene in self.scenes:
            reference = scene["reference"]
            closed = reference.get("closed_form", {})
            for observable, value in reference.get("observables", {}).items():
                rows.append({"scene": scene["scenario"]["name"], "solver": reference["solver"], "observable": observable,
                             "value": _number(value, "value"), "uncertainty": _number(value, "uncertainty"),
                             "closed_form": closed.get(observable, math.nan)})
        return pandas.DataFrame(rows, columns=["scene", "solver", "observable", "value", "uncertainty", "closed_form"])

    def dataset(self, scene: Optional[str] = None) -> "xarray.Dataset":
        """One scene's ensembles: a variable for each observable that has phases, of the dimensions (``run``, ``phase``),
        NaN where a phase does not show it; coordinates of ``run``: engine, version, precision, profile, rate [Hz].
        The attribute ``reference`` of a variable is the reference's value. ``scene`` may be left out of a single one."""
        import numpy
        import xarray

        names = [each["scenario"]["name"] for each in self.scenes]
        if scene is None:
            if len(names) != 1:
                raise ValueError(f"scene: must be one of {', '.join(names)}, got none")
            scene = names[0]
        if scene not in names:
            raise ValueError(f"scene: must be one of {', '.join(names)}, got {scene!r}")
        found = self.scenes[names.index(scene)]
        runs = found["runs"]
        ensembles: Dict[str, List[List[float]]] = {}
        for number, run in enumerate(runs):
            for observable, seen in run.get("observables", {}).items():
                if "values" in seen:
                    ensembles.setdefault(observable, [[] for _ in runs])[number] = list(_phases(seen))
        longest = max((len(values) for each in ensembles.values() for values in each), default=0)
        variables = {}
        for observable, by_run in ensembles.items():
            array = numpy.full((len(runs), longest), numpy.nan)
            for number, values in enumerate(by_run):
                array[number, :len(values)] = values
            right = found["reference"]["observables"].get(observable, {})
            variables[observable] = (("run", "phase"), array, {"reference": _number(right, "value")})
        coordinates = {key: ("run", [run.get(key) for run in runs]) for key in _RUN_KEYS if key != "scale"}
        return xarray.Dataset(variables, {**coordinates, "phase": numpy.arange(longest)}, {"scene": scene})
