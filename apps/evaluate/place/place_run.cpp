// SPDX-License-Identifier: BSD-3-Clause
#include "common/process/interrupt.h"
#include "evaluate/pair_scan.h"
#include "evaluate/place/place_map.h"
#include "evaluate/place/place_report.h"

#include <pcl6d/global_registration/place_in_map.h>
#include <pcl6d/graph_relaxation/parameterisations.h>
#include <pcl6d/io/text.h>
#include <pcl6d/slam6d/pose_bounds.h>

#include <algorithm>

namespace pcl6d::app {

namespace {
/** Thrown to leave an interrupted search. */
struct SearchStopped {};

/** \return the strongest reason against a pose from its links, else the strongest support */
std::string
trustWordOf(const MapPlace& one)
{
  if (one.links.empty())
    return "too little";
  const auto has = [&](LinkTrust trust) {
    return std::any_of(one.links.begin(), one.links.end(), [&](const auto& link) {
      return link.trust == trust;
    });
  };
  for (const LinkTrust trust :
       {LinkTrust::kWrong, LinkTrust::kGood, LinkTrust::kUnverified})
    if (has(trust))
      return toString(trust);
  return toString(LinkTrust::kWeak);
}

FoundPlace
described(const MapPlace& one, const PlaceMap& map, const NearScan& scan)
{
  FoundPlace place;
  place.pose = Eigen::Translation3d(map.summary().world_offset) * one.T_map_scan *
               Eigen::Translation3d(-scan.offset);
  place.score = one.score;
  place.overlap = one.overlap;
  place.contradiction = one.contradiction;
  place.rejection = one.rejection;
  place.evaluated = trustWordOf(one);
  for (const LinkCheck& link : one.links) {
    const ScanResult& met = map.result(link.from);
    place.links.push_back({met.file, met.index, link});
  }
  return place;
}

/** Fuses the links as measurements of one pose: of the scan in the fixed map. */
std::optional<PlaceExactness>
exactnessOf(const MapPlace& best)
{
  MapVerification links;
  links.scans.resize(2);
  links.scans[0].tied = links.scans[1].tied = true;
  for (LinkCheck link : best.links) {
    link.from = 0;
    link.to = 1;
    links.links.push_back(link);
  }
  boundPoses({Eigen::Isometry3d::Identity(), best.T_map_scan}, links, 1);
  if (!links.scans[1].covariance)
    return {};
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() =
      best.T_map_scan.linear();
  const auto covariance = eulerCovariance(
      best.T_map_scan, turn * *links.scans[1].covariance * turn.transpose());
  if (!covariance.allFinite())
    return {};
  return PlaceExactness{covariance, *links.scans[1].bound};
}

/** Points for the picture: the map turned upright, by the scan with the largest overlap. */
void
takeDrawn(const MapPlaces& found, const PlaceMap& map, PlaceReport& report)
{
  std::size_t upright = 0;
  if (!found.candidates.empty() && !found.candidates.front().links.empty())
    upright = found.candidates.front().links.front().from;
  Eigen::Isometry3d T_drawn_map = Eigen::Isometry3d::Identity();
  T_drawn_map.linear() =
      uprightRotation(map.pose(upright).linear() * map[upright].vertical().up);
  for (std::size_t i = 0; i < map.size(); ++i) {
    const Points points = transformed(
        uprightPoints(map[i].scan(), map[i].vertical().up), T_drawn_map * map.pose(i));
    report.drawn_map.insert(report.drawn_map.end(), points.begin(), points.end());
  }
  report.drawn_scan = uprightPoints(map.scan().scan(), map.scan().vertical().up);
  for (std::size_t k = 0; k < report.places.size(); ++k)
    report.places[k].T_drawn_scan = T_drawn_map * found.candidates[k].T_map_scan;
}

/** Further notes for the report. */
void
takeNotes(const PlaceSettings& s, const PlaceMap& map, PlaceReport& report)
{
  const std::size_t known = map.size() + (map.sameAs().empty() ? 0 : 1);
  if (known < map.summary().scans.size())
    report.notes.push_back(s.scan_b + ": " +
                           text::counted(map.summary().scans.size() - known, "scan") +
                           " without a reliable pose in the run left out");
  if (!map.sameAs().empty())
    report.notes.push_back(
        s.scan_a + ": is " + map.sameAs() + " of " + s.scan_b +
        " with identical points; the search uses the remaining scans");
  report.same_as = map.sameAs();
}

PlaceReport
reportOf(const PlaceSettings& s,
         const PlaceMap& map,
         const NearScan& scan,
         const MapPlaces& found)
{
  PlaceReport report;
  report.of_what = "in the world of " + s.scan_b;
  report.answer = found.answer;
  report.rejection = found.rejection;
  report.ambiguity = found.ambiguity();
  report.voxel = map.voxel();
  report.compared = found.pairs_compared;
  report.placed = found.pairs_placed;
  for (const MapPlace& one : found.candidates)
    report.places.push_back(described(one, map, scan));
  if (found.answer == PlaceAnswer::kUnique)
    report.exactness = exactnessOf(found.candidates.front());
  takeDrawn(found, map, report);
  takeNotes(s, map, report);
  return report;
}
} // namespace

std::optional<PlaceReport>
placeInRun(const PlaceSettings& s, ProgressBar& bar)
{
  const Interrupt interrupt;
  const auto show = [&](const Progress& now) {
    bar.show(now);
    if (interrupt.requested())
      throw SearchStopped();
  };
  try {
    const NearScan scan = readNear(s.scan_a, s.format, bar);
    const PlaceMap map(s, scan, show);
    std::vector<KnownScan> known;
    for (std::size_t i = 0; i < map.size(); ++i)
      known.push_back({&map[i], map.pose(i)});
    MapPlaceOptions options;
    options.candidates = s.search.candidates;
    options.max_ambiguity = s.search.max_ambiguity;
    options.num_threads = s.search.num_threads;
    options.progress = show;
    return reportOf(s, map, scan, placeInMap(map.scan(), known, options));
  } catch (const SearchStopped&) {
    return {};
  }
}

} // namespace pcl6d::app
