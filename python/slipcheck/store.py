"""Stores of ``slipcheck sweep`` (docs/sweeps.md) as tables: pandas and xarray."""

from __future__ import annotations

import math
import os
import sqlite3
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

if TYPE_CHECKING:
    import pandas
    import xarray

__all__ = ["Store"]

_APPLICATION = 0x534C4950  # "SLIP": a data base is a store
_SCHEMA = 1
_RUN_KEYS = ("engine", "version", "precision", "profile", "rate", "scale")
_STATISTICS = ("median", "min", "max", "missing", "error", "error_median")
_Path = Union[str, "os.PathLike[str]"]
_Where = Mapping[str, Any]


def _quoted(name: str) -> str:
    return '"' + name.replace('"', '""') + '"'


class Store:
    """What a sweep has found so far; the file is read only, also while ``slipcheck sweep`` writes it.

    Raises ValueError for a file that is no store of schema 1, and FileNotFoundError where there is none.

    Attributes
    ----------
    name : str
        The scene's.
    size : int
        How many runs the whole sweep has, made or not.
    program : str
        What made it: ``"slipcheck 0.1.0 (0123456)"``.
    text : str
        The file of the sweep.
    """

    def __init__(self, path: _Path) -> None:
        path = Path(path)
        if not path.is_file():
            raise FileNotFoundError(f"{path}: must be a store of slipcheck sweep, and there is no such file")
        self._file = sqlite3.connect(path.resolve().as_uri() + "?mode=ro", uri=True)
        try:
            application = self._file.execute("PRAGMA application_id").fetchone()[0]
            schema = self._file.execute("PRAGMA user_version").fetchone()[0]
        except sqlite3.DatabaseError as error:
            self._file.close()
            raise ValueError(f"{path}: must be a store of slipcheck sweep: {error}") from None
        if application != _APPLICATION or schema != _SCHEMA:
            self._file.close()
            if application != _APPLICATION:
                raise ValueError(f"{path}: must be a store of slipcheck sweep")
            raise ValueError(f"{path}: must be a store of schema {_SCHEMA}, got {schema}")
        head = dict(self._file.execute("SELECT key, value FROM sweep"))
        self.name: str = head["name"]
        self.size: int = head["runs"]
        self.program: str = head["program"]
        self.text: str = head["text"]

    def close(self) -> None:
        """Lets go of the file."""
        self._file.close()

    def __enter__(self) -> "Store":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    def __len__(self) -> int:
        """Runs that it has."""
        return int(self._file.execute("SELECT count(*) FROM runs").fetchone()[0])

    def parameters(self) -> "pandas.DataFrame":
        """What varies: ``name``, ``kind`` (``scene``, ``setting``, ``engine``, ``rate``, …) and SI ``unit``."""
        import pandas

        return pandas.read_sql_query("SELECT name, kind, unit FROM parameters ORDER BY number", self._file)

    def runs(self, where: Optional[_Where] = None) -> "pandas.DataFrame":
        """A row for each run that was made, indexed by ``run``: its engine, rate [Hz], scale, phases, ``status``,
        ``reason``, ``verdict``, ``cpu_seconds`` [s] of the engine's steps, ``seconds`` [s] of wall time, and a column
        for each parameter [SI].

        where : a value, or a list of values, for each of some columns: ``{"engine": "bullet", "rate": [60, 240]}``.
        """
        import pandas

        condition, values = self._condition(where)
        return pandas.read_sql_query(f"SELECT * FROM runs {condition} ORDER BY run", self._file, params=values, index_col="run")

    def table(self, observables: Optional[Sequence[str]] = None, where: Optional[_Where] = None) -> "pandas.DataFrame":
        """One long tidy table, a row for each number, as ``Results.table()`` and with a column for each parameter.

        Columns: ``run``, ``scene``, ``engine``, ``version``, ``precision``, ``profile``, ``rate`` [Hz], ``scale`` [-], the
        parameters of scene and settings under their names [SI], ``phase``, ``observable``, ``value`` [SI]. Rows of the
        reference, one for each distinct scene, have the engine ``reference``, its solver as the profile, and neither run,
        rate nor phase. Observables without a tolerance are their median, without a phase. NaN: that run does not show it.

        observables : these alone. where : as of ``runs``; references are those of the runs that are left.
        """
        import numpy
        import pandas

        runs = self.runs(where)
        varied = self._columns()
        ours = self._file.execute(
            "SELECT run, name, median, per_phase FROM observables JOIN names ON names.id = observable "
            f"{self._named(observables)} ORDER BY run, observable", list(observables or []))
        numbers: List[int] = []
        names: List[str] = []
        counts: List[int] = []
        phases, values = [], []
        kept = set(runs.index)
        for run, name, median, blob in ours:
            if run not in kept:
                continue
            each = numpy.frombuffer(blob) if blob else numpy.array([math.nan if median is None else median])
            numbers.append(run)
            names.append(name)
            counts.append(len(each))
            phases.append(numpy.arange(len(each)) if blob else numpy.array([-1]))
            values.append(each)
        at = numpy.repeat(numpy.array(numbers, dtype=int), counts)
        found = runs.loc[at, [*_RUN_KEYS, *varied]].reset_index()
        found["observable"] = numpy.repeat(numpy.array(names, dtype=object), counts)
        found["value"] = numpy.concatenate(values) if values else numpy.array([], dtype=float)
        phase = pandas.Series(numpy.concatenate(phases) if phases else [], dtype="Int64")
        found["phase"] = phase.mask(phase == -1)

        reference = self.reference(observables)
        scenes = runs.drop_duplicates("scene").set_index("scene")[self._columns("scene")]
        right = reference[reference.scene_number.isin(scenes.index)].join(scenes, on="scene_number")
        right = right.rename(columns={"solver": "profile"}).assign(engine="reference", precision="double", scale=1.0,
                                                                   version=self.program.split(" ")[1])
        columns = ["run", "scene", *_RUN_KEYS, *varied, "phase", "observable", "value"]
        whole = pandas.concat([right.reindex(columns=columns), found.assign(scene=self.name).reindex(columns=columns)],
                              ignore_index=True)
        return whole.astype({"run": "Int64", "phase": "Int64", "rate": float, "scale": float, "value": float})

    def errors(self, where: Optional[_Where] = None) -> "pandas.DataFrame":
        """A row for each run and observable that was compared: ``run``, engine, …, the parameters, ``observable``,
        ``median`` and ``max`` of the deviations over the phases (relative to the reference, or absolute where
        ``absolute``), ``tolerance`` (NaN where the scene states none) and ``verdict``."""
        import pandas

        found = pandas.read_sql_query(
            "SELECT run, name AS observable, error_median AS median, error AS max, absolute, tolerance, verdict "
            "FROM observables JOIN names ON names.id = observable WHERE error IS NOT NULL OR verdict IS NOT NULL "
            "ORDER BY run, observable", self._file)
        runs = self.runs(where)[[*_RUN_KEYS, *self._columns()]]
        found = runs.join(found.set_index("run"), how="inner").reset_index()
        return found.astype({"absolute": bool})

    def reference(self, observables: Optional[Sequence[str]] = None) -> "pandas.DataFrame":
        """A row for each distinct scene and observable: ``scene``, ``scene_number`` (column ``scene`` of ``runs``),
        ``solver``, ``observable``, ``value``, ``uncertainty`` and, where a formula applies, ``closed_form`` [SI]."""
        import pandas

        found = pandas.read_sql_query(
            "SELECT reference.scene AS scene_number, solver, name AS observable, value, uncertainty, closed_form "
            "FROM reference JOIN scenes USING(scene) JOIN names ON names.id = observable "
            f"{self._named(observables)} ORDER BY 1, observable", self._file, params=list(observables or []))
        found.insert(0, "scene", self.name)
        return found

    def grid(self, observable: str, where: Optional[_Where] = None) -> "xarray.Dataset":
        """One observable over all combinations of what varies: ``median``, ``min``, ``max``, ``missing`` (phases that do not
        show it), ``error`` (the largest) and ``error_median`` over the phases, and ``reference``; its dimensions are the
        columns that have more than one value, its coordinates their values [SI]. NaN: no such run.

        Of a sweep with samples each run is a combination of its own, which is refused: ``table`` and ``runs`` have them.
        """
        import numpy
        import pandas
        import xarray

        runs = self.runs(where)
        columns = [name for name in [*_RUN_KEYS, "phases", *self._columns()] if runs[name].nunique(dropna=False) > 1]
        cells = math.prod(runs[name].nunique(dropna=False) for name in columns)
        if cells > 4 * max(len(runs), 1):
            raise ValueError(f"grid: must have about as many runs as combinations, got {len(runs)} runs of {cells} combinations")
        if runs.duplicated(columns).any():
            raise ValueError("grid: must have one run of each combination")
        picked = ", ".join(_STATISTICS)
        found = pandas.read_sql_query(
            f"SELECT run, {picked} FROM observables JOIN names ON names.id = observable WHERE name = ?", self._file,
            params=[observable], index_col="run")
        right = self.reference([observable]).set_index("scene_number").value
        if found.empty and right.empty:
            raise ValueError(f"observable: must be one of {', '.join(self.observables())}, got {observable!r}")
        both = runs[[*columns, "scene"]].join(found)
        both["reference"] = both.scene.map(right)
        coordinates = {name: numpy.sort(runs[name].unique()) for name in columns}
        shape = [len(values) for values in coordinates.values()]
        at = tuple(numpy.searchsorted(coordinates[name], both[name]) for name in columns)
        variables = {}
        for name in (*_STATISTICS, "reference"):
            array = numpy.full(shape, numpy.nan)
            array[at] = both[name].astype(float) if columns else both[name].astype(float).item()
            variables[name] = (columns, array)
        units = dict(self.parameters().set_index("name").unit)
        data = xarray.Dataset(variables, coordinates, {"observable": observable, "scene": self.name})
        for name in columns:
            data[name].attrs["units"] = units.get(name, "")
        return data

    def observables(self) -> List[str]:
        """Names of all that it has, sorted."""
        return [name for (name,) in self._file.execute("SELECT name FROM names ORDER BY name")]

    def _columns(self, *kinds: str) -> List[str]:
        chosen = kinds or ("scene", "setting")
        rows = self._file.execute("SELECT name, kind FROM parameters ORDER BY number")
        return [name for name, kind in rows if kind in chosen]

    @staticmethod
    def _named(observables: Optional[Sequence[str]]) -> str:
        return "" if observables is None else f"WHERE name IN ({', '.join('?' * len(observables))})"

    def _condition(self, where: Optional[_Where]) -> Tuple[str, List[Any]]:
        known = {name for _, name, *_ in self._file.execute("PRAGMA table_info(runs)")}
        parts, values = [], []
        for column, value in (where or {}).items():
            if column not in known:
                raise ValueError(f"where: must name a column of runs ({', '.join(sorted(known))}), got {column!r}")
            several = list(value) if isinstance(value, (list, tuple, set, frozenset)) else [value]
            parts.append(f"{_quoted(column)} IN ({', '.join('?' * len(several))})")
            values += several
        return ("WHERE " + " AND ".join(parts) if parts else ""), values
