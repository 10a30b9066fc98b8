// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/status.h>

namespace pcl6d {

namespace {
constexpr Named<Status> kStatuses[] = {{Status::kOk, "ok"},
                                       {Status::kRankDeficient, "rank-deficient"},
                                       {Status::kTooFewPairs, "too-few-pairs"},
                                       {Status::kMaxIterations, "max-iterations"},
                                       {Status::kDiverged, "diverged"}};
} // namespace

const char*
toString(Status status)
{
  return nameOf(kStatuses, status);
}

Status
statusFromName(const std::string& name)
{
  if (const auto status = findNamed(kStatuses, name))
    return *status;
  throw BadArgument("no status is called '" + name + "'");
}

} // namespace pcl6d
