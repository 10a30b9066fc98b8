// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_objects locate as a user runs it, against the truth of a simulation.
#include "apps/objects/located_room.h"
#include "support/constants.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/mesh_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/semantic_map/semantic_map_io.h>

#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

namespace {
using namespace pcl6d;
using pcl6d::test::kDegree;
using test::Outcome;
using test::readText;
using test::writeText;

/** \return the angle between two poses of an object with a symmetry */
double
turnBetween(const MapObject& found, const MapObject& truth)
{
  double least = M_PI;
  for (int i = 0; i < found.symmetry; ++i)
    least = std::min(
        least,
        rotationAngle(found.pose.T_world_object.linear().transpose() *
                      truth.pose.T_world_object.linear() *
                      rotationFromEuler({0, 0, 2 * M_PI * i / found.symmetry})));
  return least;
}

/** \return points of the chair's mesh, in millimetres and with y up */
std::string
cloudOfChair()
{
  constexpr double kStep = 0.008; // [m]
  const TriangleMesh mesh = readMesh(test::storedModel("chair") + "/model.ply");
  std::ostringstream cloud;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]];
    const Eigen::Vector3d u = mesh.vertices[t[1]] - a, v = mesh.vertices[t[2]] - a;
    for (double s = 0; s <= 1; s += kStep / u.norm())
      for (double r = 0; r <= 1 - s; r += kStep / v.norm()) {
        const Eigen::Vector3d p = 1000 * (a + s * u + r * v);
        cloud << p.x() << ' ' << p.z() << ' ' << -p.y() << '\n';
      }
  }
  return cloud.str();
}

class Locate : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    room_.emplace();
    truth_ = readMapObjects(room_->sim() / "objects_truth.json");
  }
  static void
  TearDownTestSuite()
  {
    room_.reset();
  }

  std::string
  out(const std::string& file = "") const
  {
    return (folder_ / "out").string() + (file.empty() ? "" : "/" + file);
  }

  Outcome
  locate(const std::string& input,
         const std::vector<std::string>& models,
         const std::vector<std::string>& more = {}) const
  {
    std::vector<std::string> arguments = {"locate", input, "-o", out(), "--model"};
    arguments.insert(arguments.end(), models.begin(), models.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::runProgram(test::kObjectsProgram, arguments);
  }

  /** Expects an object to be a true one, so near and so little turned.
   * \return the id of the true one */
  static std::size_t
  expectTrue(const MapObject& object, double shift, double turn)
  {
    std::size_t best = 0;
    double nearest = INFINITY;
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      const double distance = (truth_[i].pose.T_world_object.translation() -
                               object.pose.T_world_object.translation())
                                  .norm();
      if (distance < nearest) {
        nearest = distance;
        best = i;
      }
    }
    EXPECT_LT(nearest, shift);
    EXPECT_EQ(object.pose.object_class, truth_[best].pose.object_class);
    EXPECT_LT(turnBetween(object, truth_[best]), turn);
    return best + 1;
  }

  static std::optional<test::LocatedRoom> room_;
  static std::vector<MapObject> truth_;
  test::TempFolder folder_;
};

std::optional<test::LocatedRoom> Locate::room_;
std::vector<MapObject> Locate::truth_;
} // namespace

TEST_F(Locate, MakesOneObjectOfWhatSeveralScansSaw)
{
  const Outcome outcome = locate(
      room_->sim().string(), {test::storedModel("chair"), test::storedModel("table")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("3 objects in 3 scans"), std::string::npos) << outcome.out;
  const auto found = readMapObjects(out("objects.json"));
  ASSERT_EQ(found.size(), 3u);
  std::map<std::size_t, std::size_t> truth_of; // by the id that was found
  std::set<std::size_t> all;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const MapObject& object = found[i];
    truth_of[i + 1] = expectTrue(object, 0.02, 2 * kDegree);
    all.insert(truth_of[i + 1]);
    EXPECT_GE(object.scans.size(), 2u);
    EXPECT_GT(object.score, 0.5);
    EXPECT_GT(object.visible_fraction, 0.5);
    EXPECT_LT(object.rms, 0.02);
    EXPECT_GT(object.pose.points, 200u);
    EXPECT_TRUE(object.covariance);
    EXPECT_FALSE(object.pose.moves);
  }
  EXPECT_EQ(all.size(), 3u);
  // The scans are as they were, with the objects that were found beside the true ones.
  std::size_t right = 0, wrong = 0;
  for (const char* const name : {"scan000.pcd", "scan001.pcd", "scan002.pcd"}) {
    const Scan before = readScan(room_->sim() / name);
    const Scan after = readScan(folder_ / "out" / "scans" / name);
    ASSERT_EQ(after.cloud.width * after.cloud.height,
              before.cloud.width * before.cloud.height);
    const auto true_ids = fieldValues(after.cloud, "object_id");
    const auto ids = fieldValues(after.cloud, "located_id");
    ASSERT_TRUE(true_ids);
    ASSERT_TRUE(ids);
    for (std::size_t i = 0; i < ids->values.size(); ++i)
      if (ids->values[i] > 0)
        ++(truth_of[static_cast<std::size_t>(ids->values[i])] ==
                   static_cast<std::size_t>(true_ids->values[i])
               ? right
               : wrong);
  }
  EXPECT_GT(right, 1000u);
  EXPECT_LT(wrong, 0.1 * static_cast<double>(right));
}

TEST_F(Locate, KeepsApartWhatEachScanSaw)
{
  const Outcome outcome =
      locate(room_->sim().string(), {test::storedModel("chair")}, {"--separate"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto found = readMapObjects(out("objects.json"));
  EXPECT_EQ(found.size(), 4u); // two chairs in two scans each
  for (const auto& object : found) {
    expectTrue(object, 0.03, 4 * kDegree); // of few points each
    EXPECT_EQ(object.scans.size(), 1u);
  }
}

TEST_F(Locate, TakesACloudWithoutNormalsAndWritesASingleScan)
{
  writeText(folder_ / "model.xyz", cloudOfChair());
  // The scan: points alone.
  const Scan scan = readScan(room_->sim() / "scan002.pcd");
  std::ofstream points(folder_ / "scan.xyz");
  for (const auto& p : scan.points)
    if (p.allFinite())
      points << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  points.close();
  const Outcome outcome =
      locate((folder_ / "scan.xyz").string(),
             {(folder_ / "model.xyz").string()},
             {"--class", "chair", "--scale", "0.001", "--up", "y", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  auto found = readMapObjects(out("objects.json"));
  ASSERT_EQ(found.size(), 2u);
  const Eigen::Isometry3d T_world_scan =
      readTrajectory(room_->sim() / "groundtruth.txt").poses[2];
  for (auto& chair : found) { // found in the frame of the scan
    chair.pose.T_world_object = T_world_scan * chair.pose.T_world_object;
    expectTrue(chair, 0.05, 4 * kDegree); // of few points, by estimated normals
  }
  const Scan labelled = readScan(out("objects.pcd"));
  const auto ids = fieldValues(labelled.cloud, "object_id");
  ASSERT_TRUE(ids);
  std::size_t on_first = 0;
  for (const double id : ids->values)
    on_first += id == 1 ? 1 : 0;
  EXPECT_EQ(on_first, found[0].pose.points);
}
