// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/status.h>

#include <gtest/gtest.h>

#include <set>
#include <string>

template <typename Error>
class Errors : public testing::Test {};
using ErrorTypes =
    testing::Types<pcl6d::BadArgument, pcl6d::ComputeFailed, pcl6d::IoFailed>;
TYPED_TEST_SUITE(Errors, ErrorTypes);

TYPED_TEST(Errors, AreCaughtAsPclExceptionsAndSayOnlyTheirMessage)
{
  const std::string message = "scan003.pcd: line 12: expected 3 numbers, got 2";
  try {
    throw TypeParam(message);
  } catch (const pcl::PCLException& e) {
    EXPECT_EQ(e.what(), message);
  }
}

TEST(StatusNames, AreAllDifferent)
{
  using pcl6d::Status;
  std::set<std::string> names;
  for (const auto status : {Status::kOk,
                            Status::kRankDeficient,
                            Status::kTooFewPairs,
                            Status::kMaxIterations,
                            Status::kDiverged})
    names.insert(pcl6d::toString(status));
  EXPECT_EQ(names.size(), 5u);
  EXPECT_EQ(names.count("unknown"), 0u);
}
