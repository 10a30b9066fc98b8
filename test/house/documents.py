# SPDX-License-Identifier: BSD-3-Clause
"""The documents of a tree and their fenced blocks, for blocks.py and sh_blocks.py."""
import dataclasses

PATTERNS = ("*.md", "modules/*/*.md", "share/**/*.md", "test/benchmark/*.md")


@dataclasses.dataclass
class Fence:
    """A fenced block: the number of its first line, its language (empty: none), the words behind the
    language, and its text."""
    line: int
    language: str
    words: str
    text: str


def documents(tree):
    """All documents, in a fixed order."""
    return [path for pattern in PATTERNS for path in sorted(tree.glob(pattern))]


def fences_of(lines):
    """The fenced blocks among the lines of a document."""
    opened = None
    for number, line in enumerate(lines):
        if not line.lstrip().startswith("```"):
            continue
        if opened is None:
            opened = number
            continue
        language, _, words = lines[opened].strip()[3:].partition(" ")
        yield Fence(opened + 2, language, words, "".join(row + "\n" for row in lines[opened + 1:number]))
        opened = None
    if opened is not None:
        yield Fence(opened + 2, "", "", "")  # never closed
