# SPDX-License-Identifier: BSD-3-Clause
# Makes a man page of what a program says to --help, each option on a line of its own:
#   COLUMNS=10000 pcl_slam6d --help | awk -f help_to_man.awk -v name=pcl_slam6d \
#     -v version=0.2.0 -v also="pcl_slam6d_convert(1)"
# That is: a line "usage: ..." (more below it, indented as far), what it does, and groups
# "Caption:" of lines "  name or option  text", two spaces or more between.

function quoted(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  gsub(/'/, "\\(aq", text)
  gsub(/`/, "\\(ga", text)
  gsub(/\|/, "|\\:", text) # a line may break there
  sub(/^\./, "\\\\\\&.", text)
  return text
}

function say(line) {
  body = body line "\n"
}

# An entry of a list: its name in bold, its arguments not.
function entry(term, text,    end) {
  end = match(term, /[^,] [^-]/) ? RSTART : length(term)
  say(".TP")
  say("\\fB" quoted(substr(term, 1, end)) "\\fR" quoted(substr(term, end + 1)))
  say(text == "" ? "\\&" : quoted(text))
  in_list = 1
}

# The first sentence of what the program does, for the line of its name.
function summary(text,    end) {
  end = match(text, /[.:;] |[.:;]$/) ? RSTART - 1 : length(text)
  return tolower(substr(text, 1, 1)) substr(text, 2, end - 1)
}

NR == 1 && /^usage: / {
  usages[++count] = substr($0, 8)
  next
}

NR == count + 1 && index($0, "       " name) == 1 { # another way to call it
  usages[++count] = substr($0, 8)
  next
}

/^  [^ ].*[^ ]  +[^ ]/ && !prose {
  line = substr($0, 3)
  match(line, /  +/)
  entry(substr(line, 1, RSTART - 1), substr(line, RSTART + RLENGTH))
  next
}

/^  [a-z0-9-]+: / { # a name and what it is
  line = substr($0, 3)
  at = index(line, ": ")
  entry(substr(line, 1, at - 1), substr(line, at + 2))
  next
}

/^[A-Z][^.]*:$/ { # a caption
  say(".SS \"" quoted(substr($0, 1, length($0) - 1)) "\"")
  in_list = 0
  next
}

/^ *$/ {
  if (!in_list)
    say(".PP")
  about_over = about != ""
  next
}

{
  if (!about_over)
    about = about (about == "" ? "" : about ~ /-$/ ? "" : " ") $0
  if (in_list)
    say(".PP")
  in_list = 0
  sub(/^ +/, "")
  say(quoted($0))
}

END {
  gsub(/(\.PP\n)+\.PP/, ".PP", body)
  gsub(/(\.PP\n)+\.SS/, ".SS", body)
  title = name
  sub(/ /, "-", title)
  printf ".TH %s 1 \"\" \"pcl6d %s\" \"User Commands\"\n.ad l\n.nh\n", quoted(toupper(title)), version
  printf ".SH NAME\n%s \\- %s\n", quoted(title), quoted(summary(about))
  print ".SH SYNOPSIS"
  for (k = 1; k <= count; ++k)
    printf "%s.B %s\n%s\n", (k == 1 ? "" : ".br\n"), quoted(name), quoted(substr(usages[k], length(name) + 2))
  printf ".SH DESCRIPTION\n%s", body
  print ".SH EXIT STATUS"
  print ".TP\n.B 0\ndone"
  print ".TP\n.B 1\nfailed: bad data, or a file could not be read or written"
  print ".TP\n.B 2\nthe command line or the config file is wrong"
  print ".TP\n.B 3\nfinished, but part of the result is not reliable"
  print ".TP\n.B 130\ninterrupted"
  if (also != "")
    printf ".SH SEE ALSO\n%s\n", quoted(also)
}
