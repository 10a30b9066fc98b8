// SPDX-License-Identifier: BSD-3-Clause
#include "render/map_residuals.h"
#include "render/run_pictures.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/random.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::app {

/** A view, and its drawing function. */
struct RunPictures::View {
  const char* name;
  const char* purpose;
  /** files of the run needed for the view; "a|b" needs one of two */
  std::vector<std::string> needs;
  Image (RunPictures::*draw)();
};

const std::vector<RunPictures::View>&
RunPictures::views()
{
  using R = RunPictures;
  static const std::vector<View> kViews = {
      {"top", "map and paths from above", {}, &R::drawTop},
      {"perspective",
       "map from where most is seen",
       {"map.pcd|scans"},
       &R::drawPerspective},
      {"before-after", "first and final poses", {"map.pcd|scans"}, &R::drawBeforeAfter},
      {"graph", "scans and their links", {"links.csv"}, &R::drawGraph},
      {"covariance",
       "how sure the positions are",
       {"summary.json"},
       &R::drawCovariance},
      {"slice",
       "a horizontal layer, like a floor plan",
       {"map.pcd|scans"},
       &R::drawSlice},
      {"panorama", "all around one scan", {"scans"}, &R::drawPanorama},
      {"convergence",
       "the way of a scan to the final pose",
       {"frames", "scans"},
       &R::drawConvergence},
      {"planes", "planes with hulls and labels", {"planes.json"}, &R::drawPlanes},
      {"objects",
       "objects with boxes and models",
       {"objects.json|semantic_map.json"},
       &R::drawObjects},
  };
  return kViews;
}

const RunPictures::View&
RunPictures::viewOf(const std::string& name)
{
  const auto& all = views();
  return *std::find_if(
      all.begin(), all.end(), [&](const View& view) { return view.name == name; });
}

bool
RunPictures::isView(const std::string& name)
{
  const auto& all = views();
  return std::any_of(
      all.begin(), all.end(), [&](const View& view) { return view.name == name; });
}

std::string
RunPictures::viewNames()
{
  std::string names;
  for (const View& view : views())
    names += (names.empty() ? "" : ", ") + std::string(view.name);
  return names;
}

std::string
RunPictures::viewTable()
{
  std::string table;
  for (const View& view : views())
    table += "\n  " + std::string(view.name) + ": " + view.purpose;
  return table;
}

RunPictures::RunPictures(const RunFolder& run, const PictureSettings& settings)
: run_(run), settings_(settings)
{
  const auto& scans = run.summary().scans;
  for (std::size_t i = 0; i < scans.size(); ++i)
    places_[scans[i].index] = i;
}

std::string
RunPictures::lackedBy(const std::string& view) const
{
  for (const std::string& needed : viewOf(view).needs) {
    const auto bar = needed.find('|');
    const std::string first = needed.substr(0, bar);
    if (!run_.has(first) &&
        (bar == std::string::npos || !run_.has(needed.substr(bar + 1))))
      return first;
  }
  return "";
}

std::vector<std::string>
RunPictures::suitableViews() const
{
  std::vector<std::string> suitable;
  for (const View& view : views())
    if (lackedBy(view.name).empty())
      suitable.emplace_back(view.name);
  return suitable;
}

Image
RunPictures::draw(const std::string& view)
{
  if (const std::string lacked = lackedBy(view); !lacked.empty())
    throw IoFailed(run_.path().string() + ": cannot draw the view " + view + ": " +
                   lacked + " is missing");
  return (this->*viewOf(view).draw)();
}

/** map.pcd; if missing, the scans at their poses. */
const RunMap&
RunPictures::map()
{
  if (map_)
    return *map_;
  map_ = run_.readMap();
  if (run_.has("map.pcd"))
    return *map_;
  const auto poses = run_.trajectory().poses;
  const double share = static_cast<double>(settings_.points) /
                       static_cast<double>(std::max<std::size_t>(poses.size(), 1));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const RunMap scan = run_.readScanCloud(i);
    const double kept =
        share / static_cast<double>(std::max<std::size_t>(scan.points.size(), 1));
    const Points points = transformed(scan.points, poses[i]);
    for (std::size_t k = 0; k < points.size(); ++k)
      if (kept >= 1 || static_cast<double>(mixBits(k)) < std::ldexp(kept, 64)) {
        map_->points.push_back(points[k]);
        map_->scans.push_back(scan.scans[k]);
        if (!scan.intensities.empty())
          map_->intensities.push_back(scan.intensities[k]);
      }
  }
  if (map_->intensities.size() != map_->points.size())
    map_->intensities.clear();
  return *map_;
}

MapCloud
RunPictures::cloudFor(PointColour colour)
{
  const auto refuse = [&](const std::string& reason) {
    throw IoFailed(run_.path().string() + ": " + reason);
  };
  if (colour == PointColour::kLabel)
    return labelledCloud();
  const RunMap& all = map();
  if (colour == PointColour::kReflectance && all.intensities.empty())
    refuse("colour reflectance, but the scans have no intensity");
  MapCloud cloud;
  cloud.points = all.points;
  cloud.scans = all.scans;
  cloud.reflectances = all.intensities;
  if (colour == PointColour::kResidual) {
    if (!run_.has("scans") || all.scans.empty())
      refuse("colour residual needs scans/ and map.pcd with scan indices");
    cloud.residuals = mapResiduals(run_, all);
  }
  return cloud;
}

std::string
RunPictures::title(const std::string& of) const
{
  if (!settings_.title.empty())
    return settings_.title;
  std::error_code error;
  const auto whole = std::filesystem::canonical(run_.path(), error);
  const std::size_t scans = run_.summary().scans.size();
  std::string text = whole.filename().string() + ", " + std::to_string(scans) +
                     (scans == 1 ? " scan" : " scans");
  if (!of.empty())
    text += ": " + of;
  if (!run_.summary().complete)
    text += " (incomplete)";
  else if (!run_.summary().trusted)
    text += " (not to be trusted)";
  return text;
}

std::size_t
RunPictures::placeOf(int scan) const
{
  const auto found = places_.find(scan);
  if (found == places_.end())
    throw IoFailed(run_.path().string() + ": the run has no scan " +
                   std::to_string(scan));
  return found->second;
}

std::size_t
RunPictures::mostCorrected() const
{
  const auto& scans = run_.summary().scans;
  std::size_t most = 0;
  for (std::size_t i = 1; i < scans.size(); ++i)
    if (scans[i].correction > scans[most].correction)
      most = i;
  return most;
}

} // namespace pcl6d::app
