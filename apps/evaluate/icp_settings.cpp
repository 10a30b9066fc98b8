// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "evaluate/icp_command_line.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/registration/minimisers.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pcl6d::app {

namespace {
using Words = std::vector<std::string>;
using Raw = RawIcpSettings;

constexpr int kMostThreads = 1024;
/** \return the names, "all" replaced by those that are not there yet; each once */
Words
expanded(const Words& given, const Words& all)
{
  Words names;
  const auto add = [&names](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  };
  for (const std::string& name : given)
    if (name == "all")
      std::for_each(all.begin(), all.end(), add);
    else
      add(name);
  return names;
}

template <typename Value>
std::vector<Value>
valuesOf(const Words& names, Value (*fromName)(const std::string&))
{
  std::vector<Value> values;
  std::transform(names.begin(), names.end(), std::back_inserter(values), fromName);
  return values;
}

Eigen::Isometry3d
poseFromText(const std::string& text)
{
  std::istringstream stream(text);
  double v[6];
  for (double& value : v)
    if (!(stream >> value) || !std::isfinite(value))
      throw UsageError(
          "--guess \"" + text +
          "\": expected six finite numbers, x y z [m] roll pitch yaw [deg]");
  if (!(stream >> std::ws).eof())
    throw UsageError("--guess \"" + text + "\": more than six numbers");
  return poseFromEuler({v[0], v[1], v[2]},
                       {radians(v[3]), radians(v[4]), radians(v[5])});
}

std::optional<double>
toOptional(const AutoDouble& value, double unit = 1)
{
  return value.is_auto ? std::nullopt : std::optional<double>(unit * value.value);
}

void
interpretMethods(const Raw& raw, IcpSettings& s)
{
  s.methods.metrics = valuesOf(expanded(raw.metrics, metricNames()), metricFromName);
  s.methods.minimisers = expanded(raw.minimisers, minimiserNames());
  s.methods.plane_minimisers = expanded(raw.plane_minimisers, planeMinimiserNames());
  s.methods.searches =
      valuesOf(expanded(raw.searches, searchMethodNames()), searchMethodFromName);
  s.combination =
      raw.all_combinations ? IcpCombination::kAll : IcpCombination::kOneByOne;
  for (const auto& name : s.methods.minimisers) // also those that no metric uses
    minimiserFromName(name);
  for (const auto& name : s.methods.plane_minimisers)
    planeMinimiserFromName(name);
}

/** Checked in degrees, so that errors speak of what was typed. */
void
interpretAngles(const Raw& raw, IcpSettings& s)
{
  const AutoDouble& offset = raw.offset_yaw;
  require(offset.is_auto || (offset.value > 0 && offset.value <= 180),
          "offset_yaw",
          offset.value,
          "in (0, 180] degrees");
  const AutoDouble& sigma = raw.sigma_orientation;
  require(sigma.is_auto || (std::isfinite(sigma.value) && sigma.value > 0),
          "sigma_orientation",
          sigma.value,
          "finite and > 0 degrees");
  s.offset_yaw = toOptional(offset, kDegree);
  s.basin.sigma_orientation = toOptional(sigma, kDegree);
}

void
interpret(const CommandLine& line, const Raw& raw, IcpSettings& s)
{
  if (line.given("guess"))
    s.guess = poseFromText(raw.guess);
  s.slam.min_range = toOptional(raw.min_range);
  s.slam.max_range = toOptional(raw.max_range);
  s.slam.voxel = toOptional(raw.voxel);
  s.slam.max_distance = toOptional(raw.max_distance);
  s.slam.max_distance_start = toOptional(raw.max_distance_start);
  s.offset_xy = toOptional(raw.offset_xy);
  s.basin.offset_xy = s.offset_xy.value_or(s.basin.offset_xy);
  s.basin.sigma_position = toOptional(raw.sigma_position);
  s.basin.num_threads = static_cast<unsigned int>(raw.threads);
  checkOptions(
      [&] {
        require(raw.threads >= 0 && raw.threads <= kMostThreads,
                "threads",
                raw.threads,
                "in [0, " + std::to_string(kMostThreads) + "]");
        s.format = scanFormatFromName(raw.format);
        s.basin.icp.robust = robustKernelFromName(raw.robust);
        interpretMethods(raw, s);
        interpretAngles(raw, s);
        s.slam.validate();
        s.basin.validate();
      },
      {{"max_iterations", "iterations"}});
}

std::string
withoutEffect(const CommandLine& line, const IcpSettings& s)
{
  const auto& metrics = s.methods.metrics;
  const auto points = std::count(metrics.begin(), metrics.end(), Metric::kPoint);
  const bool planes = points < static_cast<std::ptrdiff_t>(metrics.size());
  return line.withoutEffect(
      {{"minimiser", points > 0, "of the metric point"},
       {"plane-minimiser", planes, "of the metrics plane and gicp"},
       {"offset-xy", s.basin.steps_xy > 1, "with --steps-xy 3 or more"},
       {"offset-yaw", s.basin.steps_yaw > 1, "with --steps-yaw 3 or more"},
       {"force", !s.out.empty(), "with --output"}});
}
} // namespace

bool
parseIcpSettings(const std::vector<std::string>& arguments, IcpSettings& settings)
{
  CommandLine line(icpUsage());
  Raw raw;
  line.positional("SCAN_A", &settings.scan_a);
  line.positional("SCAN_B", &settings.scan_b);
  describeIcp(line, settings, raw);
  if (!line.parse(arguments))
    return false;
  interpret(line, raw, settings);
  settings.without_effect = withoutEffect(line, settings);
  return true;
}

} // namespace pcl6d::app
