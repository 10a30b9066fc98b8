// SPDX-License-Identifier: BSD-3-Clause
// Turns files of one format into another. The first argument says what to convert.
#include "common/app.h"
#include "convert/verbs.h"

#include <algorithm>
#include <iomanip>
#include <iostream>

namespace {
using namespace pcl6d;
using Arguments = std::vector<std::string>;

/** \brief What the program can convert; one line of --help each. */
struct Verb {
  std::string name;
  std::string operands;
  std::string help;
  int (*run)(const Arguments& arguments);
};

const std::vector<Verb> kVerbs = {
    {"lines",
     "LINES.csv -o OUT.pcd",
     "2D lines on a drive as a 3D scan",
     app::runLines},
    {"scans", "IN -o OUT", "scans in another format", app::runScans},
    {"stereo", "LEFT RIGHT CALIB -o OUT", "two pictures to a scan", app::runStereo},
    {"trajectory", "IN -o OUT", "poses in another format", app::runTrajectory},
};

std::string
names()
{
  std::string all;
  for (const auto& verb : kVerbs)
    all += (all.empty() ? "" : ", ") + verb.name;
  return all;
}

void
printHelp()
{
  std::cout << "usage: " << app::kConvert << " WHAT ...\n"
            << "Turns files of one format into another.\n\n";
  for (const auto& verb : kVerbs)
    std::cout << "  " << std::left << std::setw(38) << verb.name + ' ' + verb.operands
              << verb.help << '\n';
  std::cout << '\n' << app::kConvert << " WHAT --help tells the options.\n";
}

int
run(const Arguments& arguments)
{
  if (arguments.empty())
    throw app::UsageError("the first argument must say what to convert: " + names());
  const std::string& word = arguments.front();
  const auto verb = std::find_if(
      kVerbs.begin(), kVerbs.end(), [&](const auto& v) { return v.name == word; });
  if (verb != kVerbs.end())
    return verb->run({arguments.begin() + 1, arguments.end()});
  if (word == "--version")
    return app::runTrajectory({word});
  if (word != "--help" && word != "-h")
    throw app::UsageError("cannot convert '" + word + "', but only: " + names());
  printHelp();
  return app::kDone;
}
} // namespace

int
main(int argc, char** argv)
{
  return app::runMain(app::kConvert, argc, argv, run);
}
