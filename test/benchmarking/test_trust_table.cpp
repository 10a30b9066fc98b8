// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/trust_table.h>
#include <pcl6d/common/error.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

using pcl6d::TrustCall;
using pcl6d::TrustRun;
using pcl6d::TrustScan;
using pcl6d::TrustShare;
using pcl6d::TrustTable;

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// sqrt(16.27 / 7.815): the bound of 99.9 % per bound of 95 %
constexpr double k999Per95 = 1.442874;
constexpr double kRounding = 1e-5; // of the constant above

TrustScan
scan(double error, std::optional<double> bound = {}, bool named = false)
{
  return {"scan.pcd", error, bound, named, {}};
}

TrustRun
run(TrustCall call, std::vector<TrustScan> scans, const std::string& damage = "none")
{
  TrustRun made;
  made.data = "rooms";
  made.damage = damage;
  made.method = "defaults";
  made.name = "runs/rooms, " + damage;
  made.call = call;
  made.scans = std::move(scans);
  return made;
}
} // namespace

TEST(AllowedError, IsTheBoundOf999PerMilleButNoLessThan5cm)
{
  EXPECT_EQ(allowedError(scan(0)), 0.05);
  EXPECT_EQ(allowedError(scan(0, 0.01)), 0.05);
  EXPECT_NEAR(allowedError(scan(0, 1.0)), k999Per95, kRounding);
}

TEST(WrongAndRight, NamedScansMayBeOffInAMapThatIsNotWrong)
{
  const TrustRun right = run(TrustCall::kGood, {scan(0), scan(0.05)});
  EXPECT_TRUE(isRight(right));
  EXPECT_FALSE(isWrong(right));
  const TrustRun wrong = run(TrustCall::kGood, {scan(0), scan(0.051)});
  EXPECT_FALSE(isRight(wrong));
  EXPECT_TRUE(isWrong(wrong));
  const TrustRun named = run(TrustCall::kDoubted, {scan(0), scan(9, {}, true)});
  EXPECT_FALSE(isRight(named)) << "a scan is off";
  EXPECT_FALSE(isWrong(named)) << "but it is named";
  const TrustRun bounded = run(TrustCall::kGood, {scan(0), scan(1.4, 1.0)});
  EXPECT_TRUE(isRight(bounded)) << "it says that it may be off";
  const TrustRun foreign = run(TrustCall::kGood, {scan(0), scan(kInfinity, 1e9)});
  EXPECT_TRUE(isWrong(foreign)) << "it has no true place";
  EXPECT_FALSE(isRight(run(TrustCall::kGood, {}))) << "nothing is known of it";
  EXPECT_EQ(largestUnnamedError(named), 0);
  EXPECT_EQ(largestUnnamedError(wrong), 0.051);
}

TEST(TrustShare, UpperBoundLeavesFivePercentToAsFewOrFewer)
{
  for (const auto& [count, of] : {std::pair<int, int>{0, 20}, {1, 20}, {3, 1000}}) {
    const double p =
        TrustShare{static_cast<std::size_t>(count), static_cast<std::size_t>(of)}
            .upperBound();
    double below = 0, term = std::pow(1 - p, of); // binomial, term by term
    for (int k = 0; k <= count; ++k) {
      below += term;
      term *= static_cast<double>(of - k) / (k + 1) * p / (1 - p);
    }
    EXPECT_NEAR(below, 0.05, 1e-9) << count << " of " << of;
  }
  EXPECT_NEAR((TrustShare{0, 1000}).upperBound(), 1 - std::pow(0.05, 1e-3), 1e-12)
      << "the rule of three";
  EXPECT_EQ((TrustShare{}).upperBound(), 1) << "never tried";
  EXPECT_EQ((TrustShare{}).rate(), 0);
  EXPECT_EQ((TrustShare{4, 4}).upperBound(), 1);
  EXPECT_EQ((TrustShare{1, 4}).rate(), 0.25);
  EXPECT_THROW((TrustShare{2, 1}).upperBound(), pcl6d::BadArgument);
}

TEST(TrustTable, CountsFalseGoodsAndFalseDoubts)
{
  TrustRun by_matching = run(TrustCall::kDoubted, {scan(0), scan(0.01)}, "every 2nd");
  by_matching.doubted_by_matching = true;
  TrustRun saved = run(TrustCall::kDoubted, {scan(0), scan(7), scan(0, {}, true)});
  saved.doubted_by_matching = true; // it names a scan that is not off
  const std::vector<TrustRun> runs = {
      run(TrustCall::kGood, {scan(0), scan(0.01)}),
      run(TrustCall::kGood, {scan(0), scan(7)}), // the false good
      run(TrustCall::kUnverified, {scan(0), scan(7)}),
      run(TrustCall::kDoubted, {scan(0), scan(7)}),
      run(TrustCall::kDoubted, {scan(0), scan(7, {}, true)}), // neither right nor wrong
      run(TrustCall::kDoubted, {scan(0), scan(0.01)}, "every 2nd"), // false doubts
      by_matching,
      saved,
      run(TrustCall::kNone, {}),
      run(TrustCall::kGood, {})};
  const TrustTable table = trustTable(runs);
  const auto& all = table.all;
  EXPECT_EQ(all.runs, 10u);
  EXPECT_EQ(all.failed, 1u);
  EXPECT_EQ(all.without_truth, 1u);
  EXPECT_EQ(all.good, 2u);
  EXPECT_EQ(all.unverified, 1u);
  EXPECT_EQ(all.doubted, 5u);
  EXPECT_EQ(all.wrong, 4u);
  EXPECT_EQ(all.right, 3u);
  EXPECT_EQ(all.false_goods.count, 1u);
  EXPECT_EQ(all.false_goods.of, 2u);
  EXPECT_EQ(all.missed.of, 4u);
  EXPECT_EQ(all.false_unverified.count, 1u);
  EXPECT_EQ(all.false_verifications.count, 2u) << "the false good, and one saved";
  EXPECT_EQ(all.false_verifications.of, 4u);
  EXPECT_EQ(all.false_doubts.count, 2u);
  EXPECT_EQ(all.false_doubts.of, 3u);
  EXPECT_EQ(all.by_matching, 1u);
  ASSERT_EQ(table.by_damage.size(), 2u);
  EXPECT_EQ(table.by_damage[0].damage, "none");
  EXPECT_EQ(table.by_damage[0].runs, 8u);
  EXPECT_EQ(table.by_damage[1].false_doubts.count, 2u);
  EXPECT_EQ(table.by_damage[1].false_goods.count, 0u);
  ASSERT_EQ(table.by_data.size(), 1u);
  EXPECT_EQ(table.by_data[0].runs, 10u);
  EXPECT_EQ(table.cells.size(), 2u);
}

TEST(TrustTable, ComparesStatedBoundsWithErrorsOfMapsCalledGood)
{
  auto exact = scan(0.01, 0.015);
  exact.squared_error = 6;
  auto other = scan(0.02, 0.015);
  other.squared_error = 1.5;
  auto far = scan(0.3, 0.015); // beyond 99.9 %: its map is wrong
  far.squared_error = 1e6;
  const std::vector<TrustRun> runs = {
      run(TrustCall::kGood, {scan(0, 0.0), exact, other, scan(9, 0.015, true)}),
      run(TrustCall::kGood, {scan(0, 0.0), far, scan(kInfinity, 0.7), scan(0.6, 0.7)}),
      run(TrustCall::kDoubted, {scan(0, 0.0), exact})};
  const TrustTable table = trustTable(runs);
  ASSERT_EQ(table.bounds.size(), 2u);
  const auto& small = table.bounds[0];
  EXPECT_EQ(small.above, 0.01);
  EXPECT_EQ(small.up_to, 0.02);
  EXPECT_EQ(small.scans, 3u) << "neither the named one nor the doubted map counts";
  EXPECT_EQ(small.within, 1u);
  EXPECT_EQ(small.within_999, 2u);
  EXPECT_NEAR(small.median_ratio, 0.02 / 0.015, 1e-12);
  EXPECT_EQ(table.bounds[1].up_to, kInfinity);
  EXPECT_EQ(table.bounds[1].within, 1u);
  EXPECT_EQ(table.squared_errors.scans, 2u) << "not of the wrong map";
  EXPECT_NEAR(table.squared_errors.mean, (6 + 1.5) / 2 / 3, 1e-12);
}

TEST(TrustTexts, NameTheFalseGoodsFirst)
{
  const std::vector<TrustRun> runs = {
      run(TrustCall::kGood, {scan(0), scan(7.25)}, "jump | far"),
      run(TrustCall::kGood, {scan(0), scan(kInfinity)}, "foreign"),
      run(TrustCall::kDoubted, {scan(0)}, "every 2nd")};
  const std::string text = trustMarkdown(runs);
  const auto goods = text.find("### False goods\n- runs/rooms, foreign");
  ASSERT_NE(goods, std::string::npos) << text;
  EXPECT_LT(goods, text.find("- runs/rooms, jump")) << "the largest error first";
  EXPECT_LT(goods, text.find("### By damage"));
  EXPECT_NE(text.find("off by 7.250 m, allowed 0.050 m (no bound"), std::string::npos);
  EXPECT_NE(text.find("has no true place"), std::string::npos);
  EXPECT_NE(text.find("| jump \\| far |"), std::string::npos) << "a bar ends a cell";
  EXPECT_NE(text.find("2 (<= 100.0 %)"), std::string::npos);
  const std::string csv = trustCsv(runs);
  EXPECT_NE(
      csv.find("rooms,foreign,defaults,\"runs/rooms, foreign\",good,0,1,0,2,0,inf"),
      std::string::npos)
      << csv;
  const auto json = nlohmann::json::parse(trustJson(runs));
  EXPECT_EQ(json["all"]["false_goods"]["count"], 2);
  EXPECT_EQ(json["runs"][0]["scans"][1]["error_m"], 7.25);
  EXPECT_TRUE(json["runs"][1]["scans"][1]["error_m"].is_null());
  EXPECT_EQ(json["runs"][2]["right"], true);
}

TEST(TrustTexts, AreThereForNoRuns)
{
  EXPECT_NE(pcl6d::trustMarkdown({}).find("| 0 |"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(pcl6d::trustJson({}))["runs"].size(), 0u);
}
