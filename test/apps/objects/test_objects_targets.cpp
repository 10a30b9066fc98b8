// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_objects targets as a user runs it.
#include "object_localization/target_room.h"
#include "support/run_program.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/control_points_io.h>

#include <gtest/gtest.h>

#include <sstream>

namespace {
using Eigen::Vector3d;
using pcl6d::ScanTarget;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::TargetRoom;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;
constexpr const char* kName = "pcl_slam6d_objects";
constexpr double kWithin = 0.002; // [m] four deviations of the farthest board

const Vector3d kPlaces[] = {{2, 1, 0.2},
                            {-2.5, 0.5, -0.4},
                            {0.5, -2.5, 0.6},
                            {3, -1, 0.3}};

Outcome
targetsProgram(const std::vector<std::string>& arguments)
{
  std::vector<std::string> all = {"targets"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return pcl6d::test::runProgram(kName, all);
}

/** A folder with a scan of three spheres and a board. */
struct Survey : TempFolder {
  explicit Survey(bool has_intensity = true)
  {
    TargetRoom room;
    for (int k = 0; k < 3; ++k)
      room.balls.push_back({kPlaces[k]});
    room.squares.push_back({kPlaces[3], kPlaces[3].normalized()});
    std::vector<float> intensity;
    const pcl6d::Points points = room.scan(1, intensity);
    std::ostringstream text;
    text << "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z"
         << (has_intensity ? " intensity" : "") << "\nSIZE 4 4 4"
         << (has_intensity ? " 4" : "") << "\nTYPE F F F" << (has_intensity ? " F" : "")
         << "\nCOUNT 1 1 1" << (has_intensity ? " 1" : "") << "\nWIDTH "
         << points.size() << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS "
         << points.size() << "\nDATA ascii\n";
    for (std::size_t i = 0; i < points.size(); ++i) {
      text << points[i].x() << ' ' << points[i].y() << ' ' << points[i].z();
      if (has_intensity)
        text << ' ' << intensity[i];
      text << '\n';
    }
    writeText(name("scans/scan000.pcd"), text.str());
  }
  std::string
  name(const std::string& file) const
  {
    const std::filesystem::path path = *this / file;
    std::filesystem::create_directories(path.parent_path());
    return path;
  }
  Outcome
  search(const std::vector<std::string>& more) const
  {
    std::vector<std::string> all = {name("scans"), "-o", name("targets.csv")};
    all.insert(all.end(), more.begin(), more.end());
    return targetsProgram(all);
  }
  std::vector<ScanTarget>
  targets() const
  {
    return pcl6d::readScanTargets(name("targets.csv"), {"scan000.pcd"}, {0});
  }
};
} // namespace

TEST(ObjectsTargets, WritesATableThatTheSurveyReads)
{
  const Survey survey;
  const Outcome outcome =
      survey.search({"--sphere-diameter", "0.2", "0.145", "--board-size", "0.15"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("4 targets in 1 scan, 0 named"), 0U) << outcome.out;
  const auto targets = survey.targets();
  ASSERT_EQ(targets.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(targets[k].name, "T" + std::to_string(k + 1));
    double error = 1;
    for (const Vector3d& place : kPlaces)
      error = std::min(error, (targets[k].position - place).norm());
    EXPECT_LT(error, kWithin);
  }
  EXPECT_NE(readText(survey.name("targets.csv")).find("sigma"), std::string::npos);
}

TEST(ObjectsTargets, TakesNamesFromControlPoints)
{
  const Survey survey;
  const Eigen::Isometry3d T_control_scan =
      Eigen::Translation3d(1000, 2000, 30) * Eigen::AngleAxisd(0.7, Vector3d::UnitZ());
  std::ostringstream control;
  control.precision(12);
  for (int k = 0; k < 4; ++k)
    control << "P" << k << "," << (T_control_scan * kPlaces[k]).x() << ","
            << (T_control_scan * kPlaces[k]).y() << ","
            << (T_control_scan * kPlaces[k]).z() << ",0.001\n";
  control << "FAR,1100,2000,30,0.001\n";
  writeText(survey.name("control.csv"), control.str());
  const Outcome outcome = survey.search({"--sphere-diameter",
                                         "0.145",
                                         "--board-size",
                                         "0.15",
                                         "--control",
                                         survey.name("control.csv")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto targets = survey.targets();
  ASSERT_EQ(targets.size(), 4U);
  for (const ScanTarget& target : targets) {
    ASSERT_EQ(target.name.front(), 'P') << outcome.out;
    const Vector3d& place = kPlaces[target.name[1] - '0'];
    EXPECT_LT((target.position - place).norm(), kWithin) << target.name;
  }
}

TEST(ObjectsTargets, NamesWhatIsWrong)
{
  const Survey survey(false);
  const auto expect =
      [&](const std::vector<std::string>& more, int code, const std::string& words) {
        pcl6d::test::expectError(survey.search(more), kName, code, {words});
      };
  expect({}, 2, "give the targets to search for");
  expect({"--sphere-diameter", "-1"}, 2, "no length > 0 in metres");
  expect({"--board-size", "0.15"}, 1, "has no field intensity");
  expect({"--sphere-diameter", "0.145", "--control", survey.name("none.csv")},
         1,
         "none.csv");
}
