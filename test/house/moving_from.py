#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pages for users of other programs name options that our programs have.
usage: moving_from.py BIN_DIR PAGE ...
Checks the cells behind the first of each row of a table: `pcl_slam6d_x job --option value`, or
`--option value` of pcl_slam6d. The second cell names a counterpart or says why there is none.
"""
import functools
import os
import pathlib
import re
import subprocess
import sys


@functools.lru_cache(maxsize=None)
def help_of(folder, command):
    words = [str(folder / command[0]), *command[1:], "--help"]
    if not os.access(words[0], os.X_OK):
        return ""
    answer = subprocess.run(words, capture_output=True, text=True,
                            env={**os.environ, "COLUMNS": "10000"})
    return answer.stdout if answer.returncode == 0 else ""


def fault_of(folder, text):
    """What is wrong with a command line, or an empty text."""
    words = text.split()
    if words[0].startswith("--"):
        words.insert(0, "pcl_slam6d")
    first = next((i for i, word in enumerate(words) if word.startswith("-")), len(words))
    job = [word for word in words[1:first] if re.fullmatch("[a-z]+", word)][:1]
    command = (words[0], *(job if words[0] not in ("pcl_slam6d", "pcl_slam6d_simulate") else []))
    text = help_of(folder, command)
    if not text:
        return " ".join(command) + " --help fails"
    for word, value in zip(words[first:], words[first + 1:] + [""]):
        if not word.startswith("--"):
            continue
        line = re.search(rf"\n  (?:-., )?{re.escape(word)}(?: .*)?", text)
        if not line:
            return f"{' '.join(command)} --help does not know {word}"
        listed = re.search(r"  ([a-z0-9-]+(?:\|[A-Za-z0-9-]+)+)", line[0])
        is_number = re.fullmatch(r"[A-Z0-9.]+", value)
        if value and listed and not is_number and value not in listed[1].split("|"):
            return f"{' '.join(command)} --help: {word} has no {value}"
    return ""


def faults(folder, page):
    for number, line in enumerate(page.read_text().split("\n"), 1):
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if len(cells) < 2 or set(cells[0]) <= {"-"} or cells[1] == "here":
            continue
        if not re.match(r"no counterpart, because [^;]{15}|not needed: |\[|.*`", cells[1]):
            yield f"{page.name}:{number}: names no counterpart and no reason: {cells[0]}"
        for text in re.findall(r"`([^`]+)`", " ".join(cells[1:])):
            fault = fault_of(folder, text) if re.match("pcl_slam6d|--", text) else ""
            if fault:
                yield f"{page.name}:{number}: {fault}"


def main():
    found = [fault for page in sys.argv[2:]
             for fault in faults(pathlib.Path(sys.argv[1]), pathlib.Path(page))]
    print("\n".join(found) or "all options are known")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
