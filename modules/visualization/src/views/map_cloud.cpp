// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/visualization/map_cloud.h>

#include <algorithm>

namespace pcl6d {

namespace {
/** \return the place of a name in a list of words with commas between */
std::size_t
placeOf(const char* what,
        const std::string& name,
        const std::vector<std::string>& names)
{
  const auto found = std::find(names.begin(), names.end(), name);
  std::string all;
  for (const auto& each : names)
    all += (all.empty() ? "" : ", ") + each;
  require(found != names.end(), what, name, "one of " + all);
  return static_cast<std::size_t>(found - names.begin());
}

void
requireOnePerPoint(std::size_t count, std::size_t points, bool needed, const char* what)
{
  if ((needed || count > 0) && count != points)
    throw BadArgument(std::to_string(count) + " " + what + " for " +
                      std::to_string(points) + " points");
}
} // namespace

PointColour
pointColourFromName(const std::string& name)
{
  return static_cast<PointColour>(placeOf(
      "colour", name, {"height", "scan", "reflectance", "residual", "label", "plain"}));
}

ColourMap
colourMapFromName(const std::string& name)
{
  return static_cast<ColourMap>(
      placeOf("colour_map", name, {"viridis", "turbo", "magma", "grey"}));
}

Background
backgroundFromName(const std::string& name)
{
  return static_cast<Background>(placeOf("background", name, {"dark", "light"}));
}

void
MapCloud::validate(PointColour colour) const
{
  const std::size_t count = points.size();
  requireOnePerPoint(scans.size(), count, colour == PointColour::kScan, "scan indices");
  requireOnePerPoint(
      reflectances.size(), count, colour == PointColour::kReflectance, "reflectances");
  requireOnePerPoint(
      residuals.size(), count, colour == PointColour::kResidual, "residuals");
  requireOnePerPoint(labels.size(), count, colour == PointColour::kLabel, "labels");
  for (const auto label : labels)
    require(label < label_names.size(), "label", label, "one that has a name");
}

} // namespace pcl6d
