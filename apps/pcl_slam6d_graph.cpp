// SPDX-License-Identifier: BSD-3-Clause
// Works on pose graphs without scans. The first argument says what to do.
#include "common/app.h"
#include "graph/verbs.h"

#include <iostream>

namespace {
using namespace pcl6d;

int
run(const std::vector<std::string>& arguments)
{
  const std::string verbs = "optimize, info";
  if (arguments.empty())
    throw app::UsageError("the first argument must say what to do: " + verbs);
  const std::string& verb = arguments.front();
  if (verb == "optimize")
    return app::runOptimize({arguments.begin() + 1, arguments.end()});
  if (verb == "info")
    return app::runInfo({arguments.begin() + 1, arguments.end()});
  if (verb == "--version")
    return app::runInfo({verb});
  if (verb != "--help" && verb != "-h")
    throw app::UsageError("no such job as '" + verb + "', but only: " + verbs);
  std::cout << "usage: " << app::kGraph << " JOB ...\n"
            << "Works on pose graphs (g2o or TORO files).\n\n"
            << "  optimize IN -o OUT   find the poses that fit the links best\n"
            << "  info IN              tell what a graph holds\n\n"
            << app::kGraph << " JOB --help tells the options.\n";
  return app::kDone;
}
} // namespace

int
main(int argc, char** argv)
{
  return app::runMain(app::kGraph, argc, argv, run);
}
