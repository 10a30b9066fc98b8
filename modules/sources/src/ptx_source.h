// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/io/ptx_io.h>
#include <pcl6d/io/scan_source.h>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The scans of a PTX file (readPtxScan()), with the poses of their headers. Scans are
 * named by the stem of the file: "hall" for a single scan, else "hall_000", "hall_001" and so
 * on.
 * \ingroup sources */
class PtxSource : public ScanSource {
public:
  /** \brief Reads the headers. \throws IoFailed under the conditions of listPtxScans() */
  explicit PtxSource(const std::filesystem::path& path);

  const std::filesystem::path&
  path() const override
  {
    return path_;
  }
  std::string
  format() const override
  {
    return "ptx";
  }
  const std::vector<SourceScan>&
  scans() const override
  {
    return scans_;
  }
  ScanCloud
  read(std::size_t i) const override;

private:
  std::filesystem::path path_;
  std::vector<PtxScan> places_;
  std::vector<SourceScan> scans_;
};

} // namespace pcl6d
