// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/help_text.h"
#include "common/options/option_table.h"
#include "common/options/verbs.h"

#include <algorithm>
#include <iomanip>
#include <iostream>

namespace pcl6d::app {

namespace {
std::string
namesOf(const std::vector<Verb>& verbs)
{
  std::string names;
  for (const Verb& verb : verbs)
    names += (names.empty() ? "" : ", ") + verb.name;
  return names;
}

std::string
callOf(const Verb& verb)
{
  return verb.name + (verb.operands.empty() ? "" : " ") + verb.operands;
}

void
printHelp(const VerbProgram& program)
{
  std::size_t widest = 0;
  for (const Verb& verb : program.verbs)
    widest = std::max(widest, callOf(verb).size());
  std::cout << "usage: " << program.name << ' ' << program.usage << '\n'
            << program.purpose << "\n\n";
  for (const Verb& verb : program.verbs)
    std::cout << "  " << std::left << std::setw(static_cast<int>(widest) + 2)
              << callOf(verb) << verb.help << '\n';
  const std::string usage = program.usage;
  std::cout << '\n'
            << program.name << ' ' << usage.substr(0, usage.find(' '))
            << " --help tells the options.\n"
            << helpEnd();
}

int
run(const VerbProgram& program, const Arguments& arguments)
{
  const std::string deed = program.deed;
  const std::string names = namesOf(program.verbs);
  if (arguments.empty())
    throw UsageError("the first argument must say what to " + deed + ": " + names);
  const std::string& word = arguments.front();
  for (const Verb& verb : program.verbs)
    if (word == verb.name)
      return verb.run({arguments.begin() + 1, arguments.end()});
  if (word == "--version")
    OptionTable("").parse({word});
  else if (word == "--help" || word == "-h")
    printHelp(program);
  else
    throw UsageError((deed == "do" ? "unknown job '" : "cannot " + deed + " '") + word +
                     "', but only: " + names);
  return kDone;
}
} // namespace

int
runVerbs(const VerbProgram& program, int argc, char** argv)
{
  return runMain(program.name, argc, argv, [&](const Arguments& arguments) {
    return run(program, arguments);
  });
}

} // namespace pcl6d::app
