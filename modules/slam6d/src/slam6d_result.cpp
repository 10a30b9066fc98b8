// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <algorithm>

namespace pcl6d {

const char*
toString(ScanState state)
{
  switch (state) {
  case ScanState::kPending:
    return "pending";
  case ScanState::kFixed:
    return "fixed";
  case ScanState::kMatched:
    return "matched";
  case ScanState::kUnconverged:
    return "unconverged";
  case ScanState::kPredicted:
    return "predicted";
  }
  return "unknown";
}

ScanState
scanStateFromName(const std::string& name)
{
  for (const ScanState state : {ScanState::kPending,
                                ScanState::kFixed,
                                ScanState::kMatched,
                                ScanState::kUnconverged,
                                ScanState::kPredicted})
    if (name == toString(state))
      return state;
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
