# SPDX-License-Identifier: BSD-3-Clause
"""Texts of errors and warnings in C++ sources, with "..." in place of each value."""
import pathlib
import re

# Exceptions that end a loop silently: no user reads their text.
SILENT = {"Interrupted", "Stopped", "Cancelled", "StoppedWriting", "ComparisonStopped",
          "SearchStopped", "NoScratch", "EndedEarly", "GroupsApart"}
REPORTS = re.compile(
    r"(?<!new )\b(?:throw\s+(?P<type>[A-Za-z_:]+)|"
    r"(?P<call>\w*[Ff]ail\w*|require|refuse(?:Suite|Format)?|warn|blame|"
    r"(?:warnings|notes)_?\.(?:push|emplace)_back))\s*(?P<bracket>[({])")
LITERAL = re.compile(r'"((?:\\.|[^"\\])*)"')


def without_comments(text):
    """Comments become spaces; lines keep their numbers."""
    token = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|/\*.*?\*/|//[^\n]*', re.S)
    return token.sub(lambda m: m[0] if m[0][0] in "\"'" else re.sub(r"[^\n]", " ", m[0]), text)


def closed(text, begin):
    """The index of the bracket that closes the one at begin."""
    depth = 0
    for m in re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|[(){}\[\]]').finditer(text, begin):
        if m[0] in ("(", "{", "["):
            depth += 1
        elif m[0] in (")", "}", "]"):
            depth -= 1
            if depth == 0:
                return m.start()
    return len(text)


def parts(text, separator):
    """The expression cut at the separators outside brackets and texts."""
    found, begin, depth = [], 0, 0
    for m in re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|[(){}\[\]]|' +
                        separator).finditer(text):
        if m[0][0] in "\"'":
            continue
        if m[0] in ("(", "{", "["):
            depth += 1
        elif m[0] in (")", "}", "]"):
            depth -= 1
        elif depth == 0:
            found.append(text[begin:m.start()])
            begin = m.end()
    return found + [text[begin:]]


def skeletons(expression):
    """The texts that an expression may give: "..." for each value; `a ? "b" : "c"` gives two."""
    expression = re.sub(r'"\s*"', "", expression.strip())
    condition = parts(expression, r"\?")[0]
    if condition != expression:
        answers = parts(expression[len(condition) + 1:], r"(?<!:):(?!:)")
        return [text for part in answers for text in skeletons(part)]
    texts = [""]
    for part in parts(expression, r"(?<!\+)\+(?!\+)|<<"):
        part = part.strip()
        while part.startswith("(") and closed(part, 0) == len(part) - 1:
            part = part[1:-1].strip()
        wrapped = re.fullmatch(r'std::string\((\s*"(?:\\.|[^"\\])*"\s*)\)', part, re.S)
        part = wrapped[1].strip() if wrapped else part
        literal = LITERAL.fullmatch(part)
        if literal:
            choices = [literal[1].replace('\\"', '"')]
        elif '"' in part and len(parts(part, r"\?")) > 1:
            choices = skeletons(part)
        elif re.fullmatch(r"'(\\.|.)'", part):
            choices = [part[1:-1]]
        else:
            choices = ["..."]
        texts = [text + choice for text in texts for choice in choices][:32]
    return [re.sub(r"\.\.\.(?:\.\.\.)+", "...", " ".join(text.split())) for text in texts]


def messages_of(path):
    """(line, text) of each report in a source."""
    text = without_comments(path.read_text())
    for m in REPORTS.finditer(text):
        if (m["type"] or "").split("::")[-1] in SILENT:
            continue
        inside = text[m.end():closed(text, m.start("bracket"))]
        line = text.count("\n", 0, m.start()) + 1
        arguments = parts(inside, ",")
        if m["call"] == "require" and (len(arguments) > 2 or text[m.start() - 1] == "."):
            continue  # a rule; the text is "name = value, but must be rule" for all of them
        for argument in arguments:
            if LITERAL.search(argument):
                for skeleton in skeletons(argument):
                    if len(re.findall(r"[A-Za-z]+", skeleton)) > 1 and " " in skeleton:
                        yield line, skeleton


def sources(tree):
    """The sources of the programs and of the libraries below them."""
    for folder in ("apps", "modules"):
        for path in sorted((tree / folder).rglob("*")):
            if path.suffix in (".cpp", ".h", ".hpp") and "modules/python/" not in path.as_posix():
                yield path


def all_messages(tree):
    """(file, line, text), in the order of the files."""
    tree = pathlib.Path(tree)
    for path in sources(tree):
        for line, text in messages_of(path):
            yield path.relative_to(tree).as_posix(), line, text
