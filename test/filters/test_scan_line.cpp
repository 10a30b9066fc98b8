// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"

#include <pcl6d/common/random.h>
#include <pcl6d/filters/scan_line.h>

#include <algorithm>
#include <cmath>

using pcl6d::medianAlongLines;
using pcl6d::Points;
using pcl6d::reduceAlongLines;
using pcl6d::ScanLineMedianOptions;
using pcl6d::ScanLineReductionOptions;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;

namespace {
/** Rays along x: the point is its range. */
Points
onX(const std::vector<float>& ranges)
{
  Points points;
  for (const float r : ranges)
    points.push_back({r, 0, 0});
  return points;
}

/** The median by its definition, with all values of the window in order. */
Points
medianByDefinition(const Points& points,
                   std::size_t length,
                   int window,
                   double threshold)
{
  Points result = points;
  const int half = window / 2, count = static_cast<int>(points.size());
  const auto valid = [&](int k) {
    return points[k].allFinite() && points[k] != Eigen::Vector3f::Zero();
  };
  const auto lineOf = [&](int k) { return k / static_cast<int>(length); };
  for (int i = 0; i < count; ++i) {
    std::vector<double> r;
    for (int k = std::max(0, i - half); k <= std::min(count - 1, i + half); ++k)
      if (lineOf(k) == lineOf(i) && valid(k))
        r.push_back(points[k].cast<double>().norm());
    if (!valid(i))
      continue;
    std::sort(r.begin(), r.end());
    const double own = points[i].cast<double>().norm();
    const double a = r[(r.size() - 1) / 2], b = r[r.size() / 2];
    const double median = own - a <= b - own ? a : b;
    if (std::abs(own - median) > threshold)
      result[i] = (points[i].cast<double>() * (median / own)).cast<float>();
  }
  return result;
}

/** Lines that see a wall with gaps, poles, mixed pixels and values without echo. */
Points
scanLines()
{
  pcl6d::Random random(11);
  Points points;
  for (int i = 0; i < 3000; ++i) {
    const double angle = 0.01 * (i % 100);
    double range = 5 + (i / 13 % 3) * 2.5 + 0.01 * random.normal();
    if (random.uniform() < 0.1)
      range += random.uniform(-4, 8);
    Eigen::Vector3d p(range * (1 - angle * angle / 2), range * angle, 0.3);
    points.push_back(p.cast<float>());
    if (random.uniform() < 0.1)
      points.back() = random.uniform() < 0.5 ? Eigen::Vector3f(kNan, 0, 0)
                                             : Eigen::Vector3f(0, 0, 0);
  }
  return points;
}

/** Same bits, NaN equal to NaN. */
void
expectSameBits(const Points& found, const Points& expected)
{
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::isnan(found[i][axis]) && std::isnan(expected[i][axis]))) {
        ASSERT_EQ(found[i][axis], expected[i][axis]) << "point " << i;
      }
}
} // namespace

TEST(MedianAlongLines, MovesAMixedPixelAlongItsRay)
{
  Points points(7, {3, 4, 0});
  points[3] = {0, 6, 8}; // range 10 among ranges of 5
  Points expected = points;
  expected[3] = {0, 3, 4};
  expectSameBits(medianAlongLines(points, 7), expected);
}

TEST(MedianAlongLines, LeavesDifferencesUpToTheThreshold)
{
  const Points at = onX({5, 5, 5, 7, 5, 5, 5});
  expectSameBits(medianAlongLines(at, 7), at);
  const Points above = onX({5, 5, 5, 7.001f, 5, 5, 5});
  expectSameBits(medianAlongLines(above, 7), onX({5, 5, 5, 5, 5, 5, 5}));
}

TEST(MedianAlongLines, KeepsAnEdge)
{
  const Points edge = onX({5, 5, 5, 5, 9, 9, 9, 9});
  expectSameBits(medianAlongLines(edge, 8), edge);
  const Points early = onX({5, 5, 9, 9}); // nearer than the other of the middle two
  expectSameBits(medianAlongLines(early, 7), early);
}

TEST(MedianAlongLines, DoesNotLookAcrossTheEndOfALine)
{
  const Points points = onX({5, 5, 5, 9, 9, 9, 5, 5});
  expectSameBits(medianAlongLines(points, 3), points);
  const Points one_line = medianAlongLines(points, 8);
  EXPECT_NE(one_line[6], points[6]) << "where the same points are one line";
}

TEST(MedianAlongLines, IsTheDefinition)
{
  const Points points = scanLines();
  for (const std::size_t length : {1, 2, 3, 7, 100, 360, 2999, 3000, 5000})
    for (const int window : {3, 7, 51}) {
      SCOPED_TRACE(std::to_string(length) + " a line, window " +
                   std::to_string(window));
      ScanLineMedianOptions options;
      options.window = window;
      options.threshold = 1.5;
      expectSameBits(medianAlongLines(points, length, options),
                     medianByDefinition(points, length, window, 1.5));
    }
}

TEST(MedianAlongLines, SkipsWhatIsInvalidAndLeavesIt)
{
  const Points points = onX({kNan, 0, 5, kInfinity, 12, 5, 5, kNan});
  const Points found = medianAlongLines(points, 8);
  expectSameBits(found, onX({kNan, 0, 5, kInfinity, 5, 5, 5, kNan}));
  const Points none(9, {kNan, kNan, kNan});
  expectSameBits(medianAlongLines(none, 4), none);
  EXPECT_TRUE(medianAlongLines({}, 4).empty());
}

TEST(ScanLineMedianOptions, NameTheValueThatBreaksItsRule)
{
  for (const int window : {-7, 0, 1, 2, 6}) {
    ScanLineMedianOptions o;
    o.window = window;
    EXPECT_EQ(badArgumentOf([&] { medianAlongLines({}, 1, o); }),
              "window = " + std::to_string(window) + ", but must be odd and >= 3");
  }
  for (const double bad : {0.0, -1.0, double{kNan}, double{kInfinity}}) {
    ScanLineMedianOptions o;
    o.threshold = bad;
    EXPECT_NE(badArgumentOf([&] { o.validate(); }).find("threshold = "),
              std::string::npos);
  }
  EXPECT_EQ(badArgumentOf([] { medianAlongLines({}, 0); }),
            "line_length = 0, but must be > 0");
}

TEST(ReduceAlongLines, MergesWhatIsNearTheFirstOfTheGroup)
{
  ScanLineReductionOptions o;
  o.max_distance = 1;
  // 1.75 is near 1 but not near 0, and 1 is not below the limit: groups 0-0.5 1-1.75 3.
  expectSameBits(reduceAlongLines(onX({0, 0.5f, 1, 1.75f, 3}), 5, o),
                 onX({0.25f, 1.375f, 3}));
}

TEST(ReduceAlongLines, EndsGroupsWithTheLineAndSkipsInvalidPoints)
{
  ScanLineReductionOptions o;
  o.max_distance = 10;
  const Points points = onX({1, kNan, 3, kNan, 5, 7, 8});
  expectSameBits(reduceAlongLines(points, 3, o), onX({2, 6, 8}));
  expectSameBits(reduceAlongLines(points, 7, o), onX({4.8f}));
  EXPECT_TRUE(reduceAlongLines(Points(5, {kNan, 0, 0}), 3, o).empty());
  EXPECT_TRUE(reduceAlongLines({}, 3, o).empty());
}

TEST(ReduceAlongLines, TakesEachNthLineFromTheFirstOn)
{
  ScanLineReductionOptions o;
  o.line_step = 3;
  const Points points = onX({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  expectSameBits(reduceAlongLines(points, 2, o), onX({0, 1, 6, 7, 12}));
}

TEST(GroupAlongLines, HoldsEveryFinitePointOnce)
{
  const Points points = scanLines();
  std::size_t last_end = 0, grouped = 0;
  for (const auto& group : pcl6d::groupAlongLines(points, 100)) {
    EXPECT_GE(group.begin, last_end);
    last_end = group.end;
    EXPECT_EQ(group.begin / 100, (group.end - 1) / 100) << "one line";
    EXPECT_TRUE(points[group.begin].allFinite());
    for (std::size_t i = group.begin; i < group.end; ++i)
      if (points[i].allFinite()) {
        ++grouped;
        EXPECT_LT((points[i] - points[group.begin]).norm(), 0.1f + 1e-6f);
      }
  }
  EXPECT_EQ(grouped, std::count_if(points.begin(), points.end(), [](const auto& p) {
              return p.allFinite();
            }));
}

TEST(ScanLineReductionOptions, NameTheValueThatBreaksItsRule)
{
  for (const double bad : {0.0, -1.0, double{kNan}, double{kInfinity}}) {
    ScanLineReductionOptions o;
    o.max_distance = bad;
    EXPECT_NE(
        badArgumentOf([&] { reduceAlongLines({}, 1, o); }).find("max_distance = "),
        std::string::npos);
  }
  ScanLineReductionOptions o;
  o.line_step = 0;
  EXPECT_EQ(badArgumentOf([&] { o.validate(); }), "line_step = 0, but must be >= 1");
  EXPECT_EQ(badArgumentOf([] { reduceAlongLines({}, 0); }),
            "line_length = 0, but must be > 0");
}
