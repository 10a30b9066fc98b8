// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/colours.h"
#include "drawing/point_paint.h"
#include "drawing/point_spread.h"
#include "drawing/theme.h"

#include <pcl6d/io/label_colours.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace pcl6d::visualization {

namespace {
float
valueOf(const MapCloud& cloud, std::size_t i, PointColour colour)
{
  switch (colour) {
  case PointColour::kScan:
    return static_cast<float>(cloud.scans[i]);
  case PointColour::kReflectance:
    return cloud.reflectances[i];
  case PointColour::kResidual:
    return cloud.residuals[i];
  default:
    return cloud.points[i].z();
  }
}

ColourMap
mapFor(const PaintRule& rule)
{
  if (rule.map)
    return *rule.map;
  switch (rule.colour) {
  case PointColour::kScan:
    return ColourMap::kTurbo;
  case PointColour::kReflectance:
    return ColourMap::kGrey;
  case PointColour::kResidual:
    return ColourMap::kMagma;
  default:
    return ColourMap::kViridis;
  }
}

void
setRange(std::vector<float> values, PointColour colour, ColourScale& scale)
{
  values.erase(std::remove_if(values.begin(),
                              values.end(),
                              [](float value) { return !std::isfinite(value); }),
               values.end());
  if (values.empty())
    return;
  if (colour == PointColour::kScan) {
    const auto ends = std::minmax_element(values.begin(), values.end());
    scale.lowest = *ends.first;
    scale.highest = *ends.second;
    return;
  }
  const bool residual = colour == PointColour::kResidual;
  scale.lowest = residual ? 0 : quantile(values, 0.02);
  scale.highest = quantile(std::move(values), residual ? 0.95 : 0.98);
}

ColourScale
scaleFor(const PaintRule& rule)
{
  ColourScale scale;
  switch (rule.colour) {
  case PointColour::kHeight:
    scale.title = "height [m]";
    break;
  case PointColour::kScan:
    scale.title = "scan";
    break;
  case PointColour::kReflectance:
    scale.title = "reflectance";
    break;
  case PointColour::kResidual:
    scale.title = "residual [m]";
    break;
  default:
    return scale;
  }
  scale.is_integer = rule.colour == PointColour::kScan;
  // Low values are near the colour of the background, to make walls stand out.
  const bool turned =
      rule.background == Background::kLight && rule.colour != PointColour::kScan;
  scale.colourOf = [map = mapFor(rule), turned](double share) {
    return mapColour(map, turned ? 1 - share : share);
  };
  return scale;
}

PointPaint
paintLabels(const MapCloud& cloud, const std::vector<std::size_t>& indices)
{
  std::vector<Colour> colours;
  for (const auto& name : cloud.label_names)
    colours.push_back(labelColour(name));
  PointPaint paint;
  std::set<std::uint32_t> seen;
  for (const auto i : indices) {
    paint.colours.push_back(colours[cloud.labels[i]]);
    seen.insert(cloud.labels[i]);
  }
  for (const auto label : seen)
    paint.scale.keys.emplace_back(cloud.label_names[label], colours[label]);
  return paint;
}
} // namespace

PointPaint
paintPoints(const MapCloud& cloud,
            const std::vector<std::size_t>& indices,
            const PaintRule& rule)
{
  cloud.validate(rule.colour);
  if (rule.colour == PointColour::kLabel)
    return paintLabels(cloud, indices);
  const Colour plain = themeOf(rule.background).plain;
  PointPaint paint;
  paint.scale = scaleFor(rule);
  if (rule.colour == PointColour::kPlain) {
    paint.colours.assign(indices.size(), plain);
    return paint;
  }
  std::vector<float> values;
  values.reserve(indices.size());
  for (const auto i : indices)
    values.push_back(valueOf(cloud, i, rule.colour));
  if (rule.range) {
    paint.scale.lowest = rule.range->front();
    paint.scale.highest = rule.range->back();
  }
  else {
    setRange(values, rule.colour, paint.scale);
  }
  const double lowest = paint.scale.lowest;
  const double range = std::max(paint.scale.highest - lowest, 1e-9);
  constexpr int kSteps = 1024; // more than the eye tells apart
  std::vector<Colour> table;
  for (int i = 0; i <= kSteps; ++i)
    table.push_back(paint.scale.colourOf(static_cast<double>(i) / kSteps));
  paint.colours.reserve(indices.size());
  for (const float value : values) {
    const double share = std::clamp((value - lowest) / range, 0.0, 1.0);
    paint.colours.push_back(
        std::isfinite(value) ? table[static_cast<std::size_t>(share * kSteps)] : plain);
  }
  return paint;
}

} // namespace pcl6d::visualization
