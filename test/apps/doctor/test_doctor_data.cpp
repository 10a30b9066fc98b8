// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_doctor on recorded clouds.
#include "apps/doctor/doctor_test.h"
#include "support/data_folder.h"

namespace {
using pcl6d::test::consult;
using pcl6d::test::Consultation;
using Json = nlohmann::json;
} // namespace

TEST(DoctorData, ReportsOnTheBunny)
{
  PCL6D_DATA_OR_SKIP(pcl, "pcl");
  const Consultation bunny = consult({pcl / "bun0.pcd", pcl / "bun4.pcd"});
  EXPECT_EQ(bunny.exit_code, 3) << bunny.err; // 400 points are no evidence
  EXPECT_FALSE(bunny.measured("limit is counted as convergence").empty());
  EXPECT_FALSE(bunny.measured("stop before they are at rest").empty());
  const Json ours = bunny.json["runs"][bunny.json["best_of_ours"].get<std::size_t>()];
  EXPECT_LT(ours["verdict"]["rms"], 0.007); // [m] the spacing is 0.006
}

TEST(DoctorData, FindsTheCorridorFromFeaturesWhereAllClassesConvergeBeside)
{
  PCL6D_DATA_OR_SKIP(kurt, "kurt3d");
  const Consultation corridor =
      consult({kurt / "scan001.3d", kurt / "scan000.3d", "--time-limit", "20"});
  EXPECT_FALSE(corridor.measured("of rays without echo").empty()) << corridor.err;
  const Json ours =
      corridor.json["runs"][corridor.json["best_of_ours"].get<std::size_t>()];
  EXPECT_NE(ours["settings"].get<std::string>().find("alignByFeatures()"),
            std::string::npos)
      << corridor.out;
  // The odometry of the scans says 1.569 m.
  const std::vector<double> pose = ours["pose"];
  EXPECT_NEAR(pose[3], 1.57, 0.1);
  EXPECT_FALSE(corridor.measured("doubtful poses").empty());
}
