#!/usr/bin/env bash
# How plainly comments, messages and documents speak. Counts words that point at something without
# naming it ("it", "those", "so many"), sentences in which every fourth word does, and
# words for which the field has a term (test/house/terms.txt: `word term`).
# usage: test/language.sh [--list N] [TREE]       (TREE: a folder of sources, default: this one)
#   --list N: the N worst texts of each kind, with file and line
# Exit code 1: a kind of text is above its bar in TREE/test/house/language_bars.txt, which is
# lowered as texts get better and never raised; 2: TREE has no texts or no bars.
set -euo pipefail
home=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
list=0
while [[ ${1:-} = --* ]]; do
  case $1 in
    --list) list=${2:?--list needs a number}; shift ;;
    *) sed -n '2,9s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
  esac
  shift
done
exec python3 - "$home/test/house/terms.txt" "${1:-$home}" "$list" <<'END_OF_PYTHON'
import pathlib, re, sys

terms, tree, most = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3])
POINTING = set("""it its they them that those these this one ones what which who whom whose other
others all none some so such same as there nobody somebody something anything nothing thing
things""".split())
LEAST_WORDS, LEAST_OF_HEAVY, HEAVY_SHARE = 5, 12, 0.25  # shorter texts are captions
rows = [line.split(None, 1) for line in open(terms) if line.strip() and line[0] != "#"]
WRONG = re.compile(r"\b(" + "|".join(word.replace("_", " ") for word, _ in rows) + r")\b", re.I)


def line_of(text, at):
    return text.count("\n", 0, at) + 1


def comments(text):
    block = re.compile(r"/\*.*?\*/|^[ \t]*//[^\n]*(?:\n[ \t]*//[^\n]*)*|//[^\n]*", re.S | re.M)
    for found in block.finditer(text):
        lines = [re.sub(r"^\s*(?:/\*+|\*+/|\*|//+)[!<]*|\*/\s*$", "", l)
                 for l in found[0].split("\n")]
        said = " ".join(" ".join(lines).split())
        if "SPDX" not in said:
            yield line_of(text, found.start()), said


def messages(text):
    text = re.sub(r'"(\s*\n\s*)"', r"\1", text)  # adjacent literals are one text
    for found in re.finditer(r'"((?:\\.|[^"\\])*)"', text):
        said = " ".join(found[1].split())
        if len(re.findall(r"[A-Za-z']+", said)) >= 4:
            yield line_of(text, found.start()), said


def documents(text):
    is_code = False
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith("```"):
            is_code = not is_code
        elif not is_code:
            line = re.sub(r"`[^`]*`", " ", line)
            line = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", line)
            for said in re.split(r"(?<=[.;:!?])\s+|\|", line):
                yield number, said.strip(" #*>-")


def files(*patterns):
    for pattern in patterns:
        yield from sorted(tree.glob(pattern))


KINDS = {
    "comments": (comments, files("modules/**/*.h", "modules/**/*.cpp", "modules/**/*.hpp",
                                 "apps/**/*.h", "apps/**/*.cpp")),
    "messages": (messages, files("modules/**/*.cpp", "apps/**/*.cpp")),
    "documents": (documents, files("*.md", "share/**/*.md", "modules/**/*.md", "apps/**/*.md")),
}
try:
    bars = {row[0]: [float(value) for value in row[1:]]
            for row in (line.split() for line in open(tree / "test/house/language_bars.txt"))
            if row and row[0] in KINDS}
except OSError as error:
    print(f"language.sh: no bars: {error}", file=sys.stderr)
    sys.exit(2)
total, is_above = 0, False
for kind, (texts, paths) in KINDS.items():
    words = pointing = long = heavy = 0
    wrong, worst = 0, []
    for path in paths:
        for line, said in texts(path.read_text(errors="replace")):
            spoken = [word.lower() for word in re.findall(r"[A-Za-z']+", said)]
            if len(spoken) < LEAST_WORDS:
                continue
            vague = sum(word in POINTING for word in spoken)
            is_heavy = vague > HEAVY_SHARE * len(spoken)
            misnamed = len(WRONG.findall(said))
            words, pointing, wrong = words + len(spoken), pointing + vague, wrong + misnamed
            if len(spoken) >= LEAST_OF_HEAVY:
                long, heavy = long + 1, heavy + is_heavy
            if misnamed or is_heavy:
                worst.append((misnamed + is_heavy * vague, f"{path.relative_to(tree)}:{line}: {said[:200]}"))
    total += words
    if words == 0:
        continue
    figures = [100 * pointing / words, 100 * heavy / max(long, 1), wrong]
    # as many digits as printed: a bar is what was printed
    above = [round(figure, 1) > bar for figure, bar in zip(figures, bars.get(kind, [0, 0, 0]))]
    is_above = is_above or any(above)
    print(f"{kind}: {words} words, {figures[0]:.1f} % pointing, {figures[1]:.1f} % of {long} sentences heavy, "
          f"{wrong} words with a better term" + ("; above the bar" if any(above) else ""))
    for _, said in sorted(worst, key=lambda row: -row[0])[:most]:
        print("   ", said)
if total == 0:
    print(f"language.sh: no texts below {tree}", file=sys.stderr)
sys.exit(2 if total == 0 else 1 if is_above else 0)
END_OF_PYTHON
