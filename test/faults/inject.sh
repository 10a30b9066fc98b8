#!/usr/bin/env bash
# Makes each call of each program to the system fail in turn (inject.h) and looks at what is
# left: no crash, no hang, the error in words, the old result whole or the new one, nothing
# beside it, and the next run as if nothing had been.
# usage: test/faults/inject.sh [--kinds KIND,...] [--modes MODE,...] [--every K] [--positions N]
#                              [--build DIR] [--list] [PROGRAM ...]
#   --every K: each K-th allocation (default 499); of all else each call
#   --positions N: at most N of a kind, evenly (default: all)
#   --build DIR: default build/release; the library must be built there (pcl6d_inject)
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build/release
declare -A modes_of=([write]="fail from short kill" [read]=fail [open]=fail
  [rename]="fail kill" [unlink]=fail [mkdir]=fail [truncate]=fail [sync]="fail kill"
  [map]=fail [malloc]=fail [fork]=fail [thread]=fail)
kinds=(write read open rename unlink mkdir truncate sync map fork thread malloc)
wanted_modes="" every=499 positions=1000000 list=no
programs=()
while [ $# -gt 0 ]; do
  case $1 in
    --kinds) IFS=, read -ra kinds <<<"$2"; shift ;;
    --modes) wanted_modes=${2//,/ }; shift ;;
    --every) every=$2; shift ;;
    --positions) positions=$2; shift ;;
    --build) build=$(realpath "$2"); shift ;;
    --list) list=yes ;;
    -*) sed -n '2,10s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
    *) programs+=("$1") ;;
  esac
  shift
done
bin=$build/bin
library=$build/lib/libpcl6d_inject.so
# shellcheck source=test/faults/inject_cases.sh
source "$root/test/faults/inject_cases.sh"
[ $list = no ] || { printf '%s\n' "${cases[@]}"; exit 0; }
[ ${#programs[@]} -gt 0 ] || programs=("${cases[@]}")
for program in "${programs[@]}"; do
  declare -F "new_$program" >/dev/null ||
    { echo "inject.sh: no case is called $program; --list tells which there are" >&2; exit 2; }
done
for kind in "${kinds[@]}"; do
  [ -n "${modes_of[$kind]:-}" ] ||
    { echo "inject.sh: no kind is called $kind; there are ${!modes_of[*]}" >&2; exit 2; }
done
[ -f "$library" ] || { echo "inject.sh: build it first: target pcl6d_inject" >&2; exit 2; }

base=$(mktemp -d "${TMPDIR:-/tmp}/pcl6d_inject.XXXXXX")
trap 'rm -rf "$base"' EXIT
fixtures=$base/fixtures
work=$base/work
export TMPDIR=$base/tmp
unset DISPLAY
mkdir -p "$fixtures" "$TMPDIR"
make_fixtures "$fixtures" || { echo "inject.sh: the fixtures cannot be made" >&2; exit 1; }

files_of() { # FOLDER: a line `hash  name` for each file, `folder  name` for each folder
  (cd "$1" && {
    find . -mindepth 1 -type d -printf 'folder  %p\n'
    find . ! -type d -print0 | xargs -0 -r sha256sum
  } | LC_ALL=C sort -k 2)
}

stable() { # with hashes of those files alone that two runs write alike
  awk -v list="$base/varying" '
    BEGIN { while ((getline name < list) > 0) varies[name] }
    $2 in varies { $1 = "varies" }
    { print $1 "  " $2 }'
}

prepare() { # the folder as the earlier run left it
  rm -rf "$work" "${TMPDIR:?}"/*
  cp -a "$base/old" "$work"
}

ending=KILL # the signal for what hangs
run() { # [VARIABLE=VALUE ...]: runs the command; its exit code
  # env starts the program itself: the library arms the first process that loads it
  (cd "$work" && exec timeout -s "$ending" -k 5 20 env "$@" "${command[@]}" \
    >"$base/out" 2>"$base/err")
}

# Runs of the program without faults: what is old, what is new, and what varies.
learn() { # PROGRAM
  rm -rf "$base/old" "$work" && mkdir "$base/old"
  (cd "$base/old" && "old_$1") || return 1
  files_of "$base/old" >"$base/old.list"
  "new_$1"
  : >"$base/varying"
  prepare
  run LD_PRELOAD="$library"
  usual_exit=$?
  files_of "$work" >"$base/first.list"
  prepare
  run LD_PRELOAD="$library"
  files_of "$work" >"$base/second.list"
  diff "$base/first.list" "$base/second.list" | awk '/^[<>]/ { print $3 }' |
    LC_ALL=C sort -u >"$base/varying"
  stable <"$base/first.list" >"$base/new.list"
  { [ $usual_exit = 0 ] || [ $usual_exit = 3 ]; } && ! cmp -s "$base/old.list" "$base/new.list"
}

# What the folder holds: old, new, unpainted (new without pictures), or a mix. A journal and,
# of a program that was killed or cannot remove, the hidden folder beside the result may be
# there; so it may without memory, as nlohmann's JSON needs some to be destroyed and ends the
# program if there is none. The next run removes it: repeat() looks.
state() { # MODE
  local hidden='journal'
  [[ "$1 $kind" != kill* && "$kind" != unlink && "$kind" != malloc ]] || hidden='journal|/\.[^/]*pcl6d'
  files_of "$work" | grep -vE "  .*($hidden)" >"$base/now.list"
  stable <"$base/now.list" >"$base/now.stable"
  if cmp -s "$base/now.list" "$base/old.list"; then
    echo old
  elif cmp -s "$base/now.stable" "$base/new.list"; then
    echo new
  elif diff <(grep -vE '\.(png|html|webm|mp4)$|summary.json$' "$base/new.list") \
    <(grep -vE '\.(png|html|webm|mp4)$|summary.json$' "$base/now.stable") >/dev/null &&
    [ -z "$(LC_ALL=C comm -13 <(awk '{print $2}' "$base/new.list") <(awk '{print $2}' "$base/now.stable"))" ]; then
    echo unpainted
  else
    echo mix
  fi
}

found() { # WHAT: a finding of the current position
  findings=$((findings + 1))
  echo "FINDING $program $kind $mode at $at: $1"
  tail -n 2 "$base/err" | cut -c 1-300 | sed 's/^/    /'
}

# Libraries that cannot go on without what fails here:
#   libtbb: ends the process when it gets no thread, waits for ever when it gets no memory
#   swrast_dri, libGLX_mesa (Mesa's drawing): use memory that they did not get, and wait for
#     threads that they could not start
#   libLLVM (Mesa's compiler): ends the process when it gets no memory
#   libX11, libxcb: end the process after Mesa has not read an answer of the X server
others='libtbb|swrast_dri|libGLX_mesa|libLLVM|libX11|libxcb'

# Where a call came from, past the C and C++ libraries and the program's own operator new and
# handler of std::terminate: a line for each trace
callers() {
  awk '
    /^\[inject: / { if (open) print "?"; open = 1; held = ""; next }
    !open || !/^\// { next }
    /libpcl6d_inject|libc\.so|libm\.so|libgcc|ld-linux|_Znw|_Zna/ { next }
    /libstdc\+\+/ { held = ""; next }
    held != "" { print held; open = 0; next }
    /\/bin\// { held = $0; next }
    { print; open = 0 }
    END { if (open) print (held == "" ? "?" : held) }' "$base/err"
}

# Whether a program ended or hangs in a library that is not ours: the call that failed and what
# ended it, or what it waits in, are both of there. Threads that race shift the calls by a few
# between runs, so that it is tried again until it ends by a signal, or hangs, as before.
is_foreign() {
  local try
  for try in 1 2 3 4 5 6 7 8; do
    prepare
    ending=ALRM run LD_PRELOAD="$library" PCL6D_INJECT_KIND="$kind" \
      PCL6D_INJECT_MODE="$mode" PCL6D_INJECT_AT="$at" PCL6D_INJECT_TRACE=1 2>/dev/null
    [ $? -lt 124 ] || break # 124: of timeout
  done
  [ "$(callers | wc -l)" -ge 2 ] && ! callers | grep -qvE "/($others)[^/]*\$"
}

judge() { # EXIT
  local exit=$1 now
  now=$(state "$mode")
  if [ "$mode" = kill ]; then
    [ "$exit" = 137 ] || [ "$exit" = "$usual_exit" ] || found "exit $exit of a killed program"
    [ "$now" != mix ] || found "killed, it leaves neither the old nor the new result"
    return
  fi
  if [ "$exit" -ge 128 ] && [ "$exit" != 130 ]; then
    if is_foreign; then
      foreign=$((foreign + 1))
    elif [ "$exit" = 137 ]; then
      found "hangs: more than 20 s"
    else
      found "crash: signal $((exit - 128))"
    fi
    return
  fi
  [ "$now" != mix ] || found "exit $exit, and neither the old nor the new result"
  if [ "$exit" = "$usual_exit" ]; then
    case $now in
      old) found "exit $exit as if all were well, but the result is the old one" ;;
      unpainted) [ "$exit" = 3 ] || found "exit $exit without its pictures" ;;
    esac
  else
    tail -n 1 "$base/err" | grep -qE '^pcl_slam6d[a-z_0-9]*: (error|warning): .' ||
      [ "$exit" = 3 ] || found "exit $exit without words in our form"
  fi
  ! grep -qE ': Success|json\.exception|terminate called|std::|basic_[a-z]+::|vector::|error: (Invalid argument|Resource temporarily unavailable)$' "$base/err" ||
    found "words of a library"
  if [ "$kind" = thread ] && [ "$now" = old ] && ! grep -q 'cannot draw' "$base/err"; then
    found "exit $exit for want of a thread, where one fewer would do"
  fi
  [ -z "$(ls -A "$TMPDIR")" ] || found "something is left in TMPDIR"
}

# The same without a fault. The library is part of the program that a journal knows. A kill
# between the two names of a single file leaves the hidden one, which nobody knows of later.
repeat() {
  local exit hidden='^$'
  [ "$mode" != kill ] || [ -d "$work/out" ] || hidden='  \./\.'
  run LD_PRELOAD="$library"
  exit=$?
  [ $exit = "$usual_exit" ] || { found "the run after it ends with $exit"; return; }
  files_of "$work" | grep -vE "$hidden" | stable | cmp -s - "$base/new.list" ||
    found "after the next run the result is another, or something is left beside it"
}

attempt() { # one position
  prepare
  run LD_PRELOAD="$library" PCL6D_INJECT_KIND="$kind" PCL6D_INJECT_MODE="$mode" \
    PCL6D_INJECT_AT="$at" 2>/dev/null
  judge $?
  if [ "$program" != simulate ] || [ "$(state kill)" = old ]; then
    repeat
  fi
}

total=0 all_findings=0
for program in "${programs[@]}"; do
  learn "$program" ||
    { echo "FINDING $program: does not even run without faults"; cat "$base/err"; all_findings=$((all_findings + 1)); continue; }
  for kind in "${kinds[@]}"; do
    prepare
    rm -f "$base/count"
    run LD_PRELOAD="$library" PCL6D_INJECT_KIND="$kind" PCL6D_INJECT_COUNT="$base/count"
    calls=$(od -An -tu8 "$base/count" | tr -d ' ')
    step=1
    [ "$kind" != malloc ] || step=$every
    [ $(((calls + step - 1) / step)) -le "$positions" ] || step=$(((calls + positions - 1) / positions))
    for mode in ${modes_of[$kind]}; do
      [ -z "$wanted_modes" ] || [[ " $wanted_modes " == *" $mode "* ]] || continue
      tried=0 findings=0 foreign=0
      for ((at = 1; at <= calls; at += step)); do
        attempt
        tried=$((tried + 1))
      done
      printf '%-14s %-9s %-6s %6d calls %6d positions %4d findings %4d in other libraries\n' \
        "$program" "$kind" "$mode" "$calls" "$tried" "$findings" "$foreign"
      total=$((total + tried)) all_findings=$((all_findings + findings))
    done
  done
done
echo "$total positions, $all_findings findings"
[ "$all_findings" = 0 ]
