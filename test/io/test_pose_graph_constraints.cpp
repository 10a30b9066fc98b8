// SPDX-License-Identifier: BSD-3-Clause
// Landmarks, priors and switches of g2o files.
#include "io_test.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/pose_graph_io.h>

using pcl6d::GraphConstraints;
using pcl6d::PoseGraphFile;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {
const std::string kIdentity6 = " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 4 0 0 4 0 4";
const std::string kPoses = "VERTEX_SE3:QUAT 3 0 0 0 0 0 0 1\n"
                           "VERTEX_SE3:QUAT 5 1 0 0 0 0 0 1\n"
                           "EDGE_SE3:QUAT 3 5 1 0 0 0 0 0 1" +
                           kIdentity6 + "\n";
const std::string kOffset = "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n"
                            "PARAMS_SE3OFFSET 2 1 2 3 0 0 0.6 0.8\n";

class ConstrainedFile : public testing::Test {
protected:
  PoseGraphFile
  read(const std::string& rows)
  {
    writeText(file_, rows);
    return pcl6d::readPoseGraphFile(file_);
  }
  void
  expectFault(const std::string& rows, const std::string& fault)
  {
    pcl6d::test::expectIoFailed(file_, fault, [&] { read(kPoses + kOffset + rows); });
  }
  TempFolder folder_;
  const std::filesystem::path file_ = folder_ / "a.g2o";
};
} // namespace

TEST_F(ConstrainedFile, HoldsLandmarksInTheFrameOfThePose)
{
  const GraphConstraints found =
      read(kPoses + kOffset +
           "VERTEX_TRACKXYZ 9 4 5 6\nEDGE_SE3_TRACKXYZ 5 9 0 1 2 3 1 0 0 2 0 3\n"
           "EDGE_SE3_TRACKXYZ 3 9 2 1 0 0 1 0 0 2 0 3\n")
          .constraints;
  ASSERT_EQ(found.landmarks.size(), 1U);
  EXPECT_EQ(found.landmarks[0], Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(found.landmark_ids, (std::vector<std::size_t>{9}));
  ASSERT_EQ(found.sightings.size(), 2U);
  EXPECT_EQ(found.sightings[0].pose, 1U);
  EXPECT_EQ(found.sightings[0].position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(found.sightings[0].information.diagonal(), Eigen::Vector3d(1, 2, 3));
  // The second sensor is turned about z by an angle of cosine 0.28 and sine 0.96.
  EXPECT_TRUE(
      found.sightings[1].position.isApprox(Eigen::Vector3d(1.28, 2.96, 3), 1e-12));
  EXPECT_NEAR(found.sightings[1].information(0, 0), 0.0784 + 2 * 0.9216, 1e-12);
  EXPECT_NEAR(found.sightings[1].information(0, 1), 0.28 * 0.96 * (1 - 2), 1e-12);
}

TEST_F(ConstrainedFile, HoldsPriors)
{
  const GraphConstraints found =
      read(kPoses + kOffset + "EDGE_SE3_PRIOR 5 0 1 2 3 0 0 0 1" + kIdentity6 +
           "\nEDGE_SE3_PRIOR 3 2 1 2 3 0 0 0.6 0.8" + kIdentity6 + "\n")
          .constraints;
  ASSERT_EQ(found.priors.size(), 2U);
  EXPECT_EQ(found.priors[0].pose, 1U);
  EXPECT_EQ(found.priors[0].T_world_pose.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(found.priors[0].information.isIdentity(1e-12))
      << "of radians, not of the quaternion";
  // The sensor stands where its pose in the frame of the other one is: the pose at the origin.
  EXPECT_TRUE(
      found.priors[1].T_world_pose.isApprox(Eigen::Isometry3d::Identity(), 1e-12));
  // Law: the square of an error of the sensor is that of the pose, to the first order.
  const Eigen::Isometry3d T_pose_sensor =
      Eigen::Translation3d(1, 2, 3) * Eigen::Quaterniond(0.8, 0, 0, 0.6);
  Eigen::Matrix<double, 6, 1> motion;
  motion << 1, 2, -3, 2, -1, 1;
  motion *= 1e-6;
  Eigen::Isometry3d error = Eigen::Isometry3d::Identity();
  error.translation() = motion.head<3>();
  error.linear() =
      Eigen::AngleAxisd(motion.tail<3>().norm(), motion.tail<3>().normalized())
          .toRotationMatrix();
  const Eigen::Isometry3d at_sensor = T_pose_sensor.inverse() * error * T_pose_sensor;
  const Eigen::AngleAxisd turn(at_sensor.linear());
  const double square =
      at_sensor.translation().squaredNorm() + turn.angle() * turn.angle();
  EXPECT_NEAR(motion.dot(found.priors[1].information * motion) / square, 1, 1e-4);
}

TEST_F(ConstrainedFile, HoldsPlanarPriors)
{
  const std::string plane = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\n"
                            "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n";
  for (const std::string word : {"EDGE_SE2_PRIOR", "EDGE_PRIOR_SE2"}) {
    const auto found = read(plane + word + " 1 2 3 0.5 10 0 0 20 0 40\n").constraints;
    ASSERT_EQ(found.priors.size(), 1U);
    EXPECT_TRUE(
        found.priors[0].T_world_pose.isApprox(pcl6d::planarPose(2, 3, 0.5), 1e-14));
    EXPECT_EQ(found.priors[0].information(5, 5), 40);
  }
  const auto found = read(plane + "EDGE_PRIOR_SE2_XY 1 2 3 10 1 20\n").constraints;
  ASSERT_EQ(found.priors.size(), 1U);
  const auto& information = found.priors[0].information;
  EXPECT_EQ(information(0, 1), 1);
  EXPECT_EQ(information(1, 1), 20);
  EXPECT_EQ(information(2, 2), 15);
  EXPECT_EQ(information(5, 5), 0) << "the heading is free";
}

TEST_F(ConstrainedFile, HoldsSwitches)
{
  const auto file = read(kPoses +
                         "VERTEX_SWITCH 20 0.9\nEDGE_SWITCH_PRIOR 20 1 5\n"
                         "EDGE_SE3_SWITCHABLE 5 3 20 -1 0 0 0 0 0 1" +
                         kIdentity6 + "\n");
  ASSERT_EQ(file.graph.links.size(), 2U);
  EXPECT_EQ(file.graph.links[1].from, 1U);
  ASSERT_EQ(file.constraints.switches.size(), 1U);
  const pcl6d::LinkSwitch& one = file.constraints.switches[0];
  EXPECT_EQ(one.link, 1U);
  EXPECT_EQ(one.id, 20U);
  EXPECT_EQ(one.value, 0.9);
  EXPECT_EQ(one.prior, 1);
  EXPECT_EQ(one.information, 5);
}

TEST_F(ConstrainedFile, IsTheSameWhenWrittenAndRead)
{
  const auto file =
      read(kPoses + kOffset + "FIX 5\nVERTEX_TRACKXYZ 9 4 5 6\n" +
           "EDGE_SE3_TRACKXYZ 3 9 2 1 0 0 1 0.5 0 2 0 3\n" +
           "EDGE_SE3_PRIOR 3 2 1 2 3 0 0 0.6 0.8" + kIdentity6 +
           "\nVERTEX_SWITCH 20 0.9\nEDGE_SWITCH_PRIOR 20 1 5\n" +
           "EDGE_SE3_SWITCHABLE 5 3 20 -1 0 0 0 0 0 1" + kIdentity6 + "\n");
  const auto path = folder_ / "b.g2o";
  pcl6d::writePoseGraph(
      path, file.graph, pcl6d::PoseGraphFormat::kG2o, file.constraints);
  const GraphConstraints back = pcl6d::readPoseGraphFile(path).constraints;
  const GraphConstraints& was = file.constraints;
  EXPECT_EQ(back.fixed, was.fixed);
  EXPECT_EQ(back.landmarks, was.landmarks);
  EXPECT_EQ(back.sightings[0].position, was.sightings[0].position);
  EXPECT_EQ(back.sightings[0].information, was.sightings[0].information);
  EXPECT_TRUE(back.priors[0].T_world_pose.isApprox(was.priors[0].T_world_pose, 1e-15));
  EXPECT_TRUE(back.priors[0].information.isApprox(was.priors[0].information, 1e-15));
  EXPECT_EQ(back.switches[0].value, 0.9);
  EXPECT_EQ(back.switches[0].link, 1U);
  EXPECT_THROW(pcl6d::writePoseGraph(
                   path, file.graph, pcl6d::PoseGraphFormat::kToro, file.constraints),
               pcl6d::BadArgument);
  GraphConstraints beyond = was;
  beyond.priors[0].pose = 2;
  EXPECT_THROW(
      pcl6d::writePoseGraph(path, file.graph, pcl6d::PoseGraphFormat::kG2o, beyond),
      pcl6d::BadArgument);
}

TEST_F(ConstrainedFile, FaultsAreNamed)
{
  expectFault("VERTEX_TRACKXYZ 9 1 2 3\n",
              "line 6: no EDGE_SE3_TRACKXYZ leads to this landmark");
  expectFault("VERTEX_TRACKXYZ 5 1 2 3\n", "line 6: vertex 5 is given twice");
  expectFault("EDGE_SE3_TRACKXYZ 5 9 0 1 2 3 1 0 0 1 0 1\n",
              "line 6: there is no VERTEX_TRACKXYZ 9");
  expectFault("VERTEX_TRACKXYZ 9 1 2 3\nEDGE_SE3_TRACKXYZ 5 9 7 1 2 3 1 0 0 1 0 1\n",
              "line 7: no line is PARAMS_SE3OFFSET 7");
  expectFault("VERTEX_TRACKXYZ 9 1 2 3\nEDGE_SE3_TRACKXYZ 5 9 0 1 2 3 -1 0 0 1 0 1\n",
              "line 7: the information matrix is not positive semidefinite");
  expectFault("EDGE_SE3_PRIOR 8 0 1 2 3 0 0 0 1" + kIdentity6 + "\n",
              "line 6: there is no vertex 8");
  expectFault("EDGE_PRIOR_SE2_XY 5 1 2 1 0\n",
              "line 6: expected 6 numbers after EDGE_PRIOR_SE2_XY, got 5");
  const std::string link =
      "EDGE_SE3_SWITCHABLE 5 3 20 -1 0 0 0 0 0 1" + kIdentity6 + "\n";
  expectFault(link, "line 6: there is no VERTEX_SWITCH 20");
  expectFault("VERTEX_SWITCH 20 1\n" + link,
              "line 7: there is no EDGE_SWITCH_PRIOR of switch 20");
  expectFault("VERTEX_SWITCH 20 1\nEDGE_SWITCH_PRIOR 20 1 0\n" + link,
              "line 7: the information of a switch must be > 0");
  expectFault("VERTEX_SWITCH 20 1\nEDGE_SWITCH_PRIOR 20 1 1\n" + link + link,
              "line 9: switch 20 has two links");
  expectFault("VERTEX_SWITCH 20 nan\n", "line 6: a number is not finite");
}
