// SPDX-License-Identifier: BSD-3-Clause
// Constants of link tests, fitted to all sensors except one.

#include "../benchmark/verification_fit.h"

#include <gtest/gtest.h>

#include <sstream>

using pcl6d::bench::EvaluatedLink;

namespace {
/** A link of a sensor with tested patches, and a shift of the surfaces by deviations of 1 cm. */
EvaluatedLink
link(const std::string& sensor,
     const std::string& kind,
     std::size_t contradicted,
     double sigmas = 0)
{
  EvaluatedLink made;
  made.set = sensor + " set";
  made.group = sensor;
  made.kind = kind;
  made.evidence.sight.patches = 100;
  made.evidence.sight.contradicted_patches = contradicted;
  made.evidence.voxel = 0.1; // deviations are at least a tenth of the voxel
  made.evidence.fit.step(0) = 0.01 * sigmas;
  return made;
}

/** Two sensors: links of the second are contradicted ten times as much. */
std::vector<EvaluatedLink>
twoSensors()
{
  std::vector<EvaluatedLink> links;
  for (int i = 0; i < 5; ++i) {
    links.push_back(link("clean", "right", 0, 0.5));
    links.push_back(link("noisy", "right", 20, 3));
    links.push_back(link("clean", "minimum", 40));
    links.push_back(link("noisy", "minimum", 60));
  }
  return links;
}

/** \return the row of a sensor */
std::string
rowOf(const std::string& table, const std::string& sensor)
{
  const auto begin = table.find("| " + sensor + " |");
  return begin == std::string::npos
             ? ""
             : table.substr(begin, table.find('\n', begin) - begin);
}
} // namespace

TEST(LeaveOneOut, FitsTheContradictionsOfTheOtherSensors)
{
  std::ostringstream table;
  pcl6d::bench::printLeaveOneOut(twoSensors(), table);
  // Its own background, then the background of the others.
  EXPECT_EQ(rowOf(table.str(), "clean").rfind("| clean | 0.002 | 0.2 |", 0), 0U)
      << table.str();
  const std::string noisy = rowOf(table.str(), "noisy");
  EXPECT_EQ(noisy.rfind("| noisy | 0.2 | 0.002 |", 0), 0U) << table.str();
  EXPECT_NE(noisy.find("| 5 / 5 |"),
            std::string::npos); // doubted with the constants in use
}

TEST(LeaveOneOut, NeedsTwoSensors)
{
  std::ostringstream table;
  pcl6d::bench::printLeaveOneOut({link("clean", "right", 0)}, table);
  EXPECT_EQ(table.str(), "");
}

TEST(LeaveOneOut, LimitsTheShiftByTheOtherSensors)
{
  std::ostringstream table;
  pcl6d::bench::printShiftLimits(twoSensors(), table);
  // All right links of the noisy sensor are above the limit of the clean one, and above the limit of
  // good links, 2.5 deviations; none is above the limit of wrong ones.
  EXPECT_EQ(rowOf(table.str(), "noisy"), "| noisy | 0.5 | 5 | 5 | 0 / 5 | 0 | 0 / 0 |");
  EXPECT_EQ(rowOf(table.str(), "clean"), "| clean | 3 | 0 | 0 | 0 / 5 | 0 | 0 / 0 |");
}
