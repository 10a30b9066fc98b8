#!/usr/bin/env bash
# Processor time and peak memory of every compilation, by target, with the ten worst files.
# usage: test/build_cost.sh [--update] [--from LOG] [TARGET]     (default: all)
#   TARGET: of the build, such as demo. --update: writes the table test/build_cost.txt
#   --from LOG: reads the log of an earlier build (build/cost/cost.log) instead of building
# It builds anew in build/cost, without ccache; a launcher logs `user system KB wall output`.
# Exit code 1: a compilation takes more than the bar, 1024 MB or 40 s of a processor as fast as
# that of the table. How fast this one is tells a fixed piece of the standard library, compiled
# three times first: the bar is 40 s times its seconds here by those in the table.
# Only a warning: a target that, measured by the sum of all targets that are in both tables,
# grew by more than 25 % and 5 s; that holds on any machine.
set -euo pipefail
if [ "${1:-}" = --launch ]; then # LOG COMMAND ...: the launcher
  log=$2 out=link
  shift 2
  for ((i = 1; i < $#; i++)); do
    [ "${!i}" != -o ] || { j=$((i + 1)) && out=${!j}; }
  done
  exec /usr/bin/time -q -a -o "$log" -f "%U %S %M %e $out" "$@"
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."
table=test/build_cost.txt log=$PWD/build/cost/cost.log
update=no from="" target=all
while [ $# -gt 0 ]; do
  case $1 in
    --update) update=yes ;;
    --from) from=${2:?--from needs a file}; shift ;;
    -*) sed -n '2,12s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
    *) target=$1 ;;
  esac
  shift
done

reference() { # how fast this processor compiles: three lines `... reference`
  local source
  source=$(mktemp --suffix .cpp)
  printf '#include <regex>\n#include <map>\nstd::map<int, std::regex> all; bool f(const char* s) { return std::regex_match(s, all[1]); }\n' >"$source"
  for _ in 1 2 3; do
    /usr/bin/time -q -a -o "$1" -f "%U %S %M %e reference" g++ -std=c++17 -O2 -c "$source" -o /dev/null
  done
  rm "$source"
}
if [ -n "$from" ]; then
  log=$from
else
  [ -x /usr/bin/time ] ||
    { echo "build_cost.sh: no /usr/bin/time: cmake/install_dependencies.sh --checks" >&2; exit 2; }
  rm -rf build/cost && mkdir -p build/cost
  reference "$log"
  cmake --preset release -B build/cost --log-level=WARNING \
    -D CMAKE_CXX_COMPILER_LAUNCHER="$PWD/test/build_cost.sh;--launch;$log"
  cmake --build build/cost --target "$target"
fi
[ -s "$log" ] || { echo "build_cost.sh: nothing is logged in $log" >&2; exit 2; }

status=0
python3 - "$log" "$table" "$update" <<'END_OF_PYTHON' || status=$?
import collections, os, re, sys

log, table, update = sys.argv[1:]
BAR_SECONDS, BAR_MB, GROWTH, LEAST = 40, 1024, 1.25, 5
units, reference = {}, []
for line in open(log):
    words = line.split()
    try:
        seconds, mb, output = float(words[0]) + float(words[1]), int(words[2]) / 1024, words[4]
    except (ValueError, IndexError):
        continue  # "Command exited with ...", a line that is still being written
    if output == "reference":
        reference.append(seconds)
    elif re.search(r"\.(o|gch)$", output):
        units[output] = (seconds, mb)  # the last one, where it was compiled twice
if not units:
    sys.exit("build_cost.sh: no compilation in " + log)
unit_second = min(reference, default=None)

def target_of(output):
    found = re.search(r"([^/]*)/CMakeFiles/([^/]*)\.dir/", "/" + output)
    return found.group(2) if found else "other"

now = collections.defaultdict(lambda: [0.0, 0, 0.0])
for output, (seconds, mb) in units.items():
    row = now[target_of(output)]
    row[0], row[1], row[2] = row[0] + seconds, row[1] + 1, max(row[2], mb)
print("%-34s %9s %6s %9s" % ("target", "seconds", "units", "peak MB"))
for name in sorted(now, key=lambda n: -now[n][0]):
    print("%-34s %9.1f %6d %9.0f" % (name, *now[name]))
print("%-34s %9.1f %6d" % ("total", sum(r[0] for r in now.values()), len(units)))
print("\nthe ten worst files\n%9s %9s" % ("seconds", "MB"))
for output, (seconds, mb) in sorted(units.items(), key=lambda u: -u[1][0])[:10]:
    print("%9.1f %9.0f  %s" % (seconds, mb, output))

before, before_second = {}, None
if os.path.exists(table):
    for line in open(table):
        if line.startswith("#"):
            continue
        name, seconds, _ = line.split()
        if name == "reference":
            before_second = float(seconds)
        else:
            before[name] = float(seconds)
else:
    print("\nno table %s: nothing to compare with (--update writes it)" % table)
common = [name for name in now if name in before]
if common:
    scale = sum(now[n][0] for n in common) / max(sum(before[n] for n in common), 1e-9)
    for name in common:
        expected = before[name] * scale
        if now[name][0] > GROWTH * expected and now[name][0] > expected + LEAST:
            print("warning: %s takes %.1f s, where the others let expect %.1f s"
                  % (name, now[name][0], expected))
speed = unit_second / before_second if unit_second and before_second else 1.0
bar = BAR_SECONDS * speed
worse = {o: u for o, u in units.items() if u[0] > bar or u[1] > BAR_MB}
print("\nbar: %.1f s (this machine takes %.2f of the table's time), %d MB: %d of %d files pass it"
      % (bar, speed, BAR_MB, len(worse), len(units)))
for output, (seconds, mb) in sorted(worse.items(), key=lambda u: -u[1][0]):
    print("above the bar: %6.1f s %6.0f MB  %s" % (seconds, mb, output))
if update == "yes":
    with open(table, "w") as out:
        out.write("# Written by test/build_cost.sh --update: target, seconds of processor time, units\n")
        if unit_second:
            out.write("reference %.2f 1\n" % unit_second)
        for name in sorted(now):
            out.write("%s %.1f %d\n" % (name, now[name][0], now[name][1]))
sys.exit(1 if worse else 0)
END_OF_PYTHON
exit $status
