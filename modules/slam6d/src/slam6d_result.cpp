// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/name_table.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <algorithm>

namespace pcl6d {

namespace {
constexpr Named<ScanState> kStates[] = {{ScanState::kPending, "pending"},
                                        {ScanState::kFixed, "fixed"},
                                        {ScanState::kMatched, "matched"},
                                        {ScanState::kUnconverged, "unconverged"},
                                        {ScanState::kPredicted, "predicted"}};
} // namespace

const char*
toString(ScanState state)
{
  return nameOf(kStates, state);
}

ScanState
scanStateFromName(const std::string& name)
{
  if (const auto state = findNamed(kStates, name))
    return *state;
  throw BadArgument("no state of a scan is called '" + name + "'");
}

std::size_t
Slam6DResult::count(ScanState state) const
{
  return std::count_if(scans.begin(), scans.end(), [&](const ScanResult& scan) {
    return scan.state == state;
  });
}

bool
Slam6DResult::trusted() const
{
  return floating.empty() &&
         count(ScanState::kFixed) + count(ScanState::kMatched) == scans.size();
}

} // namespace pcl6d
