"""Runs the program ``slipcheck`` and reads what it writes."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any, Iterable, List, Mapping, Optional, Sequence, Union

from .errors import ProgramError
from .results import Results

__all__ = ["program_path", "run", "bundled_scene"]

SceneLike = Union[str, "os.PathLike[str]", Mapping[str, Any]]


def program_path() -> str:
    """The program's path: that of ``SLIPCHECK`` in the environment, else the first ``slipcheck`` of ``PATH``."""
    named = os.environ.get("SLIPCHECK")
    if named:
        return named
    found = shutil.which("slipcheck")
    if found is None:
        raise FileNotFoundError(
            "slipcheck: the program must be in PATH, or its path in the environment variable SLIPCHECK")
    return found


def bundled_scene(name: str) -> Path:
    """The file of a bundled scene by its name, ``"symmetric-30cms"``; of one in a folder ``"extreme/grazing"``."""
    listed = subprocess.run([program_path(), "list", "scenarios", "--json"], capture_output=True, text=True, check=True,
                            stdin=subprocess.DEVNULL, cwd="/")
    folder = Path("/", json.loads(listed.stdout)[0]["file"]).resolve().parent
    file = folder / f"{name}.yaml"
    if not file.is_file():
        raise FileNotFoundError(f"scene: must be a bundled one (slipcheck list scenarios), got {name!r}")
    return file


def _comma(values: Union[str, float, Iterable[Any]]) -> str:
    if isinstance(values, (str, int, float)):
        return str(values)
    return ",".join(str(value) for value in values)


def run(scenes: Union[SceneLike, Sequence[SceneLike]], *, phases: Optional[int] = None,
        engines: Union[None, str, Sequence[str]] = None, precision: Union[None, str, Sequence[str]] = None,
        profiles: Union[None, str, Sequence[str]] = None, rates: Union[None, float, Sequence[float]] = None,
        settings: Optional[Mapping[str, Any]] = None, workers: Optional[int] = None,
        time_limit: Optional[float] = None, arguments: Sequence[str] = ()) -> Results:
    """Runs scenes in the reference and in engines: ``slipcheck run``.

    Parameters
    ----------
    scenes
        Files, or scenes as dicts of what a file says (docs/scenario-format.md); one or several.
    phases
        Runs in each engine's ensemble, by where in a step the first contact falls.
    engines, precision, profiles, rates
        In place of the scenes' own; rates in Hz.
    settings
        Settings of engines over those of every profile, by name.
    workers
        Engines at work at once; one for each core where it is left out.
    time_limit
        Wall-clock time of each run [s].
    arguments
        More of the command line's own, as they stand.

    Raises
    ------
    ProgramError
        Bad input (``exit_code`` 2), with the program's own words. That an engine deviates or fails is a result, no error.
    """
    several = [scenes] if isinstance(scenes, (str, os.PathLike, Mapping)) else list(scenes)
    words: List[str] = [program_path(), "run"]
    with tempfile.TemporaryDirectory(prefix="slipcheck-") as folder:
        for number, scene in enumerate(several):
            if isinstance(scene, Mapping):
                file = Path(folder, f"scene-{number}.yaml")  # JSON is YAML
                file.write_text(json.dumps(scene), encoding="utf-8")
                words.append(str(file))
            else:
                words.append(os.fspath(scene))
        out = Path(folder, "results.json")
        words += ["--quiet", "--json", str(out)]
        for option, value in (("--phases", phases), ("--engines", engines), ("--precision", precision),
                              ("--profiles", profiles), ("--rates", rates), ("--workers", workers),
                              ("--time-limit", time_limit)):
            if value is not None:
                words += [option, _comma(value)]
        for name, value in (settings or {}).items():
            words += ["--set", f"{name}={str(value).lower() if isinstance(value, bool) else value}"]
        words += list(arguments)
        done = subprocess.run(words, capture_output=True, text=True, stdin=subprocess.DEVNULL)
        said = done.stderr.replace(folder + os.sep, "")
        if done.returncode not in (0, 1, 3):
            raise ProgramError(said.strip() or f"slipcheck ended with exit code {done.returncode}",
                               done.returncode)
        if said:
            print(said, end="", file=sys.stderr)
        return Results.read(out)
