// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/suite/damaged_folder.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/trajectory_io.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ostream>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;
using Poses = std::vector<Eigen::Isometry3d>;

/** \return the motion with translation and angle scaled by the factor */
Eigen::Isometry3d
timesFactor(const Eigen::Isometry3d& motion, double factor)
{
  Eigen::AngleAxisd turn(motion.linear());
  turn.angle() *= factor;
  Eigen::Isometry3d product = Eigen::Isometry3d::Identity();
  product.linear() = turn.toRotationMatrix();
  product.translation() = factor * motion.translation();
  return product;
}

/** Scales the error of each odometry step; the first pose stays. */
void
addNoise(double factor, const Poses& truth, Poses& poses)
{
  Poses noisy = {poses.front()};
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Eigen::Isometry3d true_step = truth[i - 1].inverse() * truth[i];
    const Eigen::Isometry3d error =
        true_step.inverse() * poses[i - 1].inverse() * poses[i];
    noisy.push_back(noisy.back() * true_step * timesFactor(error, factor));
  }
  poses = noisy;
}

void
addJump(const SuiteDamage::Jump& jump, Poses& poses)
{
  const Eigen::Isometry3d before = poses[jump.scan - 1];
  const Eigen::Isometry3d leap =
      before * Eigen::Translation3d(jump.metres, 0, 0) * before.inverse();
  for (std::size_t i = jump.scan; i < poses.size(); ++i)
    poses[i] = leap * poses[i];
}

/** \return at most `points` points, evenly chosen */
pcl::PCLPointCloud2
thinned(const pcl::PCLPointCloud2& cloud, std::size_t points)
{
  const std::size_t total = std::size_t{cloud.width} * cloud.height;
  if (points >= total)
    return cloud;
  pcl::PCLPointCloud2 some = cloud;
  some.width = static_cast<std::uint32_t>(points);
  some.height = 1;
  some.row_step = cloud.point_step * some.width;
  some.data.resize(some.row_step);
  for (std::size_t i = 0; i < points; ++i)
    std::memcpy(&some.data[i * cloud.point_step],
                &cloud.data[i * total / points * cloud.point_step],
                cloud.point_step);
  return some;
}

/** Copies a folder of scans with a damage. */
class Damager {
public:
  Damager(const SuiteDamage& damage, const DamageSource& source)
  : damage_(damage), source_(source), folder_(source.scans, asTheyAre())
  {
    for (std::size_t i = 0; i < folder_.size(); ++i)
      files_.push_back(fs::absolute(folder_.file(i)));
    poses_ = folder_.odometry().poses;
    if (!source.truth.empty())
      truth_ = readTrajectory(source.truth).poses;
    if (!truth_.empty() && truth_.size() != files_.size())
      throw BadArgument(source.truth.string() + ": " + std::to_string(truth_.size()) +
                        " poses for " + std::to_string(files_.size()) + " scans");
    check();
  }

  void
  make(const fs::path& folder)
  {
    changePoses();
    changeScans();
    writeScans(folder);
    if (!damage_.no_poses && folder_.hasPoses())
      writeTrajectoryKitti(folder / "odometry.txt", {poses_, {}});
    if (!truth_.empty())
      writeTrajectoryKitti(folder / "groundtruth.txt", {truth_, {}});
    if (!folder_.stamps().empty())
      writeStamps(folder / "times.txt", folder_.stamps());
  }

private:
  static ScanFolderOptions
  asTheyAre()
  {
    ScanFolderOptions options;
    options.keep_coordinates = true;
    return options;
  }

  void
  requireScan(std::size_t index, const char* field) const
  {
    if (index >= files_.size())
      throw BadArgument(std::string(field) + " names scan " + std::to_string(index) +
                        ", but there are " + std::to_string(files_.size()));
  }

  void
  check() const
  {
    if (damage_.changesPoses() && !folder_.hasPoses())
      throw BadArgument("the scans have no poses to change");
    if (damage_.odometry_noise != 1 && truth_.empty())
      throw BadArgument("odometry_noise needs the truth");
    if (damage_.jump)
      requireScan(damage_.jump->scan, "jump");
    if (damage_.swap)
      for (const std::size_t index : {damage_.swap->first, damage_.swap->second})
        requireScan(index, "swap");
    if (damage_.foreign)
      requireScan(*damage_.foreign, "foreign");
    for (const auto& [a, b] : damage_.links)
      requireScan(std::max(a, b), "links");
  }

  void
  changePoses()
  {
    if (damage_.odometry_noise != 1)
      addNoise(damage_.odometry_noise, truth_, poses_);
    if (damage_.jump)
      addJump(*damage_.jump, poses_);
    for (auto& pose : poses_) {
      pose.translation() *= damage_.odometry_scale;
      if (damage_.turn != 0)
        pose.rotate(Eigen::AngleAxisd(radians(damage_.turn), Eigen::Vector3d::UnitZ()));
    }
  }

  void
  changeScans()
  {
    if (damage_.swap) {
      const auto [a, b] = *damage_.swap;
      std::swap(files_[a], files_[b]);
      if (!truth_.empty())
        std::swap(truth_[a], truth_[b]);
    }
    if (damage_.foreign) {
      const ScanFolder other(source_.foreign, asTheyAre());
      const std::size_t index = std::min(*damage_.foreign, other.size() - 1);
      if (other.format() != folder_.format())
        throw BadArgument("the foreign scan is " + toString(other.format()) +
                          ", the others are " + toString(folder_.format()));
      files_[*damage_.foreign] = fs::absolute(other.file(index));
    }
  }

  void
  writeScans(const fs::path& folder) const
  {
    // A pose inside a scan file would count, though the damage removes poses.
    const bool copies =
        damage_.points || (damage_.no_poses && folder_.format() == ScanFormat::kPcd);
    for (std::size_t i = 0; i < files_.size(); ++i) {
      char name[32];
      std::snprintf(name, sizeof name, "scan%03zu", i);
      fs::path file = folder / name;
      if (!copies) {
        fs::create_symlink(files_[i], file += files_[i].extension());
        continue;
      }
      const auto cloud = readScanCloud(files_[i], folder_.format()).cloud;
      writePcd(file += ".pcd", thinned(cloud, damage_.points.value_or(SIZE_MAX)));
    }
  }

  const SuiteDamage& damage_;
  const DamageSource& source_;
  const ScanFolder folder_;
  std::vector<fs::path> files_;
  Poses poses_;
  Poses truth_; ///< empty: not known
};
} // namespace

void
makeDamagedFolder(const SuiteDamage& damage,
                  const DamageSource& source,
                  const fs::path& folder)
{
  try {
    Damager(damage, source).make(folder);
  } catch (const fs::filesystem_error& error) {
    throw IoFailed(folder.string() + ": cannot write: " + error.code().message());
  }
}

void
writeLinks(const fs::path& file, const SuiteDamage& damage)
{
  writeFileAtomically(file, [&](std::ostream& stream) {
    for (const auto& [a, b] : damage.links)
      stream << a << ' ' << b << '\n';
  });
}

} // namespace pcl6d::app
