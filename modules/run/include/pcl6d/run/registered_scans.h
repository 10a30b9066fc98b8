// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/run/run_summary.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \return a length [m] that a run worked with, given or derived: "voxel", "max-range"
 * \param[in] file its summary, for messages
 * \throws IoFailed there is no such option, or it is no number \ingroup run */
double
lengthOfRun(const RunResult& summary,
            const std::string& name,
            const std::filesystem::path& file);

/** \brief The scans of a folder and their poses: raw ones, or those of a finished run of
 * pcl_slam6d, which is known by its summary.json. \ingroup run */
class RegisteredScans {
public:
  /** \param[in] path the folder \param[in] options of the scans; a run takes no poses
   * \throws IoFailed, BadArgument as ScanFolder; the run's summary is broken, or it was
   * interrupted ahead of its scans; poses are given for a run */
  explicit RegisteredScans(const std::filesystem::path& path,
                           const ScanFolderOptions& options = {});

  const ScanFolder&
  folder() const
  {
    return folder_;
  }

  /** \return the pose of the i-th scan in full coordinates */
  Eigen::Isometry3d
  pose(std::size_t i) const;

  /** \return the number NNN of the i-th scan in the files of the run; of raw scans the
   * place in the folder */
  std::uint32_t
  index(std::size_t i) const
  {
    return indices_[i];
  }

  /** \return what joined points are relative to [m]: the world offset of the run, or what
   * a run on these poses would take */
  const Eigen::Vector3d&
  worldOffset() const
  {
    return world_offset_;
  }

  /** \return how points that lie far from the origin of their files were brought near */
  const std::optional<MovedPoints>&
  moved() const;

  /** \return the ranges [m] that the run took for surfaces; all if it is none */
  double
  minRange() const
  {
    return min_range_;
  }
  double
  maxRange() const
  {
    return max_range_;
  }

  /** \return where the poses come from, in words */
  std::string
  poseSource() const;

  /** \return what the run tells of itself; none for raw scans */
  const std::optional<RunResult>&
  summary() const
  {
    return summary_;
  }

private:
  void
  readRun(const std::filesystem::path& summary_file);

  std::optional<RunResult> summary_;
  ScanFolder folder_;
  Eigen::Vector3d world_offset_;
  std::vector<std::uint32_t> indices_;
  double min_range_ = 0;
  double max_range_ = std::numeric_limits<double>::infinity();
};

} // namespace pcl6d
