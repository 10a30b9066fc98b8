# SPDX-License-Identifier: BSD-3-Clause
# Completion in bash for the programs of PCL6D. It asks a program's --help, so it knows
# what the program knows: jobs, options, the words of an option `a|b|c`, files, folders.

declare -gA _pcl6d_help_cache

# Sets help to what a command says, each option on a line of its own.
_pcl6d_ask() { # program [job]
  local key="$*"
  help=${_pcl6d_help_cache[$key]-}
  if [[ ! $help ]]; then
    help=$(COLUMNS=10000 "$@" --help 2>/dev/null)
    _pcl6d_help_cache[$key]=$help
  fi
}

# Prints the jobs of a program that has several.
_pcl6d_jobs() { # help
  [[ $1 == *"--help tells the options"* ]] &&
    sed -nE 's/^  ([a-z][a-z-]*)( .*)?$/\1/p' <<<"$1"
}

# Prints the line of an option, without the indent.
_pcl6d_line() { # help, option
  local line
  while IFS= read -r line; do
    if [[ $line =~ ^\ \ (-.,\ )?(--[a-z0-9-]+) ]] &&
      [[ $2 == "${BASH_REMATCH[2]}" || $2, == "${BASH_REMATCH[1]% }" ]]; then
      echo "${line:2}"
      return
    fi
  done <<<"$1"
}

# Prints the words of the first list a|b|c in a text; capitals stand for something else.
_pcl6d_words() { # text
  local list
  list=$(grep -oE '[A-Za-z0-9_."-]+(\|[A-Za-z0-9_."-]+)+' <<<"$1" | head -n 1)
  if [[ $list ]]; then
    tr '|' '\n' <<<"$list" | grep -xE '[a-z0-9_.-]+'
  elif [[ $1 =~ \ or\ (auto|all)[:,] ]]; then
    echo "${BASH_REMATCH[1]}"
  fi
}

# Prints the names that a list "Things:" explains, for an option --thing.
_pcl6d_named() { # help, option
  local caption=${2#--}
  sed -nE "/^${caption^}s:\$/,/^[A-Z]/s/^  ([a-z0-9-]+): .*/\1/p" <<<"$1"
}

# Fills COMPREPLY with files or folders, as they must be typed.
_pcl6d_files() { # current word, -f or -d
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen "$2" -- "$1")
}

_pcl6d_value() { # help, line of the option, option, current word
  local spec=${2%%  *} words
  words=$(_pcl6d_words "$2")
  [[ $words ]] || words=$(_pcl6d_named "$1" "$3")
  if [[ $words ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$4")
  fi
  if [[ $spec == *DIR* ]]; then
    _pcl6d_files "$4" -d
  elif [[ $spec =~ \ (FILE|OUT|CLOUD|PATH|[a-z]+\.) ]]; then
    _pcl6d_files "$4" -f
  fi
}

# Whether an option's line says that it takes a value.
_pcl6d_takes_value() { # line
  [[ ${1%%  *} =~ ^(-.,\ )?--[a-z0-9-]+\ [^\ ] ]]
}

_pcl6d() {
  local program=${COMP_WORDS[0]} current=${COMP_WORDS[COMP_CWORD]}
  local before=${COMP_WORDS[COMP_CWORD - 1]} help jobs line works_alone=
  COMPREPLY=()
  # bash takes --option=value for three words.
  if [[ $before == "=" ]]; then
    before=${COMP_WORDS[COMP_CWORD - 2]}
  elif [[ $current == "=" ]]; then
    current=
  fi
  _pcl6d_ask "$program"
  jobs=$(_pcl6d_jobs "$help")
  # A program may have options of its own beside its jobs.
  [[ $help == *$'\n'"  --"* ]] && works_alone=yes
  if [[ $jobs && ! $works_alone && $COMP_CWORD -eq 1 ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$jobs --help --version" -- "$current")
    return
  fi
  if [[ $jobs && $COMP_CWORD -gt 1 ]] && grep -qxF -- "${COMP_WORDS[1]}" <<<"$jobs"; then
    _pcl6d_ask "$program" "${COMP_WORDS[1]}"
    jobs=
  elif [[ $jobs && ! $works_alone ]]; then
    return
  fi
  if [[ $before == -* ]]; then
    line=$(_pcl6d_line "$help" "$before")
    if _pcl6d_takes_value "$line"; then
      _pcl6d_value "$help" "$line" "$before" "$current"
      return
    fi
  fi
  if [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(
      compgen -W "$(sed -nE 's/^  (-., )?(--[a-z0-9-]+).*/\2/p' <<<"$help")" -- "$current")
    return
  fi
  _pcl6d_files "$current" -f
  # Names in place of a file, such as those of scenes: the first list of the help.
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W \
    "$(sed -nE '/^[A-Z][a-z]*:$/q; s/^  ([a-z0-9-]+): .*/\1/p' <<<"$help")" -- "$current")
  if [[ $jobs && $COMP_CWORD -eq 1 ]]; then
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$jobs" -- "$current")
  fi
}

# bash loads this file as that of one program; sourced by hand it serves them all.
_pcl6d_program=${BASH_SOURCE[0]##*/}
if [[ $_pcl6d_program == *.bash ]]; then
  mapfile -t _pcl6d_program < <(compgen -c pcl_slam6d | sort -u)
fi
if [[ ${_pcl6d_program[*]} ]]; then
  complete -F _pcl6d "${_pcl6d_program[@]}"
fi
unset _pcl6d_program
