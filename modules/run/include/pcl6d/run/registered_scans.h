// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/io/scan_folder.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \return a length [m] used by a run, given or derived: "voxel", "max-range"
 * \param[in] file the run's summary, for messages
 * \throws IoFailed the option is missing or no number \ingroup run */
double
lengthOfRun(const RunResult& summary,
            const std::string& name,
            const std::filesystem::path& file);

/** \brief The scans of a folder with their poses: raw scans, or the scans of a finished run of
 * pcl_slam6d, recognised by its summary.json. \ingroup run */
class RegisteredScans {
public:
  /** \param[in] path the folder \param[in] options of the scans; no poses are accepted for a run
   * \throws IoFailed, BadArgument as ScanFolder; the run's summary is broken, or the run was
   * interrupted before its scans were written; poses are given for a run */
  explicit RegisteredScans(const std::filesystem::path& path,
                           const ScanFolderOptions& options = {});

  /** \brief Raw scans from an open folder, e.g. of a source. */
  explicit RegisteredScans(ScanFolder folder);

  const ScanFolder&
  folder() const
  {
    return folder_;
  }

  /** \return the pose of the i-th scan in full coordinates */
  Eigen::Isometry3d
  pose(std::size_t i) const;

  /** \return the number NNN of the i-th scan in the files of the run; of raw scans the
   * index in the folder */
  std::uint32_t
  index(std::size_t i) const
  {
    return indices_[i];
  }

  /** \return the offset [m] subtracted from joined points: the world offset of the run, or the
   * offset that a run with these poses would use */
  const Eigen::Vector3d&
  worldOffset() const
  {
    return world_offset_;
  }

  /** \return the shift applied to points far from the origin of their files */
  const std::optional<MovedPoints>&
  moved() const;

  /** \return the range gate [m] of the run; unlimited for raw scans */
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

  /** \return the summary of the run; none for raw scans */
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
