// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_source.h>

#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The scans of a folder as a source. ScanFolder finds the scans and their poses; points
 * keep the coordinates of their files. Fields and numbers of points are not known before a scan
 * is read.
 * \ingroup sources */
class FolderSource : public ScanSource {
public:
  /** \throws IoFailed under the conditions of ScanFolder */
  explicit FolderSource(const std::filesystem::path& path);

  const std::filesystem::path&
  path() const override
  {
    return path_;
  }
  std::string
  format() const override;
  const std::vector<SourceScan>&
  scans() const override
  {
    return scans_;
  }
  ScanCloud
  read(std::size_t i) const override;

private:
  std::filesystem::path path_;
  ScanFolder folder_;
  std::vector<SourceScan> scans_;
};

} // namespace pcl6d
