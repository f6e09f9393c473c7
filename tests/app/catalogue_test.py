#!/usr/bin/env python3
"""Runs the whole catalogue of extreme cases in the reference.

usage: catalogue_test.py SLIPCHECK
"""
import json
import subprocess
import sys

# Whether the reference is right, not how fast the machine is: collapse-line-e01 alone takes 20 s of an idle core.
result = subprocess.run([sys.argv[1], "stability", "--engines", "bullet", "--profiles", "default", "--precisions", "double",
                         "--phases", "1", "--limits", "no", "--time-limit", "600", "--json", "-"],
                        capture_output=True, text=True, timeout=880)
cases = json.loads(result.stdout)["cases"]
failed = [f"{case['name']}: {case['reference']}" for case in cases
          if case["reference"]["outcome"] == "failed"
          or case["reference"]["outcome"] == "refused" and not case["reference"].get("why")]
print(f"{len(cases)} cases", *failed, sep="\n")
sys.exit(1 if failed or len(cases) < 60 else 0)
