// SPDX-License-Identifier: BSD-3-Clause
// Shows what a run of pcl_slam6d left. The first argument says how.
#include "common/app.h"
#include "render/verbs.h"

#include <iomanip>
#include <iostream>

namespace {
using namespace pcl6d;

struct Verb {
  const char* name;
  const char* purpose;
  int (*run)(const std::vector<std::string>& arguments);
};

constexpr Verb kVerbs[] = {
    {"animation",
     "the map growing, relaxing, turning or flown through, as frames and a video",
     app::runAnimation},
    {"picture",
     "views of the map, the poses and the links as PNG files",
     app::runPicture},
    {"report",
     "one page for a browser: verdict, map, plots, tables, pictures",
     app::runReport},
};

void
printHelp()
{
  std::cout
      << "usage: " << app::kRender << " JOB RUN ...\n"
      << "Shows what a run of pcl_slam6d left in the folder RUN. Needs no display.\n\n";
  for (const Verb& verb : kVerbs)
    std::cout << "  " << std::left << std::setw(11) << verb.name << verb.purpose
              << '\n';
  std::cout << '\n' << app::kRender << " JOB --help tells the options.\n";
}

int
run(const std::vector<std::string>& arguments)
{
  std::string names;
  for (const Verb& verb : kVerbs)
    names += (names.empty() ? "" : ", ") + std::string(verb.name);
  if (arguments.empty())
    throw app::UsageError("the first argument must say what to do: " + names);
  for (const Verb& verb : kVerbs)
    if (arguments.front() == verb.name)
      return verb.run({arguments.begin() + 1, arguments.end()});
  if (arguments.front() == "--version")
    return kVerbs[0].run({arguments.front()});
  if (arguments.front() != "--help" && arguments.front() != "-h")
    throw app::UsageError("no such job as '" + arguments.front() +
                          "', but only: " + names);
  printHelp();
  return app::kDone;
}
} // namespace

int
main(int argc, char** argv)
{
  return app::runMain(app::kRender, argc, argv, run);
}
