#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Headers that are installed are those that a user of the libraries needs.
usage: installed_headers.py TREE [--limit NUMBER] [--list]
modules/M/include is installed, modules/M/internal is shared by the sources of this tree. Checked:
- an installed header includes installed headers only;
- at most LIMIT headers are installed, with version.h, which CMake makes. Template bodies (.hpp) of PCL
  classes are counted apart: their headers include them, users do not;
- each internal header is needed outside of its module: by another module, a program or a test, directly or
  through an internal header. Any other belongs into the module's src.
--list: the installed headers by module.
"""
import argparse
import collections
import pathlib
import re
import sys

LIMIT = 250
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"](pcl6d/[^>"]+)[>"]', re.M)
SOURCES = {".h", ".hpp", ".cpp", ".in"}


def headers_of(tree, kind):
    """name as included -> file"""
    return {path.relative_to(folder).as_posix(): path
            for folder in sorted(tree.glob(f"modules/*/{kind}"))
            for path in sorted(folder.rglob("*")) if path.suffix in (".h", ".hpp")}


def includes_of(path):
    return INCLUDE.findall(path.read_text(errors="replace"))


def made_by_cmake(tree):
    return {"pcl6d/common/version.h"} if (tree / "modules/common/src/version.h.in").exists() else set()


def needed_outside(tree, internal):
    """The internal headers that a file outside of their module includes, and those that these include."""
    needed, module_of = set(), {name: path.relative_to(tree).parts[1] for name, path in internal.items()}
    for top in ("modules", "apps", "test", "share"):
        for path in (tree / top).rglob("*"):
            if path.suffix not in SOURCES or not path.is_file():
                continue
            parts = path.relative_to(tree).parts
            own = parts[1] if top == "modules" else ""
            needed |= {name for name in includes_of(path) if name in internal and module_of[name] != own}
    rest = list(needed)
    while rest:
        below = {name for name in includes_of(internal[rest.pop()]) if name in internal} - needed
        needed |= below
        rest += below
    return needed


def faults_of(tree, installed, internal, made, limit):
    for name, path in installed.items():
        for included in includes_of(path):
            if included in internal:
                yield f"{name}: is installed, and includes the internal header {included}"
            elif included not in installed and included not in made:
                yield f"{name}: includes {included}, which is not there"
    for name in sorted(installed.keys() & internal.keys()):
        yield f"{name}: is in include and in internal"
    count = sum(name.endswith(".h") for name in installed) + len(made)
    if count > limit:
        yield f"{count} installed headers, at most {limit} allowed: move those no user needs to internal"
    for name in sorted(internal.keys() - needed_outside(tree, internal)):
        yield f"{name}: internal, but needed by its own module only: move it into src"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tree", type=pathlib.Path)
    parser.add_argument("--limit", type=int, default=LIMIT)
    parser.add_argument("--list", action="store_true")
    args = parser.parse_args()
    installed, internal = headers_of(args.tree, "include"), headers_of(args.tree, "internal")
    made = made_by_cmake(args.tree)
    faults = list(faults_of(args.tree, installed, internal, made, args.limit))
    if args.list:
        names = collections.defaultdict(list)
        for name in sorted(installed.keys() | made):
            names[name.split("/")[1].removesuffix(".h")].append(name[len("pcl6d/"):])
        for module, headers in sorted(names.items()):
            print(f"{module} ({len(headers)}): {' '.join(headers)}")
    print("\n".join(faults))
    bodies = sum(name.endswith(".hpp") for name in installed)
    print(f"{len(installed) - bodies + len(made)} installed headers, {bodies} template bodies, "
          f"{len(internal)} internal headers, {len(faults)} faults")
    sys.exit(1 if faults or not installed else 0)


if __name__ == "__main__":
    main()
