// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/median.h>
#include <pcl6d/common/option_names.h>
#include <pcl6d/common/option_spec.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/filters/scan_sampling.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <utility>

namespace pcl6d {

namespace {
constexpr double kAnyRange = std::numeric_limits<double>::infinity();

double
rounded(double value, int digits)
{
  if (!(value > 0) || !std::isnormal(value))
    return value;
  std::ostringstream text; // 0.17 equals the 0.17 typed by a user, on every CPU
  text << std::setprecision(digits) << value;
  return std::stod(text.str());
}

/** \return the value > 0, rounded down to two digits */
double
roundedDown(double value)
{
  if (!std::isnormal(value))
    return value;
  std::ostringstream text; // 2.621440000000000e+04 becomes 2.6e+04
  text << std::scientific << std::setprecision(15) << value;
  const std::string digits = text.str();
  return std::stod(digits.substr(0, 3) + digits.substr(digits.find('e')));
}

std::string
metres(double value)
{
  std::ostringstream text;
  text << std::setprecision(3) << value << " m";
  return text.str();
}

/** A no-return code is no surface: the gate ends just below the code. Infinite without a code. */
Parameter
gateBelowCode(const std::vector<Points>& scans)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& scan : scans)
    if (const auto code = noReturnRange(scan))
      smallest = std::min(smallest, *code);
  return {rounded(0.999 * smallest, 4), false, "no-return code at " + metres(smallest)};
}

/** Enough for a voxel of two digits, which follows from the line spacing. */
constexpr int kDigitsOfLines = 3;

/** \return the sampling with the (upper) median line spacing */
ScanSampling
medianSampling(std::vector<ScanSampling> all)
{
  if (all.empty())
    return {};
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end(), [](const auto& a, const auto& b) {
    return a.lineSpacing() < b.lineSpacing();
  });
  return *middle;
}

/** One wild return must not end the run: a point beyond the grid cannot be numbered. The grid of
 * the metascan, half as wide, reaches 2^19 voxels; half of the reach is left for the way from its
 * origin to the scan. */
Parameter
gateAtGrid(double voxel)
{
  constexpr double kVoxels = 1 << 18;
  return {roundedDown(kVoxels * voxel),
          false,
          "as far as the grid of the reduction reaches"};
}
} // namespace

Parameter
orDerived(const std::optional<double>& option, const Parameter& otherwise)
{
  return option ? Parameter{*option, true, ""} : otherwise;
}

Parameter
derivedParameter(double value, const std::string& why, int digits)
{
  return {rounded(value, digits), false, why};
}

void
describe(ScanParameterOptions& o, ScanParameters& used, OptionList& list)
{
  list.add(kMinRangeOption, o.min_range)
      .inUnit("m")
      .within(from0())
      .derivedAs("0.2 m, at most a tenth of the median range", used.min_range)
      .withHelp("[m] or auto: nearer points are dropped");
  list.add(kMaxRangeOption, o.max_range)
      .inUnit("m")
      .within({0, kAnyRange, true, true, false, ">= --min-range"})
      .derivedAs(
          "just below the largest range of a scan if more than 0.5 % of the points "
          "have exactly the largest range and more than half lie nearer than 0.9 times "
          "the largest range (a no-return code; four digits); at most, and without a "
          "code, 2^18 voxels, rounded down: the reach of the reduction's grid",
          used.max_range)
      .withHelp("[m] or auto: farther points are dropped; auto drops no-return codes");
  list.add(kVoxelOption, o.voxel)
      .inUnit("m")
      .within(finiteAbove0())
      .derivedAs("the largest of 2.5 times the median point spacing, 1.3 times the "
                 "line spacing, and a 60th of the median range, or, if smaller, of the "
                 "size of the scanned object, for example on a turntable",
                 used.voxel)
      .withHelp("[m] or auto: edge length of the octree reduction");
  list.add("line-spacing", o.line_spacing)
      .inUnit("m")
      .within(finiteFrom0())
      .derivedAs("distance of neighbouring lines of a scan (rings of a spinning lidar) "
                 "at the median range, measured from the directions of the points "
                 "(three digits); a given value also sets the voxel; 0: no lines",
                 used.line_spacing)
      .countsIf([&o] { return !o.voxel; }, "where --voxel is derived")
      .withHelp("[m] or auto: distance between the lines of a scan (rings of a "
                "spinning lidar) at the median range; without --voxel, a voxel is 1.3 "
                "times the line spacing");
}

void
ScanParameterOptions::validate() const
{
  validateRangeLimits(min_range.value_or(0), max_range.value_or(kAnyRange));
  ScanParameterOptions options = *this;
  ScanParameters unused;
  OptionList list;
  describe(options, unused, list);
  list.check();
}

ScanParameters
deriveScanParameters(const ScanParameterOptions& options,
                     const std::vector<Points>& scans)
{
  ScanParameters p;
  p.max_range = orDerived(options.max_range, gateBelowCode(scans));
  std::vector<double> ranges, spreads, spacings;
  std::vector<ScanSampling> samplings;
  for (const auto& scan : scans) {
    const Points seen = gateByRange(scan, 0, p.max_range.value);
    ranges.push_back(medianRange(seen));
    spreads.push_back(medianSpread(seen));
    spacings.push_back(medianSpacing(seen));
    samplings.push_back(samplingOf(seen));
  }
  const double range = upperMedian(ranges), spacing = upperMedian(spacings);
  p.median_range = range;

  // The scanner's own housing and the robot are nearer than any room; 0.2 m holds for
  // scanners of rooms, the tenth of the range for small objects.
  p.min_range = orDerived(
      options.min_range,
      derivedParameter(std::min(0.2, 0.1 * range),
                       "0.2 m, at most a tenth of the median range " + metres(range)));
  // Fine enough to keep a surface's shape at the typical range, coarse enough that most voxels
  // average several points. An object small compared with its range, on a turntable for example,
  // keeps its shape: half of its points lie within a spread of its middle.
  const double size = 4 * upperMedian(spreads);
  const std::string scale = size < range ? "size of the visible scene " + metres(size)
                                         : "median range " + metres(range);
  const double voxel = std::max(2.5 * spacing, std::min(size, range) / 60);
  p.voxel =
      orDerived(options.voxel,
                derivedParameter(std::max(voxel, 1e-6),
                                 "larger of 2.5 x median spacing " + metres(spacing) +
                                     " and " + scale + " / 60"));
  const ScanSampling sampling = medianSampling(std::move(samplings));
  p.line_spacing = orDerived(
      options.line_spacing,
      derivedParameter(sampling.lineSpacing(), sampling.text(), kDigitsOfLines));
  const double of_lines = kVoxelOfLines * p.line_spacing.value;
  if (!options.voxel && of_lines > voxel)
    p.voxel = derivedParameter(of_lines,
                               "1.3 x line-spacing " + metres(p.line_spacing.value));
  const Parameter grid = gateAtGrid(p.voxel.value);
  if (!options.max_range && grid.value < p.max_range.value)
    p.max_range = grid;
  return p;
}

} // namespace pcl6d
