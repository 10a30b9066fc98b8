// SPDX-License-Identifier: BSD-3-Clause
// Semantic maps of finished runs. The first argument says what to do.
#include "common/app.h"
#include "semantic_map/verbs.h"

#include <iostream>

namespace {
using namespace pcl6d;

int
run(const std::vector<std::string>& arguments)
{
  const std::string verbs = "build, query, info";
  if (arguments.empty())
    throw app::UsageError("the first argument must say what to do: " + verbs);
  const std::string& verb = arguments.front();
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  if (verb == "build")
    return app::runMapBuild(rest);
  if (verb == "query")
    return app::runMapQuery(rest);
  if (verb == "info")
    return app::runMapInfo(rest);
  if (verb == "--version")
    return app::runMapInfo({verb});
  if (verb != "--help" && verb != "-h")
    throw app::UsageError("no such job as '" + verb + "', but only: " + verbs);
  std::cout << "usage: " << app::kSemanticMap << " JOB ...\n"
            << "Makes and asks semantic maps: planes with labels, objects, rooms.\n\n"
            << "  build RUN_DIR        make the semantic map of a run of pcl_slam6d\n"
            << "  query MAP \"...\"      find things, such as \"objects class=chair\"\n"
            << "  info MAP             tell what a map holds\n\n"
            << app::kSemanticMap << " JOB --help tells the options.\n";
  return app::kDone;
}
} // namespace

int
main(int argc, char** argv)
{
  return app::runMain(app::kSemanticMap, argc, argv, run);
}
