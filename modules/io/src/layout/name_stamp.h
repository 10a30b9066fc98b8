// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "layout/dataset_rules.h"

#include <optional>

/** \file Time stamps in the names of scans. */
namespace pcl6d::io {

struct NameStamp {
  double seconds = 0; ///< since 1970
  ScanNames kind = ScanNames::kNanoseconds;
};

/** \return the stamp in the name of a file, described at stampsOfNames(); or empty */
std::optional<NameStamp>
stampOfName(const std::filesystem::path& scan);

} // namespace pcl6d::io
