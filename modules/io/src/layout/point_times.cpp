// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/io/point_times.h>
#include <pcl6d/io/scan_fields.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl6d {

namespace {
constexpr const char* kTime = "time";
constexpr std::size_t kRows = 64, kColumns = 1024;   // of MulRan's scanner
constexpr double kTurn = 2 * 3.14159265358979323846; // [rad]

/** \return shares of a turn since the stamp: the scanner turns clockwise */
std::vector<double>
sharesByAzimuth(const pcl::PCLPointCloud2& cloud)
{
  const auto x = fieldValues(cloud, "x"), y = fieldValues(cloud, "y");
  if (!x || !y)
    return {};
  std::vector<double> shares(x->values.size());
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (std::isfinite(x->values[i]) && std::isfinite(y->values[i]))
      shares[i] = -portableAtan2(y->values[i], x->values[i]) / kTurn;
  return shares;
}

std::vector<double>
sharesByColumn(std::size_t count)
{
  std::vector<double> shares(count, 0.0);
  if (count == kRows * kColumns)
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t column = i / kRows;
      shares[i] = static_cast<double>(column) / static_cast<double>(kColumns);
    }
  return shares;
}
} // namespace

void
addPointTimes(const PointTimes& times, pcl::PCLPointCloud2& cloud)
{
  const bool has_time =
      std::any_of(cloud.fields.begin(), cloud.fields.end(), [](const auto& field) {
        return field.name == kTime;
      });
  const std::size_t count = std::size_t{cloud.width} * cloud.height;
  if (times.rule == PointTimeRule::kNone || !(times.period > 0) || has_time ||
      count == 0)
    return;
  std::vector<double> shares = times.rule == PointTimeRule::kAzimuth
                                   ? sharesByAzimuth(cloud)
                                   : sharesByColumn(count);
  if (shares.size() != count)
    return;
  for (double& share : shares)
    share *= times.period;
  addField(cloud, kTime, pcl::PCLPointField::FLOAT32, shares);
}

} // namespace pcl6d
