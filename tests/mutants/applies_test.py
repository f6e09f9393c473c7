"""Every mutant of the list still applies to the source, names a test that exists, and spans the layers."""

import collections
import re
import sys

import mutants


def main():
    try:
        listed = mutants.read()
    except mutants.BadList as error:
        print(error)
        return 1
    faults = [f"{m.name}: {why}" for m in listed if (why := mutants.misfit(m))]
    tests = collections.defaultdict(set)
    for file in (mutants.ROOT / "tests").rglob("*_test.cpp"):
        for suite, name in re.findall(r"^TEST(?:_[FP])?\((\w+),\s*(\w+)\)", file.read_text(encoding="utf-8"), re.M):
            tests[suite].add(name)
    for mutant in listed:
        for pattern in mutant.test.split(":"):
            suite, _, name = pattern.removeprefix("*/").partition(".")
            name = name.partition("/")[0]
            if name != "*" and name not in tests[suite] or not tests[suite]:
                faults.append(f"{mutant.name}: there is no test {pattern}")
    if len(listed) < 60:
        faults.append(f"{len(listed)} mutants, and 60 are the least")
    print("\n".join(faults) or f"{len(listed)} mutants apply")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
