// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/status.h>

const char*
pcl6d::toString(Status status)
{
  switch (status) {
  case Status::kOk:
    return "ok";
  case Status::kRankDeficient:
    return "rank-deficient";
  case Status::kTooFewPairs:
    return "too-few-pairs";
  case Status::kMaxIterations:
    return "max-iterations";
  case Status::kDiverged:
    return "diverged";
  }
  return "unknown";
}

pcl6d::Status
pcl6d::statusFromName(const std::string& name)
{
  for (const Status status : {Status::kOk,
                              Status::kRankDeficient,
                              Status::kTooFewPairs,
                              Status::kMaxIterations,
                              Status::kDiverged})
    if (name == toString(status))
      return status;
  throw BadArgument("no status is called '" + name + "'");
}
