"""Holds the JSON Schema against the loader.

usage: schema_agreement.py SCHEMA CORPUS_PROGRAM [EVERY]

The program prints scenes with the loader's verdict; the schema must come to the same.
"""

import json
import re
import subprocess
import sys

import jsonschema

# What the table of keys refuses but a schema cannot say: an order, the limits of a number that is written as a text, and of
# a sweep that two numbers go together and rows name the same.
BEYOND_A_SCHEMA = re.compile(r'must have the (smaller radius|lower limit) first|must be (>|<)=? .*got "|'
                             r'must be from |must have one unit|must be > 0 on a log|must name (once|all) ')


def main():
    schema_file, *program = sys.argv[1:]
    with open(schema_file, encoding="utf-8") as file:
        schema = json.load(file)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)

    lines = subprocess.run(program, check=True, capture_output=True, text=True).stdout.splitlines()
    accepted = disagreements = 0
    for line in lines:
        case = json.loads(line)
        valid = validator.is_valid(case["scene"])
        accepted += case["accepted"]
        if valid == case["accepted"] or BEYOND_A_SCHEMA.search(case["why"]):
            continue
        disagreements += 1
        if disagreements <= 10:
            print(f"schema says {valid}, loader {case['accepted']}: {case['why']}")
            error = jsonschema.exceptions.best_match(validator.iter_errors(case["scene"]))
            print(f"  {error.json_path}: {error.message[:200]}" if error else f"  {line[:800]}")
    print(f"{len(lines)} scenes, {accepted} accepted, {disagreements} disagreements")
    sys.exit(1 if disagreements or accepted < 100 or accepted > len(lines) - 100 else 0)


if __name__ == "__main__":
    main()
