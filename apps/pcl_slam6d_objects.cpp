// SPDX-License-Identifier: BSD-3-Clause
// Finds objects in scans and learns what they look like. The first argument says what to
// do.
#include "common/app.h"
#include "objects/verbs.h"

#include <iostream>

namespace {
using namespace pcl6d;

struct Verb {
  const char* name;
  const char* help;
  int (*run)(const std::vector<std::string>& arguments);
};

constexpr Verb kVerbs[] = {
    {"locate",
     "locate INPUT --model MODEL... -o OUT_DIR           objects and their poses",
     app::runLocate},
    {"train",
     "train MODEL... --background SCANS -o CASCADE.xml   a detector from models",
     app::runTrain},
};

std::string
verbNames()
{
  std::string names;
  for (const auto& verb : kVerbs)
    names += (names.empty() ? "" : ", ") + std::string(verb.name);
  return names;
}

int
run(const std::vector<std::string>& arguments)
{
  if (arguments.empty())
    throw app::UsageError("the first argument must say what to do: " + verbNames());
  const std::string& first = arguments.front();
  for (const auto& verb : kVerbs)
    if (first == verb.name)
      return verb.run({arguments.begin() + 1, arguments.end()});
  if (first == "--version")
    return app::runLocate({first});
  if (first != "--help" && first != "-h")
    throw app::UsageError("no such job as '" + first + "', but only: " + verbNames());
  std::cout << "usage: " << app::kObjects << " JOB ...\n"
            << "Finds objects in scans and learns what they look like.\n\n";
  for (const auto& verb : kVerbs)
    std::cout << "  " << verb.help << '\n';
  std::cout << '\n' << app::kObjects << " JOB --help tells the options.\n";
  return app::kDone;
}
} // namespace

int
main(int argc, char** argv)
{
  return app::runMain(app::kObjects, argc, argv, run);
}
