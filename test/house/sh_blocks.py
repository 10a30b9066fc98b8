#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the blocks of sh in the documents.
usage: sh_blocks.py TREE BIN WORK [WORD]
Runs each block of sh of all documents with `bash -e` in a folder of its own in the new folder WORK,
with the programs of BIN, the Python package beside BIN, the interpreter $PCL6D_PYTHON as python3, and
small inputs of the names in the block (sh_block_inputs.py). With WORD: only blocks whose place
`FILE:LINE` contains WORD. A block of another kind has its reason in a comment on the line before it:
    <!-- not run: installs packages -->
Blocks between `<!-- suite NAME -->` and its end were written by a program, which ran them.
Prints for each block whether it ran. Exit code 1: a block failed, left an output out, or has a
reason that is empty or stands before no block of sh.
"""
import dataclasses
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

from documents import documents, fences_of
from sh_block_inputs import FILE_NAMES, PYTHON_MADE, SHELL_MADE

SECONDS = 180  # that a block may take
# Messages of a build that was made without an optional library, or of a machine without it.
OPTIONAL = re.compile(r".*(?:GeoTIFF needs GDAL|OpenCV has no codec|cannot draw pictures|No module named '(?:pcl6d|numpy)').*")
REASON = re.compile(r"<!-- not run:(.*)-->$")
SUITE = re.compile(r"<!-- (end of )?suite \w+ -->$")


@dataclasses.dataclass
class Block:
    """A block of sh: its place FILE:LINE, its text, and the reason why it is not run, or None."""
    place: str
    text: str
    reason: str | None


def blocks_of(tree, path):
    """The blocks of a document in order, and one without text for each reason before no block of sh."""
    lines = path.read_text().split("\n")
    name = path.relative_to(tree)
    fences, found = list(fences_of(lines)), []
    inside = {number for fence in fences for number in range(fence.line, fence.line + fence.text.count("\n"))}
    for number, line in enumerate(lines, 1):
        if number not in inside and REASON.match(line) and lines[number:number + 1] != ["```sh"]:
            found.append((number, Block(f"{name}:{number}", "", None)))
    for fence in fences:
        if fence.language != "sh":
            continue
        before = REASON.match(lines[fence.line - 3]) if fence.line > 2 else None
        marks = [match for match in map(SUITE.match, lines[:fence.line]) if match]
        reason = before[1].strip() if before else None
        if reason is None and marks and not marks[-1][1]:
            reason = "written by pcl_slam6d_evaluate suite, which ran it"
        found.append((fence.line, Block(f"{name}:{fence.line}", fence.text, reason)))
    return [block for _, block in sorted(found, key=lambda row: row[0])]


def commands_of(text):
    """A block without its comments."""
    return re.sub(r"(^|\s)#.*", r"\1", text)


def inputs_of(text):
    """Names of the inputs that a block reads before it writes them."""
    words = re.findall(r"[^\s;]+", commands_of(text))
    written, found = set(), []
    for before, word in zip([""] + words, words):
        name = word.split("/")[0].strip("\"'")
        if before in ("-o", "--output", ">"):
            written.add(name)
        elif name not in written and name not in found and (name in SHELL_MADE or name in PYTHON_MADE):
            found.append(name)
    return found


def outputs_of(text):
    """Files and folders that a block names as its outputs."""
    return re.findall(r"(?:^|\s)(?:-o|--output) (\S+)", commands_of(text))


def run(text, folder, programs):
    """Runs lines of sh in a folder; returns the exit code and what they printed."""
    environment = {**os.environ, "PATH": f"{folder / '.python'}:{programs}:{os.environ['PATH']}"}
    with subprocess.Popen(["bash", "-e", "-c", text], cwd=folder, env=environment,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, errors="replace", start_new_session=True) as process:
        try:
            printed, _ = process.communicate(timeout=SECONDS)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            printed, _ = process.communicate()
            printed += f"\nstopped after {SECONDS} s"
    return process.returncode, printed


def make_input(name, folder, programs):
    """Makes an input in the folder of inputs, and all inputs that it is made of."""
    if (folder / name).exists():
        return
    script = SHELL_MADE.get(name)
    if script is None:
        needed, function = PYTHON_MADE[name]
        for other in needed:
            make_input(other, folder, programs)
        function(folder / name)
        return
    for other in inputs_of(script):
        if other != name:
            make_input(other, folder, programs)
    code, printed = run(script, folder, programs)
    if code or not (folder / name).exists():
        sys.exit(f"input {name}: exit code {code}\n{printed}")


def folder_of(block, tree, programs, work):
    """A new folder with the inputs of a block, the programs and the tree's folder share."""
    inputs, folder = work / "inputs", work / re.sub(r"\W", "_", block.place)
    inputs.mkdir(exist_ok=True)
    (folder / "build/release").mkdir(parents=True)
    (folder / "build/release/bin").symlink_to(programs)
    if (programs.parent / "python").exists():
        (folder / "build/release/python").symlink_to(programs.parent / "python")
    if "PCL6D_PYTHON" in os.environ:
        (folder / ".python").mkdir()
        (folder / ".python/python3").symlink_to(os.environ["PCL6D_PYTHON"])
    (folder / "share").symlink_to(tree / "share")
    for name in inputs_of(block.text):
        make_input(name, inputs, programs)
        made, file_name = inputs / name, FILE_NAMES.get(name, name)
        (shutil.copytree if made.is_dir() else shutil.copy)(made, folder / file_name)
    return folder


def outcome(block, tree, programs, work):
    """Runs a block; returns `ran`, `not run` or `FAILED`, and more about it."""
    if not block.text:
        return "FAILED", "the reason stands before no block of sh"
    if block.reason is not None:
        return ("not run", block.reason) if block.reason else ("FAILED", "the reason is empty")
    folder = folder_of(block, tree, programs, work)
    text = block.text
    for name, file_name in FILE_NAMES.items():
        text = re.sub(rf"\b{name}\b", file_name, text)
    start = time.monotonic()
    code, printed = run(text, folder, programs)
    seconds = f"{time.monotonic() - start:.1f} s"
    missing = [name for name in outputs_of(text) if not (folder / name).exists()]
    if code == 0 and not missing:
        shutil.rmtree(folder)
        return "ran", seconds
    optional = OPTIONAL.search(printed)
    if code and optional:
        return "not run", optional[0].strip()
    last = "\n    ".join(printed.strip().split("\n")[-12:])
    return "FAILED", f"exit code {code}, {seconds}\n    {last}" + (
        f"\n    not written: {' '.join(missing)}" if missing and code == 0 else "")


def main():
    """Runs all blocks and prints what became of them."""
    tree, programs, work = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    word = sys.argv[4] if len(sys.argv) > 4 else ""
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    counts = dict.fromkeys(("ran", "not run", "FAILED"), 0)
    for path in documents(tree):
        for block in blocks_of(tree, path):
            if word in block.place:
                kind, more = outcome(block, tree, programs, work)
                counts[kind] += 1
                print(f"{kind}: {block.place}: {more}", flush=True)
    print(f"{sum(counts.values())} blocks: {counts['ran']} ran, {counts['not run']} not run, with a reason, "
          f"{counts['FAILED']} failed")
    sys.exit(1 if counts["FAILED"] else 0)


if __name__ == "__main__":
    main()
