// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/dataset_layout.h>

#include <string>
#include <vector>

/** \file The layouts of known data sets. */
namespace pcl6d::io {

/** \brief Meaning of the name of a scan. */
enum class ScanNames {
  kNumber,
  kNanoseconds,
  kMicroseconds,
  kSecondsNanoseconds,
  kDecimal
};

/** \brief A layout. Paths are relative to the folder of a sequence; "*" is the name of the
 * sequence. */
struct DatasetRule {
  const char* name;
  std::vector<const char*>
      scans;             ///< folders of the scans; the first existing folder is used
  const char* extension; ///< of the scans
  ScanNames names;
  std::vector<const char*> evidence; ///< at least one must exist; empty: names suffice
  const char* around; ///< name of the folder around the sequence; null: any
  BinLayout bin_layout;
  const char* frame;
  const char* stamps; ///< file; null: the stamps are in the names, if at all
  const char* calibration;
  std::vector<const char*> references; ///< the first existing file is used
  PointTimeRule times;
  const char* times_text;
};

/** \return all layouts; if two match, the earlier is used */
const std::vector<DatasetRule>&
datasetRules();

/** \return whether the name of a scan is of the kind */
bool
isNamed(const std::filesystem::path& scan, ScanNames kind);

} // namespace pcl6d::io
