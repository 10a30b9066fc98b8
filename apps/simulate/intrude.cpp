// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/open_scans.h"
#include "common/process/interrupt.h"
#include "common/progress_bar.h"
#include "simulate/body_words.h"
#include "simulate/intrude.h"
#include "simulate/settings.h"
#include "simulate/simulated_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/global_registration/vertical.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace pcl6d::app {
namespace {
namespace fs = std::filesystem;
constexpr const char* kTruth = "groundtruth.txt";

/** \brief Reads the scans, lets the bodies in, and writes the folder. */
class Intrusion {
public:
  explicit Intrusion(const IntrudeSettings& settings)
  : s_(settings)
  , bar_(settings.quiet)
  , scans_(openScans(settings.input, settings.scans, bar_))
  , out_(
        simulatedFolder(settings.out, settings.force, {settings.input, settings.poses}))
  {
    requireNoOtherScans(out_);
    if (!scans_.folder().hasPoses() && !scans_.summary() && s_.poses.empty())
      throw IoFailed(s_.input + ": the scans have no poses; register the scans with "
                                "pcl_slam6d, and give the folder of the run");
    takeInitialPoses();
    takePoses();
    takeStamps();
  }

  int
  run()
  {
    IntruderOptions options = s_.intruders;
    if (s_.up == "auto")
      options.up = verticalOfScans();
    const Intruders intruders(
        trajectory_,
        [this](std::size_t i) {
          bar_.show({"looking for the ground", i + 1, size()});
          return coordinatesOf(scans_.folder().readCloud(i).cloud);
        },
        options);
    if (!writeScans(intruders)) {
      bar_.say("interrupted: nothing written");
      return kInterrupted;
    }
    writeTrajectoryKitti(out_ / "odometry.txt", initial_);
    writeStamps(out_ / "times.txt", trajectory_.stamps);
    copyTruth();
    writeRecord(intruders, options.up);
    out_.publish();
    if (!s_.quiet)
      std::printf(
          "%s: %zu scans, %zu points, %zu of them (%.2f %%) on moving bodies: %d "
          "people, %d cars\nwritten to %s: scan*.pcd odometry.txt times.txt %s%s\n",
          s_.input.c_str(),
          size(),
          points_,
          moving_,
          100.0 * static_cast<double>(moving_) /
              static_cast<double>(std::max<std::size_t>(1, points_)),
          options.people,
          options.cars,
          s_.out.c_str(),
          has_truth_ ? "groundtruth.txt " : "",
          kSceneFile);
    return kDone;
  }

private:
  std::size_t
  size() const
  {
    return scans_.folder().size();
  }

  void
  takeInitialPoses()
  {
    for (std::size_t i = 0; i < size(); ++i)
      initial_.poses.push_back(scans_.summary()
                                   ? scans_.summary()->scans[i].initial_pose
                                   : scans_.folder().initialPose(i));
  }

  // Ground-truth poses may be used: the program estimates nothing from them.
  void
  takePoses()
  {
    if (s_.poses.empty()) {
      for (std::size_t i = 0; i < size(); ++i)
        trajectory_.poses.push_back(scans_.pose(i));
      return;
    }
    trajectory_ = readTrajectory(s_.poses);
    if (trajectory_.poses.size() != size())
      throw IoFailed(s_.poses + ": " + std::to_string(trajectory_.poses.size()) +
                     " poses, but " + std::to_string(size()) + " scans");
    if (const auto& moved = scans_.moved())
      for (auto& pose : trajectory_.poses)
        pose = moved->ofNear(pose);
  }

  void
  takeStamps()
  {
    if (trajectory_.stamps.empty())
      trajectory_.stamps = scans_.folder().stamps();
    if (!trajectory_.stamps.empty() && !s_.period)
      return;
    trajectory_.stamps.clear();
    for (std::size_t i = 0; i < size(); ++i)
      trajectory_.stamps.push_back(static_cast<double>(i) * s_.period.value_or(1));
  }

  // The mean of the scans' verticals that are certain or near the z of the poses. Walls
  // alone leave three directions, of which the expected direction is taken.
  Eigen::Vector3d
  verticalOfScans()
  {
    constexpr std::size_t kSome = 8; // scans along the way
    constexpr double kTilted =
        0.9397; // cosine of 20 deg, for poses that begin at a sensor
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const std::size_t step = (size() + kSome - 1) / kSome;
    for (std::size_t i = 0; i < size(); i += step) {
      bar_.show({"looking for the vertical", i + 1, size()});
      const Eigen::Matrix3d R = trajectory_.poses[i].linear();
      const VerticalEstimate estimate =
          estimateVerticalOfScan(coordinatesOf(scans_.folder().readCloud(i).cloud),
                                 R.transpose() * Eigen::Vector3d::UnitZ(),
                                 s_.intruders.num_threads);
      const Eigen::Vector3d up = R * estimate.up;
      if (estimate.is_sure || up.z() > kTilted)
        sum += up;
    }
    return sum.norm() > 0 ? Eigen::Vector3d(sum.normalized())
                          : Eigen::Vector3d::UnitZ();
  }

  bool
  writeScans(const Intruders& intruders)
  {
    const Interrupt interrupt;
    for (std::size_t i = 0; i < size(); ++i) {
      if (interrupt.requested())
        return false;
      ScanCloud scan = scans_.folder().readCloud(i);
      if (fieldValues(scan.cloud, "dynamic"))
        throw IoFailed(scans_.folder().file(i).string() +
                       ": already has a field dynamic, from other moving bodies; give "
                       "scans without this field");
      const Points measured = coordinatesOf(scan.cloud);
      const IntrudedPoints intruded = intruders.enter(i, measured);
      std::vector<double> dynamic(measured.size(), 0);
      for (std::size_t k = 0; k < intruded.indices.size(); ++k) {
        dynamic[intruded.indices[k]] = 1;
        storePoint(intruded.points[k], intruded.indices[k], scan.cloud);
      }
      addField(scan.cloud, "dynamic", pcl::PCLPointField::UINT32, dynamic);
      writePcd(out_ / (scanName(static_cast<int>(i)) + ".pcd"),
               scan.cloud,
               initial_.poses[i]);
      points_ += measured.size();
      moving_ += intruded.indices.size();
      bar_.show({"intruding", i + 1, size()});
    }
    return true;
  }

  // Writes this point only: other points keep their bits, also in double coordinates.
  static void
  storePoint(const Eigen::Vector3f& point, std::size_t i, pcl::PCLPointCloud2& cloud)
  {
    constexpr const char* kNames[] = {"x", "y", "z"};
    for (const auto& field : cloud.fields)
      for (int axis = 0; axis < 3; ++axis) {
        if (field.name != kNames[axis])
          continue;
        std::uint8_t* const at = &cloud.data[i * cloud.point_step + field.offset];
        const double wide = point[axis];
        if (field.datatype == pcl::PCLPointField::FLOAT64)
          std::memcpy(at, &wide, sizeof wide);
        else
          std::memcpy(at, &point[axis], sizeof(float));
      }
  }

  void
  copyTruth()
  {
    const fs::path truth = fs::path(s_.input) / kTruth;
    std::error_code missing;
    has_truth_ = fs::is_regular_file(truth, missing);
    if (!has_truth_)
      return;
    std::error_code error;
    fs::copy_file(truth, out_ / kTruth, error);
    if (error)
      throw IoFailed(truth.string() + ": cannot be copied: " + error.message());
  }

  void
  writeRecord(const Intruders& intruders, const Eigen::Vector3d& up)
  {
    std::vector<MovingBody> bodies;
    for (std::size_t i = 0; i < intruders.size(); ++i)
      bodies.push_back(intruders.body(i));
    const nlohmann::ordered_json json = {
        {"schema_version", 1},
        {"generator", kSimulate},
        {"scene", kIntrude},
        {"input", fs::path(s_.input).lexically_normal().filename().string()},
        {"poses", s_.poses.empty() ? scans_.poseSource() : s_.poses},
        {"up", rowByRow(up)},
        {"seed", s_.intruders.seed},
        {"traffic", {{"people", s_.intruders.people}, {"cars", s_.intruders.cars}}},
        {"bodies", describeBodies(bodies, intruders.worldFromLevel())}};
    writeJson(out_ / kSceneFile, json, 2);
  }

  const IntrudeSettings& s_;
  ProgressBar bar_;
  RegisteredScans scans_;
  OutputFolder out_;
  Trajectory initial_;    // written
  Trajectory trajectory_; // walked by
  std::size_t points_ = 0, moving_ = 0;
  bool has_truth_ = false;
};
} // namespace

int
runIntrude(const Arguments& arguments)
{
  IntrudeSettings settings;
  if (!parseIntrudeSettings(arguments, settings))
    return kDone;
  return Intrusion(settings).run();
}

} // namespace pcl6d::app
