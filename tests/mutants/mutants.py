"""The list of mutants.toml: reading it and what it says of the source."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


@dataclass(frozen=True)
class Mutant:
    name: str
    file: str  # below the root of the sources
    text: str  # what stands there once
    becomes: str  # what stands there in its place
    target: str  # the test executable
    test: str  # its filter: one of these must fail
    survives: str = ""  # why no test can tell; empty: one must


class BadList(Exception):
    """The list itself has faults; the message names each."""


def read(path=HERE / "mutants.toml"):
    with open(path, "rb") as file:
        listed = tomllib.load(file)["mutant"]
    mutants, faults, names = [], [], set()
    for entry in listed:
        try:
            mutant = Mutant(**entry)
        except TypeError as error:
            faults.append(f"{entry.get('name', entry)}: {error}")
            continue
        if mutant.name in names:
            faults.append(f"{mutant.name}: is there twice")
        if mutant.text == mutant.becomes:
            faults.append(f"{mutant.name}: changes nothing")
        names.add(mutant.name)
        mutants.append(mutant)
    if faults:
        raise BadList("\n".join(faults))
    return mutants


def misfit(mutant, root=ROOT):
    """Why the mutant does not apply to the sources; "" where it does."""
    path = root / mutant.file
    if not path.is_file():
        return f"{mutant.file} is not there"
    count = path.read_text(encoding="utf-8").count(mutant.text)
    return "" if count == 1 else f"{mutant.file} holds its text {count} times, not once"


def mutated(mutant, root=ROOT):
    """The file's text with the mutant in it."""
    return (root / mutant.file).read_text(encoding="utf-8").replace(mutant.text, mutant.becomes)
