#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The folder that Sphinx reads: links to the documents of the tree, and beside these, in programs/,
a page for each program and each of its jobs, made of what the program says to --help and without
arguments, of programs.tsv (files, limits, documents) and of the commands in the documents.
usage: program_pages.py TREE FOLDER [PROGRAM...]
"""
import os
import pathlib
import re
import subprocess
import sys

LINKED = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "cmake", "modules", "share", "test"]
MOST_STEPS = 3
ENDINGS = ("bt|csv|e57|frames|g2o|html|json|kitti|las|laz|md|mcap|ot|pcd|pgm|ply|png|pose|ps|svg|tif|tum|txt|xml|yaml|yml")
# Words of plain text that are code: commands, options, files, and words with a letter of Markdown.
CODE = re.compile(rf"""`[^`]*` | mpirun\ .* | share/doc/(?P<document>\w+\.md) | (?P<unit>\[[^\]\s]+\])
  | (?<![^\s(])[^\s(]*[|<>\[\]*_^~$\\]\S*?(?=[),.;:]*(?:\s|$))
  | (?<![\w-])--?[a-z][\w-]*(?:=\S+)?
  | (?<![\w/])[\w/.-]*\w\.(?:{ENDINGS})\b""", re.X)


def said(*command):
    """Output and exit code of a program, each option of --help on a line of its own."""
    done = subprocess.run(command, env={**os.environ, "COLUMNS": "10000"}, timeout=60, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.stdout, done.returncode


def help_of(program, job):
    text, code = said(program, *job, "--help")
    if code:
        sys.exit(f"{program} {' '.join(job)} --help: exit code {code}")
    return text


def marked(text):
    """Plain text as Markdown: options and files as code, documents of share/doc as links."""
    def code(match):
        if match["document"]:
            return f"[{match['document']}](../share/doc/{match['document']})"
        if match["unit"]:
            return f"\\[{match['unit'][1:-1]}\\]"
        return match[0] if match[0].startswith("`") else f"`{match[0]}`"

    return CODE.sub(code, text)


def cell(text):
    return marked(text).replace("|", "\\|")


class Help:
    """The parts of a text of --help."""

    def __init__(self, text):
        lines = text.rstrip().split("\n")
        lines = lines[:-1] if lines[-1].startswith("Errors and warnings, with cause") else lines
        start = next((i for i in range(1, len(lines)) if lines[i] and not lines[i].startswith(" " * 7)), 1)
        self.usages = [line[7:] for line in lines[:start]]
        options = next((i for i in range(start, len(lines) - 1) if self.is_group(lines, i)), len(lines))
        prose = "\n".join(lines[start:options])
        has_jobs = "--help tells the options" in prose
        prose = re.sub(r"(?:^|; )pcl_\S+ \S+ --help tells the options\.?$", "", prose, flags=re.M)
        self.jobs = re.findall(r"^  ([a-z][a-z-]*)(?: \S+)*(?:  +(.*))?$", prose, re.M) if has_jobs else []
        self.about, self.exits = self.without_exits(prose)
        self.groups = self.read_groups(lines[options:])

    @staticmethod
    def is_group(lines, i):
        return re.fullmatch(r"[A-Z][^.]*:", lines[i]) and re.match(r"  -", lines[i + 1])

    @staticmethod
    def without_exits(prose):
        """What the text says of exit codes stands apart."""
        match = re.search(r"^Exit codes? \d.*?(?=\n\n|\Z)", prose, re.M | re.S)
        return (prose[:match.start()] + prose[match.end():], " ".join(match[0].split())) if match else (prose, "")

    @staticmethod
    def read_groups(lines):
        groups = []
        for i, line in enumerate(lines):
            if i + 1 < len(lines) and Help.is_group(lines, i):
                groups.append((line[:-1], []))
            elif line.startswith("  -"):
                name, _, text = line[2:].partition("  ")
                groups[-1][1].append((name, text.strip()))
            elif line.strip() and groups and groups[-1][1]:
                name, text = groups[-1][1][-1]
                groups[-1][1][-1] = (name, f"{text} {line.strip()}")
        return groups

    def paragraphs(self):
        """The text in Markdown; indented lines and jobs are lists."""
        blocks, lines = [], []
        for line in self.about.split("\n") + [""]:
            is_list = line.startswith("  ")
            if lines and (not line.strip() or is_list != lines[0].startswith("  ")):
                blocks.append(lines)
                lines = []
            if line.strip():
                lines.append(line)
        for block in blocks:
            if block[0].startswith("  "):
                yield "\n".join("- " + list_entry(line.strip()) for line in block)
            else:
                yield marked(re.sub(r"- (?=\w)", "-", " ".join(block)) if "-\n" in "\n".join(block) else " ".join(block))


def list_entry(line):
    """`name  text` or `name: text`; else an example, as code."""
    match = re.match(r"(\S.*?)(?:  +|: )(\S.*)", line)
    return f"`{match[1]}`: {marked(match[2])}" if match else f"`{line}`"


def first_steps(program):
    """The purpose, and (command, what it gives), that the program prints without arguments."""
    text, _ = said(program)
    name = pathlib.Path(program).name
    purpose = text.split("\n")[0][len(name) + 1:]
    return purpose[:1].upper() + purpose[1:], re.findall(rf"^  ({name} .*?)  +(\S.*)$", text, re.M)


def commands_of(tree):
    """(command, comment, document) of the lines in the documents that call a program."""
    for path in sorted((tree / "share/doc").glob("*.md")):
        if path.name.startswith("from_"):  # parts of commands beside those of other programs
            continue
        text = path.read_text()
        blocks = re.findall(r"^```(?:sh)?\n(.*?)^```", text, re.S | re.M) + re.findall(r"^    (pcl_.*)", text, re.M)
        for line in "\n".join(blocks).split("\n"):
            command, _, comment = line.partition(" #")
            yield command.strip(), comment.strip(), path.name
        for command in re.findall(r"`(pcl_slam6d[^`\n]*)`", text):
            yield command, "", path.name


def steps_of(call, own, commands):
    """Up to three commands of a job: those of the program first, then those of documents."""
    steps = [(command, what) for command, what in own if calls(command, call)]
    for command, comment, document in commands:
        is_known = any(command == other for other, _ in steps)
        is_plain = calls(command, call) and not re.search(r"\.\.\.|[\\;&>]|\|", command) and "--help" not in command
        if len(steps) < MOST_STEPS and is_plain and not is_known and len(command.split()) > len(call.split()) + 1:
            link = f"[{document}](../share/doc/{document})"
            steps.append((command, f"{marked(comment)} ({link})" if comment else f"from {link}"))
    return steps[:MOST_STEPS]


def calls(command, call):
    return command.split()[:len(call.split())] == call.split()


def exit_codes(tree):
    """The rows of the man pages."""
    text = (tree / "share/man/help_to_man.awk").read_text()
    return re.findall(r'print "\.TP\\n\.B (\d+)\\n([^"]*)"', text)


def options_text(groups):
    for caption, rows in groups:
        yield f"\n### {caption}\n\n| option | what it does |\n|---|---|\n" + "".join(
            f"| {option_name(name)} | {cell(text)} |\n" for name, text in rows)


def option_name(name):
    """`-o, --output FILE (=map)`: the default stands outside of the code."""
    match = re.fullmatch(r"(.*?)(?: \(=(.*)\))?", name)
    default = f", default `{match[2]}`" if match[2] else ""
    return f"`{match[1]}`{default}".replace("|", "\\|")


def page(call, purpose, text, steps, facts, codes):
    """The page of a program, or of one of its jobs."""
    documents = ", ".join(f"[{name}](../share/doc/{name})" for name in facts["documents"].split())
    parts = [f"# {call}\n", purpose + "\n", "\n\n".join(text.paragraphs()) + "\n", f"More: {documents}\n"]
    parts.append("## First steps\n\n" + "".join(
        f"{i}. {what}\n\n   ```sh\n   {command}\n   ```\n\n" for i, (command, what) in enumerate(steps, 1)))
    parts.append("## Call\n\n```text\n" + "\n".join(text.usages) + "\n```\n")
    parts += ["## Files it writes\n", facts["files"] + "\n", "## Limits\n", facts["limits"] + "\n"]
    parts.append("## Exit codes\n\n" + (marked(text.exits) + "\n\n" if text.exits else "") +
                 "| exit code | meaning |\n|---|---|\n" + "".join(f"| {code} | {what} |\n" for code, what in codes) +
                 "\nErrors and warnings, with cause and remedy: [messages.md](../share/doc/messages.md)\n")
    if text.groups:
        parts.append("## Options\n" + "".join(options_text(text.groups)))
    return "\n".join(parts)


def read_facts(file):
    rows = [line.split("\t") for line in file.read_text().split("\n") if line and line[0] != "#"]
    for row in rows:
        if len(row) != 4:
            sys.exit(f"{file}: {row[0]}: {len(row)} columns, but must have 4")
    return {call: dict(documents=documents, files=files, limits=limits) for call, documents, files, limits in rows}


def pages_of(tree, programs):
    """(call, page, what it is for) of each program, followed by its jobs."""
    facts, codes, commands = read_facts(tree / "share/site/programs.tsv"), exit_codes(tree), list(commands_of(tree))
    seen = []
    for program in programs:
        name = pathlib.Path(program).name
        text = Help(help_of(program, []))
        purpose, own = first_steps(program)
        for job, what in [("", purpose)] + text.jobs:
            call = f"{name} {job}".strip()
            seen.append(call)
            if call not in facts:
                sys.exit(f"programs.tsv: no row of {call}")
            part = Help(help_of(program, [job])) if job else text
            steps = own if not job else steps_of(call, own, commands)
            steps = steps or [(part.usages[0].replace(" [options]", ""), "the call, without its options")]
            what = marked(what[:1].upper() + what[1:].rstrip(".") + ".")
            yield call, page(call, what, part, steps, facts[call], codes), what
    for call in sorted(set(facts) - set(seen)):
        sys.exit(f"programs.tsv: there is no {call}")


def write_pages(tree, folder, programs):
    pages = list(pages_of(tree, programs)) if programs else []
    calls_of, texts = {}, {}
    for call, text, what in pages:
        program = call.split()[0]
        calls_of.setdefault(program, []).append((call.replace(" ", "-"), call, what))
        texts[call.replace(" ", "-")] = text
    for program, calls_ in calls_of.items():
        if len(calls_) > 1:
            texts[program] += "\n## Jobs\n\n```{toctree}\n:maxdepth: 1\n\n" + "".join(
                f"{name}\n" for name, _, _ in calls_[1:]) + "```\n"
    index = "# Programs\n\n" + ("Each page is made of what the program says to `--help`.\n" if pages else
                                "This site was made without the programs.\n")
    if pages:
        index += "\n| call | what it is for |\n|---|---|\n" + "".join(
            f"| [{call}]({name}.md) | {what} |\n" for rows in calls_of.values() for name, call, what in rows)
        index += "\n```{toctree}\n:maxdepth: 1\n:hidden:\n\n" + "".join(f"{program}\n" for program in calls_of) + "```\n"
    texts["index"] = index
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.md"):
        if old.stem not in texts:
            old.unlink()
    for name, text in texts.items():
        path = folder / f"{name}.md"
        if not path.exists() or path.read_text() != text:  # Sphinx reads what is newer
            path.write_text(text)
    return len(texts)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    tree, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    count = write_pages(tree, folder / "programs", sys.argv[3:])
    for name in LINKED:
        link = folder / name
        if link.is_symlink():
            link.unlink()
        link.symlink_to(tree / name)
    print(f"{count} pages of programs")


if __name__ == "__main__":
    main()
