// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/filters/line_filter.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/scan_fields.h>

#include <limits>

namespace pcl6d {

namespace {
constexpr Named<LineFilter> kLineFilters[] = {
    {LineFilter::kNone, "none"},
    {LineFilter::kMedian, "scanline-median"},
    {LineFilter::kReduction, "scanline-reduction"},
    {LineFilter::kBoth, "scanline-both"}};

constexpr double kBelowCode = 0.999; // a gate of deriveScanParameters() ends there, too

/** \return the place of each point in the rows of the file */
std::vector<std::size_t>
placesOf(const Scan& scan)
{
  require(scan.row_length > 0,
          "scan lines",
          "none",
          "set: a file of rows, each row a line of the scanner");
  require(scan.places.empty() || scan.places.size() == scan.points.size(),
          "number of points",
          scan.points.size(),
          "that of the file");
  std::vector<std::size_t> places(scan.points.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = scan.places.empty() ? i : scan.places[i];
  return places;
}

/** \return the points in the rows of the file, NaN without an echo */
Points
inRows(const Scan& scan, const std::vector<std::size_t>& places)
{
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  Points rows(places.empty() ? 0 : places.back() + 1, Eigen::Vector3f::Constant(kNan));
  for (std::size_t i = 0; i < places.size(); ++i)
    rows[places[i]] = scan.points[i];
  if (const auto code = noReturnRange(scan.points))
    maskOutOfRange(0, kBelowCode * *code, rows);
  return rows;
}
} // namespace

LineFilter
lineFilterFromName(const std::string& name)
{
  return fromName(kLineFilters, "filter", name);
}

std::vector<std::string>
lineFilterNames()
{
  return namesOf(kLineFilters);
}

std::string
toString(LineFilter filter)
{
  return nameOf(kLineFilters, filter);
}

void
filterByMedian(Scan& scan, const ScanLineMedianOptions& options)
{
  const std::vector<std::size_t> places = placesOf(scan);
  const Points filtered =
      medianAlongLines(inRows(scan, places), scan.row_length, options);
  for (std::size_t i = 0; i < places.size(); ++i)
    if (filtered[places[i]].allFinite())
      scan.points[i] = filtered[places[i]];
  storeCoordinates(scan.points, scan.cloud);
}

void
reduceLines(Scan& scan, const ScanLineReductionOptions& options)
{
  scan.points =
      reduceAlongLines(inRows(scan, placesOf(scan)), scan.row_length, options);
}

} // namespace pcl6d
