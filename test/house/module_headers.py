#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Each module M has a header pcl6d/M.h that includes all its public headers but the PCL classes.
usage: module_headers.py TREE
A header of the module is included, or is named behind "Left out:" in the comment with the reason.
The README of the module names pcl6d/M.h. Headers made by CMake (version.h) are not checked.
"""
import pathlib
import re
import sys


def faults_of(module):
    name = module.name
    include = module / "include/pcl6d"
    whole = include / f"{name}.h"
    own = {header.name for header in (include / name).glob("*.h")}
    if not whole.exists():
        yield f"{name}: there is no include/pcl6d/{name}.h"
        return
    text = whole.read_text()
    included = re.findall(r"^#include <pcl6d/" + name + r"/([a-z0-9_/]+\.h)>", text, re.M)
    comment = " ".join(re.findall(r"Left out:(.*?)\*/", text, re.S))
    left_out = set(re.findall(r"[a-z0-9_]+\.h", comment))
    for header in sorted(own - set(included) - left_out):
        yield f"{name}.h: {header} is neither included nor left out with a reason"
    for header in sorted(left_out - own):
        yield f"{name}.h: left out, but not there: {header}"
    for header in sorted(left_out & set(included)):
        yield f"{name}.h: included and left out: {header}"
    for header in sorted(header for header in included if header.startswith("pcl/")):
        yield f"{name}.h: includes a PCL class: {header}"
    readme = module / "README.md"
    if not readme.exists() or f"#include <pcl6d/{name}.h>" not in readme.read_text():
        yield f"{name}: README.md does not name pcl6d/{name}.h"


def main():
    modules = sorted(folder.parent for folder in pathlib.Path(sys.argv[1]).glob("modules/*/include"))
    faults = [fault for module in modules for fault in faults_of(module)]
    print("\n".join(faults))
    print(f"{len(modules)} modules, {len(faults)} faults")
    sys.exit(1 if faults or not modules else 0)


if __name__ == "__main__":
    main()
