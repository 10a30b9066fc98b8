#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every error and warning of the programs has an entry in share/doc/messages.md.
usage: messages.py TREE
Prints the texts of TREE's sources without an entry, with file and line; entries of texts that no
source has; and rows out of order. Exit code 1: there are some.
"""
import pathlib
import re
import sys

from message_texts import all_messages, sources, without_comments


def rows(page):
    """(line, texts of the first cell, section) of each row of the tables."""
    section = ""
    for number, line in enumerate(page.split("\n"), 1):
        if line.startswith("## "):
            section = line[3:]
        cells = re.split(r"(?<!\\)\|", line)
        texts = re.findall(r"`([^`]+)`", cells[1]) if len(cells) == 5 else []
        if texts:
            yield number, texts, section
            if not (cells[2].strip() and cells[3].strip()):
                sys.exit(f"messages.md:{number}: cause or remedy is missing")


def pattern(text):
    """What finds an entry in the text of a message: "..." stands for anything."""
    return re.compile(".*".join(re.escape(part) for part in text.split("...")), re.S)


def order(text):
    return re.sub(r"[^a-z0-9 ]", "", text.lower()).strip()


def is_in_sources(text, literals):
    return all(part.strip() in literals for part in text.split("..."))


def faults(tree):
    """Lines that say what is wrong with the page."""
    page = list(rows((tree / "share/doc/messages.md").read_text()))
    entries = {text: pattern(text) for _, texts, _ in page for text in texts}
    unused = set(entries)
    for file, line, text in all_messages(tree):
        found = [entry for entry, finds in entries.items() if finds.search(text)]
        unused.difference_update(found)
        if not found:
            yield f"{file}:{line}: no entry in messages.md for: {text}"
    literals = ""
    for path in sources(tree):
        code = re.sub(r'(?<!\\)"\s*"', "", without_comments(path.read_text()))
        literals += "\n".join(re.findall(r'"((?:\\.|[^"\\\n])*)"', code)).replace('\\"', '"') + "\n"
    for number, texts, _ in page:
        for text in texts:
            if text in unused and not is_in_sources(text, literals):
                yield f"messages.md:{number}: no source says: {text}"
            if len(re.findall(r"[A-Za-z]", text)) < 4:
                yield f"messages.md:{number}: finds too much: {text}"
    for (_, before, section), (number, after, same) in zip(page, page[1:]):
        if section == same and order(before[0]) > order(after[0]):
            yield f"messages.md:{number}: stands behind '{before[0]}', out of order"


def main():
    tree = pathlib.Path(sys.argv[1])
    found = list(faults(tree))
    print("\n".join(found))
    print(f"{sum(1 for _ in all_messages(tree))} messages, {len(found)} faults")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
