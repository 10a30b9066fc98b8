// SPDX-License-Identifier: BSD-3-Clause
#include "semantic_map/finished_run.h"

#include <pcl6d/common/error.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pcl6d::app {

FinishedRun::FinishedRun(const std::filesystem::path& folder)
: run_(RunFolder::finished(folder, "the run was interrupted; start the run again"))
{
  std::vector<std::pair<MapScan, std::size_t>> scans;
  for (const ScanResult& scan : run_.summary().scans) {
    if (scan.index < 0)
      throw IoFailed((folder / "summary.json").string() + ": " + scan.file +
                     ": index = " + std::to_string(scan.index) + ", but must be >= 0");
    scans.push_back({{static_cast<std::size_t>(scan.index),
                      scan.file,
                      scan.T_world_scan,
                      scan.covariance},
                     scans.size()});
  }
  std::sort(scans.begin(), scans.end(), [](const auto& a, const auto& b) {
    return a.first.id < b.first.id;
  });
  for (auto& [scan, place] : scans) {
    scans_.push_back(std::move(scan));
    places_.push_back(place);
  }
}

std::vector<MapLink>
FinishedRun::readLinks() const
{
  if (!run_.has("links.csv"))
    return {};
  std::map<std::pair<std::size_t, std::size_t>, Eigen::Matrix<double, 6, 6>> known;
  const PoseGraph graph = run_.readGraph();
  const auto id = [&](std::size_t vertex) {
    return graph.ids.empty() ? vertex : graph.ids[vertex];
  };
  for (const PoseLink& link : graph.links)
    known[{id(link.from), id(link.to)}] = link.information;
  std::vector<MapLink> links;
  for (const RunLink& link :
       run_.readLinks([this](const RunLink& row) { return faultOf(row); })) {
    if (!link.counts())
      continue;
    MapLink& kept = links.emplace_back();
    kept.from = link.from;
    kept.to = link.to;
    kept.kind = toString(link.kind);
    kept.pairs = link.pairs;
    if (!std::isnan(link.rms)) // NaN for links without pairs
      kept.rms = link.rms;
    const auto found = known.find({link.from, link.to});
    if (found != known.end())
      kept.information = found->second;
  }
  return links;
}

/** \return the fault of a link in use, or an empty text */
std::string
FinishedRun::faultOf(const RunLink& link) const
{
  if (!link.counts())
    return {};
  for (const auto id : {link.from, link.to})
    if (std::none_of(scans_.begin(), scans_.end(), [&](const MapScan& scan) {
          return scan.id == id;
        }))
      return "the run has no scan " + std::to_string(id);
  if (link.rms < 0)
    return "rms = " + std::to_string(link.rms) + ", but must be a number >= 0";
  return {};
}

Scan
FinishedRun::readMap() const
{
  return pcl6d::readScan(run_.mapFile());
}

Scan
FinishedRun::readScan(std::size_t place) const
{
  run_.requireScan(places_[place]);
  return run_.readStandingScan(places_[place]);
}

} // namespace pcl6d::app
