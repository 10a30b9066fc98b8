// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/verb_table.h"

#include <pcl6d/common/version.h>

#include <iomanip>
#include <iostream>

namespace pcl6d::app {

namespace {
std::string
firstWord(const std::string& text)
{
  return text.substr(0, text.find(' '));
}

void
printHelp(const VerbTable& table)
{
  std::cout << "usage: " << table.program << ' ' << table.operands << '\n'
            << table.purpose << "\n\n";
  for (const Verb& verb : table.verbs)
    std::cout << "  " << std::left << std::setw(static_cast<int>(table.width))
              << verb.call << verb.help << '\n';
  std::cout << '\n'
            << table.program << ' ' << firstWord(table.operands)
            << " --help tells the options.\n";
}

int
runVerb(const VerbTable& table, const std::vector<std::string>& arguments)
{
  std::string names;
  for (const Verb& verb : table.verbs)
    names += (names.empty() ? "" : ", ") + firstWord(verb.call);
  if (arguments.empty())
    throw UsageError("the first argument must say what to " + table.action + ": " +
                     names);
  const std::string& word = arguments.front();
  for (const Verb& verb : table.verbs)
    if (word == firstWord(verb.call))
      return verb.run({arguments.begin() + 1, arguments.end()});
  if (word == "--version")
    std::cout << "pcl6d " << PCL6D_VERSION << '\n';
  else if (word == "--help" || word == "-h")
    printHelp(table);
  else
    throw UsageError(
        (table.action == "do" ? "no such job as '" : "cannot " + table.action + " '") +
        word + "', but only: " + names);
  return kDone;
}
} // namespace

int
runVerbs(const VerbTable& table, int argc, char** argv)
{
  return runMain(table.program, argc, argv, [&](const auto& arguments) {
    return runVerb(table, arguments);
  });
}

} // namespace pcl6d::app
