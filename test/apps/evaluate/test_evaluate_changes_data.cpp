// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate changes on recorded scans of one walk: nothing changed meanwhile.
#include "support/data_folder.h"
#include "support/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {
using namespace pcl6d::test;
using Json = nlohmann::json;

/** Runs over the even and the odd scans of a walk, compared. */
Json
evenAgainstOdd(const std::string& scans)
{
  const TempFolder folder;
  for (const char* first : {"0", "1"})
    EXPECT_EQ(runProgram("pcl_slam6d",
                         {scans,
                          "--first",
                          first,
                          "--every",
                          "2",
                          "-o",
                          folder / first,
                          "--no-picture",
                          "--quiet"})
                  .exit_code,
              0);
  const Outcome outcome = runProgram("pcl_slam6d_evaluate",
                                     {"changes",
                                      folder / "0",
                                      folder / "1",
                                      "--json",
                                      folder / "changes.json",
                                      "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return Json::parse(readText(folder / "changes.json"));
}

/** At most so many points of each run are in changes; at most so many changes. */
void
expectHardlyAny(const Json& told, double share, std::size_t changes)
{
  for (const char* run : {"first", "second"}) {
    const double points = told[run]["points"];
    EXPECT_GT(points, 10000);
    EXPECT_LE(told[run]["changed"].get<double>(), share * points) << run;
    EXPECT_GT(told[run]["on_surface"].get<double>(), 0.9 * points) << run;
  }
  EXPECT_LE(told["changes"].size(), changes) << told["changes"];
}
} // namespace

TEST(EvaluateChangesData, OfAWalkAreHardlyAny)
{
  // Trees that are seen from afar through gaps may be told of.
  PCL6D_DATA_OR_SKIP(scans, "hku1");
  expectHardlyAny(evenAgainstOdd(scans), 0.001, 2);
}

TEST(EvaluateChangesData, OfARoomAreNone)
{
  PCL6D_DATA_OR_SKIP(scans, "handheld");
  expectHardlyAny(evenAgainstOdd(scans), 0, 0);
}
