// SPDX-License-Identifier: BSD-3-Clause
#include "report/survey_rows.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <utility>

namespace pcl6d::visualization {

namespace {
using Mark = SurveyCell::Mark;

std::string
fixedText(double value, int digits)
{
  if (!std::isfinite(value))
    return "-";
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

/** Survey terms for the results of a link's tests. */
SurveyCell
assessmentOf(const LinkCheck& check)
{
  switch (check.trust) {
  case LinkTrust::kGood:
    return {"consistent", Mark::kPass};
  case LinkTrust::kWrong:
    return {"inconsistent", Mark::kFail};
  case LinkTrust::kWeak:
  case LinkTrust::kUnverified:
    break;
  }
  return {"inconclusive"};
}

std::string
strengthOf(const LinkCheck& check)
{
  if (check.open_directions == 0)
    return "all fixed";
  return std::to_string(check.open_directions) + " free";
}

std::string
useText(ControlUse use)
{
  switch (use) {
  case ControlUse::kControl:
    return "control";
  case ControlUse::kCheck:
    return "check";
  case ControlUse::kRejected:
    return "rejected (blunder)";
  case ControlUse::kUnused:
    break;
  }
  return "not used (not connected)";
}

SurveyCell
testCell(const ControlResidual& one)
{
  constexpr double kLimit = 3.29; // of the w-test, significance 0.1 %
  const std::string value = fixedText(one.standardised, 1);
  if (one.use == ControlUse::kUnused)
    return {"-"};
  return {value, one.standardised > kLimit ? Mark::kFail : Mark::kPass};
}
} // namespace

std::string
millimetresOf(double metres)
{
  return fixedText(1000 * metres, 1);
}

std::string
stationName(const ScanResult& scan)
{
  return std::filesystem::path(scan.file).stem().string();
}

std::map<int, std::size_t>
placesByIndex(const RunResult& run)
{
  std::map<int, std::size_t> places;
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    places[run.scans[i].index] = i;
  return places;
}

std::optional<double>
boundOfStation(const RunResult& run, std::size_t place)
{
  if (run.control && run.control->adjusted)
    return run.control->bounds.at(place);
  if (!run.verification || run.verification->scans.size() != run.scans.size())
    return {};
  return run.verification->scans[place].bound;
}

SurveyTable
controlTable(const RunResult& run)
{
  SurveyTable table;
  table.name = "control";
  table.title = "Control and check points";
  table.note =
      "Residual: adjusted position of the target minus the control point. Test value: "
      "standardised residual (data snooping, limit 3.29, significance 0.1 %). "
      "Detectable: least error that the test reveals with 80 %.";
  table.columns = {"point",
                   "station",
                   "use",
                   "dX [mm]",
                   "dY [mm]",
                   "dZ [mm]",
                   "3D [mm]",
                   "test value",
                   "detectable [mm]"};
  for (const ControlResidual& one : run.control->residuals)
    table.rows.push_back(
        {{one.name},
         {stationName(run.scans.at(one.scan))},
         {useText(one.use),
          one.use == ControlUse::kRejected ? Mark::kFail : Mark::kPlain},
         {millimetresOf(one.residual.x())},
         {millimetresOf(one.residual.y())},
         {millimetresOf(one.residual.z())},
         {millimetresOf(one.residual.norm())},
         testCell(one),
         {millimetresOf(one.detectable)}});
  return table;
}

SurveyTable
stationTable(const RunResult& run)
{
  SurveyTable table;
  table.name = "stations";
  table.title = "Stations";
  table.note = "Bound: with 95 % the position is known so well, relative to " +
               std::string(run.control && run.control->adjusted
                               ? "the frame of the control points."
                               : "the first station.");
  table.columns = {"station",
                   "X [m]",
                   "Y [m]",
                   "Z [m]",
                   "links",
                   "mean overlap [%]",
                   "bound [mm]",
                   "state"};
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    const ScanResult& scan = run.scans[i];
    std::size_t links = 0;
    double overlap = 0;
    for (const RunLink& link : run.links)
      if (link.verdict == LinkVerdict::kUsed &&
          (static_cast<int>(link.from) == scan.index ||
           static_cast<int>(link.to) == scan.index)) {
        ++links;
        overlap += 100 * link.overlap;
      }
    const auto bound = boundOfStation(run, i);
    const bool is_registered =
        scan.state == ScanState::kFixed || scan.state == ScanState::kMatched;
    const Eigen::Vector3d position = scan.T_world_scan.translation();
    table.rows.push_back(
        {{stationName(scan)},
         {fixedText(position.x(), 4)},
         {fixedText(position.y(), 4)},
         {fixedText(position.z(), 4)},
         {std::to_string(links)},
         {links > 0 ? fixedText(overlap / static_cast<double>(links), 0) : "-"},
         {bound ? millimetresOf(*bound) : "-"},
         {is_registered ? "registered" : toString(scan.state),
          is_registered ? Mark::kPass : Mark::kFail}});
  }
  return table;
}

SurveyTable
linkTable(const RunResult& run, const std::vector<LinkCheck>& checks)
{
  std::map<std::pair<std::size_t, std::size_t>, const LinkCheck*> by_scans;
  for (const LinkCheck& check : checks)
    by_scans[std::minmax(check.from, check.to)] = &check;
  const auto places = placesByIndex(run);
  const auto nameOf = [&](std::size_t index) {
    const auto found = places.find(static_cast<int>(index));
    return found == places.end() ? std::to_string(index)
                                 : stationName(run.scans[found->second]);
  };
  SurveyTable table;
  table.name = "links";
  table.title = "Links";
  table.note =
      "Cloud-to-cloud: rms distance of the point pairs, noise and point spacing "
      "included. Strength: directions that the surfaces in common do not fix. "
      "Detectable: least error of the link that the points would reveal (95 %).";
  table.columns = {"from",
                   "to",
                   "cloud-to-cloud [mm]",
                   "pairs",
                   "overlap [%]",
                   "strength",
                   "std. dev. [mm]",
                   "detectable [mm]",
                   "result"};
  for (const RunLink& link : run.links) {
    if (!link.counts())
      continue;
    const auto found = by_scans.find(std::minmax(link.from, link.to));
    const LinkCheck* check = found == by_scans.end() ? nullptr : found->second;
    table.rows.push_back(
        {{nameOf(link.from)},
         {nameOf(link.to)},
         {link.verdict == LinkVerdict::kOdometry ? "-" : millimetresOf(link.rms)},
         {std::to_string(link.pairs)},
         {fixedText(100 * link.overlap, 0)},
         {check ? strengthOf(*check) : "-"},
         {check ? millimetresOf(check->deviation) : "-"},
         {check && check->noticed ? millimetresOf(check->noticed->most) : "-"},
         check
             ? assessmentOf(*check)
             : SurveyCell{link.verdict == LinkVerdict::kOdometry ? "initial poses only"
                                                                 : "not tested"}});
  }
  return table;
}

} // namespace pcl6d::visualization
