// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/median.h>
#include <pcl6d/common/require.h>
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
double
rounded(double value, int digits)
{
  if (!(value > 0) || !std::isnormal(value))
    return value;
  std::ostringstream text; // so 0.17 is the 0.17 that a user types, on every CPU
  text << std::setprecision(digits) << value;
  return std::stod(text.str());
}

/** \return the largest number of two digits that is no larger, for a value > 0 */
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

/** A no-return code is no surface: the gate ends just below it. Infinite without one. */
Parameter
gateBelowCode(const std::vector<Points>& scans)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& scan : scans)
    if (const auto code = noReturnRange(scan))
      smallest = std::min(smallest, *code);
  return {rounded(0.999 * smallest, 4), false, "no-return code at " + metres(smallest)};
}

/** Voxels of this many line spacings hold points of two lines wherever the surface faces the
 * scanner, at up to 1.4 times the median range (algorithms.md S.2, rule C: 1.4 and more lose
 * detail of narrow corridors, below 1 registration of rooms fails). */
constexpr double kVoxelOfLines = 1.3;

/** A voxel of two digits follows from it. */
constexpr int kDigitsOfLines = 3;

/** \return the sampling whose line spacing is the (upper) median of all */
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

/** One wild return must not end the run: a point beyond could not be numbered. The
 * grid of the metascan, half as wide, reaches 2^19 voxels; half of these are left for
 * the way from its origin to the scan. */
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
ScanParameterOptions::validate() const
{
  validateRangeLimits(min_range.value_or(0),
                      max_range.value_or(std::numeric_limits<double>::infinity()));
  require(!voxel || (*voxel > 0 && std::isfinite(*voxel)),
          "voxel",
          voxel.value_or(0),
          "finite and > 0");
  require(!line_spacing || (*line_spacing >= 0 && std::isfinite(*line_spacing)),
          "line_spacing",
          line_spacing.value_or(0),
          "finite and >= 0");
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
  // Fine enough to keep a surface's shape at the typical range, coarse enough that most
  // voxels average several points. What is small beside its range, such as an object on a
  // turntable, keeps its own shape: half of its points are within a spread of its middle.
  const double size = 4 * upperMedian(spreads);
  const std::string scale = size < range ? "size of what is seen " + metres(size)
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
