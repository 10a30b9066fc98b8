// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/scan_source.h>

namespace pcl6d {

ScanSource::~ScanSource() = default;

const std::filesystem::path&
ScanSource::fileOf(std::size_t /*i*/) const
{
  return path();
}

std::string
ScanSource::titleOf(std::size_t i) const
{
  return path().string() + ": scan " + std::to_string(i) + " (" + scans().at(i).name +
         ")";
}

std::string
ScanSource::poseSource() const
{
  return path().filename().string();
}

std::string
ScanSource::note() const
{
  return {};
}

} // namespace pcl6d
