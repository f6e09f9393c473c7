#!/usr/bin/env python3
"""Prints what a Containerfile does as a shell script to be run in a root, and copies what it copies there.

usage: containerfile.py CONTAINERFILE CONTEXT ROOT
"""
import json
import shlex
import shutil
import sys
from pathlib import Path

text, context, root = Path(sys.argv[1]).read_text(), Path(sys.argv[2]), Path(sys.argv[3])
user, folder = "root", "/"
for line in text.replace("\\\n", " ").splitlines():
    if not line.strip() or line.startswith("#"):
        continue
    keyword, rest = line.split(None, 1)
    if keyword == "FROM":
        if rest != "debian:12":
            sys.exit(f"FROM: must be debian:12, which the root is, got {rest}")
    elif keyword == "COPY":
        *sources, target = rest.split()
        Path(root, target.lstrip("/")).mkdir(parents=True)
        for source in sources:
            files = list(context.glob(source))
            if not files:
                sys.exit(f"COPY: must name files of {context}, got {source}")
            for file in files:
                shutil.copy(file, Path(root, target.lstrip("/")))
    elif keyword == "RUN":
        print(f"cd {shlex.quote(folder)}\n{rest}")
    elif keyword == "USER":
        user = rest
        print(f"id {shlex.quote(user)}")
    elif keyword == "WORKDIR":
        folder = rest
        print(f"mkdir -p {shlex.quote(folder)}")
    elif keyword == "ENTRYPOINT":
        entry = json.loads(rest)
    elif keyword == "CMD":
        command = shlex.join(["setpriv", "--reuid", user, "--clear-groups", *entry, *json.loads(rest)])
        print(f"cd {shlex.quote(folder)}\n{command} >/dev/null")
    else:
        sys.exit(f"{keyword}: not known here")
