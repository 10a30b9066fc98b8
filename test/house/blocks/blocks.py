#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The fenced blocks of the documents are right.
usage: blocks.py --cpp TREE GIVEN OUT.cpp    writes all blocks of C++ as one source, to be compiled
       blocks.py TREE GIVEN BIN_DIR          checks all other blocks
C++ is compiled, each block with its declarations of GIVEN. Programs and files of the tree in lines of
sh must exist, and options of ours be known; ../sh_blocks.py runs the lines.
JSON is parsed, and read by the program in a block of sh, see JSON_READ. Other languages need a reason in REASONS, and each
block a language. Prints the number of blocks by language.
"""
import collections
import json
import pathlib
import re
import shlex
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from documents import documents, fences_of  # noqa: E402
from moving_from import fault_of  # noqa: E402

REASONS = {
    "cmake": "install.cmake_blocks configures a project with each of them",
    "python": "the only one is in modules/python/README.md, and python.moving_from runs it",
    "text": "no program reads it: layout of folders, grammar, output",
    "{languages}": "names files of share/examples: house.site reads the names; install.map_example, "
                   "python.examples and python.maps run the files",
    "{toctree}": "a list of pages, which house.site reads",
}
# Blocks of JSON, and the file of the same text, which a block of sh on the page reads (../sh_block_inputs.py).
JSON_READ = {"share/doc/benchmark.md 1": "my_suite.json", "share/doc/planes.md 1": "my_rules.json"}
# Programs of the system in lines of sh.
SYSTEM = {"apt", "apt-get", "cd", "cmake", "ctest", "cp", "export", "for", "g++", "git", "gdb", "kill", "mkdir", "man",
          "mpirun", "mpiexec", "pip", "python3", "PYTHONPATH", "rosbag", "sed", "source", "ssh", "tar",
          "wget", "done", "do", "xdg-open", "sudo", "echo", "env", "slurm", "sbatch", "srun", "scp", "convert"}


def blocks(tree):
    """(file, number among those of its language, line, language, text)"""
    for path in documents(tree):
        count = collections.Counter()
        for fence in fences_of(path.read_text().split("\n")):
            count[fence.language] += 1
            yield path.relative_to(tree).as_posix(), count[fence.language], fence.line, fence.language, fence.text


def given(file):
    rows, key = {}, None
    for line in file.read_text().split("\n"):
        if line.startswith("== "):
            key = line[3:]
            rows[key] = []
        elif key and line:
            rows[key].append(line)
    return rows


def source_of(tree, table):
    """One source of all blocks, whose lines the compiler names as those of the documents."""
    includes, bodies = set(), []
    for file, number, line, language, text in blocks(tree):
        rows = table.get(f"{file} {number}", [])
        if language != "cpp" or any(row.startswith("not compiled:") for row in rows):
            continue
        is_whole = "at namespace scope" in rows
        rows = [row for row in rows if row != "at namespace scope"]
        includes |= {row for row in rows + text.split("\n") if row.startswith("#include")}
        declared = "\n".join(row for row in rows if not row.startswith("#include"))
        body = re.sub(r"^#include.*$", "", text, flags=re.M)
        name = "block_" + re.sub(r"\W", "_", file) + str(number)
        open_, close = ("", "") if is_whole else ("void run() {\n", "}\n")
        bodies.append(f"namespace {name} {{\n{declared}\n{open_}#line {line} \"{tree}/{file}\"\n{body}{close}}}\n")
    begin = "".join(sorted(row + "\n" for row in includes))
    helpers = "".join(f"template <typename... Given> void {name}(Given&&...) {{}}\n"
                      for name in ("use", "show", "keep", "write"))
    return (f"#include <deque>\n#include <iostream>\n#include <memory>\n#include <string>\n#include <vector>\n"
            f"{begin}\nnamespace {{\n{helpers}\n" + "\n".join(bodies) + "}\n")


def fault_of_line(tree, folder, line):
    line = re.sub(r"(^|\s)#.*", "", line).strip()
    line = re.sub(r"^(?:[A-Z_0-9]+=\S* )+", "", line)
    line = re.sub(r"^mpi(?:run|exec) .*?(?=(?:\S*/)?pcl_slam6d)", "", line)
    try:
        words = shlex.split(line)
    except ValueError:
        words = line.split()
    if not words:
        return ""
    program = words[0].rsplit("/", 1)[-1]
    if program.startswith("pcl_slam6d"):
        split = [part for word in words[1:] for part in (word.split("=", 1) if word.startswith("--") else [word])]
        kept = [word.replace(" ", "_") for word in split]
        end = next((i for i, word in enumerate(kept) if word in ("|", "&&", ";", "&", ">", "\\")), len(kept))
        fault = fault_of(folder, " ".join([program] + kept[:end]))
        return "" if "--plugin" in kept and " has no " in fault else fault  # a word of the plug-in
    if "/" in words[0] and "build/" not in words[0] and not words[0].startswith("/"):
        return "" if (tree / words[0]).exists() else f"there is no {words[0]}"
    if words[0] in SYSTEM or words[0].startswith("-") or "build/" in words[0]:
        return ""
    return f"unknown program {words[0]}"


def faults(tree, table, folder):
    keys = set()
    shell = collections.defaultdict(list)
    for file, _, _, language, text in blocks(tree):
        if language == "sh":
            shell[file].append(text)
    for file, number, line, language, text in blocks(tree):
        place = f"{file}:{line}"
        if language == "cpp":
            keys.add(f"{file} {number}")
            if f"{file} {number}" not in table:
                yield f"{place}: block {number} of C++ is not in given.txt"
        elif language == "json":
            try:
                json.loads(text)
            except ValueError as error:
                yield f"{place}: {error}"
            reader = JSON_READ.get(f"{file} {number}")
            if not reader or reader not in " ".join(shell.get(file, [])):
                yield f"{place}: no block of sh reads this block of JSON"
        elif language == "sh":
            joined = re.sub(r"\\\n", lambda m: " ", text)
            for offset, row in enumerate(joined.split("\n")):
                fault = fault_of_line(tree, folder, row)
                if fault:
                    yield f"{file}:{line + offset}: {fault}"
        elif not language:
            yield f"{place}: the block has no language"
        elif language not in REASONS:
            yield f"{place}: nothing checks blocks of {language}"
    for key in set(table) - keys:
        yield f"given.txt: there is no block {key}"


def main():
    arguments = sys.argv[1:]
    if arguments[0] == "--cpp":
        tree, out = pathlib.Path(arguments[1]), pathlib.Path(arguments[3])
        out.write_text(source_of(tree, given(pathlib.Path(arguments[2]))))
        return
    tree, folder = pathlib.Path(arguments[0]), pathlib.Path(arguments[2])
    found = list(faults(tree, given(pathlib.Path(arguments[1])), folder))
    print("\n".join(found))
    counts = collections.Counter(block[3] for block in blocks(tree))
    print(f"{sum(counts.values())} blocks, {len(found)} faults;",
          ", ".join(f"{count} {language}" for language, count in sorted(counts.items())))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
