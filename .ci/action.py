#!/usr/bin/env python3
"""Prints the steps of an action as a shell script, as a runner would run them with these inputs; outputs go to
files of their names in /tmp/action.

usage: action.py ACTION_YML NAME=VALUE...
"""
import re
import shlex
import sys
from pathlib import Path

import yaml

action = yaml.safe_load(Path(sys.argv[1]).read_text())
given = dict(word.split("=", 1) for word in sys.argv[2:])
inputs = {}
for name, about in action["inputs"].items():
    if name not in given and about.get("required"):
        sys.exit(f"{name}: must be given")
    inputs[name] = given.pop(name, about.get("default", ""))
if given:
    sys.exit(f"inputs: must be of {', '.join(inputs)}, got {', '.join(given)}")


def filled(text):
    def value(match):
        return inputs[match.group(1)]
    text = re.sub(r"\$\{\{ inputs\.(\w+) \}\}", value, text)
    if "${{" in text:
        sys.exit(f"a step must have no expression but inputs, got {text}")
    return text


if action["runs"]["using"] != "composite":
    sys.exit("runs.using: must be composite")
print("mkdir -p /tmp/action; export GITHUB_OUTPUT=/tmp/action/outputs GITHUB_STEP_SUMMARY=/tmp/action/summary")
for step in action["runs"]["steps"]:
    assert step["shell"] == "bash", step
    environment = [f"{name}={filled(value)}" for name, value in step.get("env", {}).items()]
    # As a runner calls it.
    print(shlex.join(["env", *environment, "bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", filled(step["run"])]))
for name, about in action["outputs"].items():
    key = re.fullmatch(r"\$\{\{ steps\.\w+\.outputs\.(\w+) \}\}", about["value"]).group(1)
    print(f"cp \"$(sed -n 's/^{key}=//p' /tmp/action/outputs)\" /tmp/action/{name}")
