// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/require.h>
#include <pcl6d/visualization/map_cloud.h>

#include <algorithm>

namespace pcl6d {

namespace {
constexpr Named<PointColour> kPointColours[] = {
    {PointColour::kHeight, "height"},
    {PointColour::kScan, "scan"},
    {PointColour::kReflectance, "reflectance"},
    {PointColour::kResidual, "residual"},
    {PointColour::kLabel, "label"},
    {PointColour::kPlain, "plain"}};
constexpr Named<ColourMap> kColourMaps[] = {{ColourMap::kViridis, "viridis"},
                                            {ColourMap::kTurbo, "turbo"},
                                            {ColourMap::kMagma, "magma"},
                                            {ColourMap::kGrey, "grey"}};
constexpr Named<Background> kBackgrounds[] = {{Background::kDark, "dark"},
                                              {Background::kLight, "light"}};

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
  return fromName(kPointColours, "colour", name, WordList::kOneOf);
}

ColourMap
colourMapFromName(const std::string& name)
{
  return fromName(kColourMaps, "colour_map", name, WordList::kOneOf);
}

Background
backgroundFromName(const std::string& name)
{
  return fromName(kBackgrounds, "background", name, WordList::kOneOf);
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
    require(label < label_names.size(), "label", label, "a label with a name");
}

} // namespace pcl6d
