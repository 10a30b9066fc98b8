// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/median.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/control_table.h>
#include <pcl6d/run/run_writer.h>
#include <pcl6d/run/verification_io.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

namespace pcl6d {

namespace {
/** \return ": a.pcd, b.pcd and 3 more" */
std::string
listed(const std::vector<std::string>& files)
{
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(files.size(), kMost); ++i)
    text += (i == 0 ? ": " : ", ") + files[i];
  return files.size() > kMost
             ? text + " and " + std::to_string(files.size() - kMost) + " more"
             : text;
}

std::string
filesIn(ScanState state, const RunResult& run)
{
  std::vector<std::string> files;
  for (const auto& scan : run.scans)
    if (scan.state == state)
      files.push_back(scan.file);
  return listed(files);
}

/** Scans without a match, and scans without links to the first scan. */
void
describeLoose(const RunResult& run, std::ostream& text)
{
  const bool is_global =
      std::any_of(run.scans.begin(), run.scans.end(), [](const ScanResult& scan) {
        return scan.start == InitialGuess::kGlobal;
      });
  if (const auto failed = countScans(run.scans, ScanState::kPredicted))
    text << "\nNOT TO BE TRUSTED: " << text::counted(failed, "scan")
         << (is_global ? " without a clear place (fits nowhere, or in several; only "
                         "upright scans are compared), beside the map"
                       : " could not be matched, predicted pose kept")
         << filesIn(ScanState::kPredicted, run);
  if (run.floating.empty())
    return;
  const std::string count = text::counted(run.floating.size(), "scan");
  if (is_global)
    text << "\nNOT TO BE TRUSTED: " << count
         << " not joined to the others (another site, or too little in common), beside "
            "them"
         << listed(run.floating);
  else if (std::any_of(run.scans.begin(), run.scans.end(), [&](const auto& scan) {
             return scan.recovered == RecoveredBy::kBeside;
           }))
    text << "\nNOT TO BE TRUSTED: " << count
         << " beside the map: matched with each other only, placed by the given poses"
         << listed(run.floating);
  else
    text << "\nNOT TO BE TRUSTED: no link joins " << count
         << " to the first one: " << run.floating.front()
         << (run.floating.size() > 1 ? ", ..." : "");
}

/** Matches that did not come to rest, and matches that took a motion from the given poses. */
void
describeUnconverged(const RunResult& run, std::ostream& text)
{
  std::vector<std::string> held, unconverged;
  for (const auto& scan : run.scans)
    if (scan.state == ScanState::kUnconverged)
      (scan.status == Status::kRankDeficient ? held : unconverged).push_back(scan.file);
  const bool is_confirmed =
      run.verification && run.verification->trust == MapTrust::kGood;
  if (!unconverged.empty())
    text << (is_confirmed ? "\nnote: " : "\nNOT TO BE TRUSTED: ")
         << text::counted(unconverged.size(), "scan")
         << (is_confirmed ? " did not converge, but points and rays confirm the poses"
                          : " did not converge (bad initial pose, little overlap, "
                            "--metascan too small?)")
         << listed(unconverged);
  if (!held.empty())
    text << "\nNOT TO BE TRUSTED: " << text::counted(held.size(), "scan")
         << " placed by the given poses along a direction that surfaces leave open (a "
            "corridor or tunnel without features?)"
         << listed(held);
}

/** Scans that were lost and recovered, and how. */
void
describeRecovered(const RunResult& run, std::ostream& text)
{
  const std::pair<RecoveredBy, const char*> ways[] = {
      {RecoveredBy::kMotion, "by carrying the motion before on"},
      {RecoveredBy::kSearch, "by a search around the predicted pose"},
      {RecoveredBy::kEverywhere, "without a guess"},
      {RecoveredBy::kTogether, "in one piece with the scans before and after"}};
  for (const auto& [way, words] : ways) {
    std::vector<std::string> files;
    for (const auto& scan : run.scans)
      if (scan.recovered == way)
        files.push_back(scan.file);
    if (!files.empty())
      text << "\nlost where the odometry led, and found again " << words
           << listed(files);
  }
}

/** The worst numbers of the matched scans, to show a bad match without --verbose. */
void
describeQuality(const RunResult& run, std::ostream& text)
{
  std::vector<const ScanResult*> matched;
  for (const auto& scan : run.scans)
    if (scan.state == ScanState::kMatched)
      matched.push_back(&scan);
  if (matched.empty())
    return;
  const auto largest = [&](double ScanResult::*member, double sign) {
    return *std::max_element(
        matched.begin(), matched.end(), [&](const ScanResult* a, const ScanResult* b) {
          return sign * a->*member < sign * b->*member;
        });
  };
  const ScanResult* overlap = largest(&ScanResult::overlap, -1);
  const ScanResult* correction = largest(&ScanResult::correction, 1);
  const ScanResult* rms = largest(&ScanResult::rms, 1);
  text << std::fixed << std::setprecision(2) << "\nleast overlap " << overlap->overlap
       << " (" << overlap->file << "), largest correction " << correction->correction
       << " m (" << correction->file << "), largest rms " << std::setprecision(3)
       << rms->rms << " m (" << rms->file << ")";
}

/** A line on each stage after matching. */
void
describeStages(const RunResult& run, std::ostream& text)
{
  text << std::fixed << std::setprecision(3);
  for (const auto& stage : run.graph_stages) {
    if (stage.kind == StageKind::kMatching || stage.kind == StageKind::kLinks ||
        stage.kind == StageKind::kControl) // their agreement is not measured
      continue;
    text << '\n' << toString(stage.kind) << (stage.reverted ? " reverted: " : ": ");
    if (stage.reverted)
      text << toWords(stage.rejection);
    else
      text << "agreement " << stage.agreement_before << " to " << stage.agreement_after;
    if (stage.rounds > 0)
      text << " (" << stage.rounds << (stage.rounds == 1 ? " round" : " rounds") << ")";
  }
}

/** A line on the motion of the scanner within scans. */
void
describeMotion(const RunResult& run, std::ostream& text)
{
  std::vector<double> ways, turns, times;
  std::map<std::string, std::size_t> reasons; // why a scan was not deskewed
  for (const ScanResult& scan : run.scans)
    if (scan.motion && scan.motion->deskewed) {
      ways.push_back(scan.motion->translation);
      turns.push_back(scan.motion->rotation);
      times.push_back(scan.motion->seconds);
    }
    else if (scan.motion)
      ++reasons[toWords(scan.motion->rejection)];
  std::size_t left = 0;
  std::string words;
  for (const auto& [reason, count] : reasons) {
    left += count;
    words += (words.empty() ? " (" : "; ") + reason + ": " + std::to_string(count);
  }
  if (ways.size() + left == 0)
    return;
  constexpr double kDegrees = 180 / M_PI;
  text << "\nmotion within scans: deskewed " << ways.size() << " of "
       << text::counted(ways.size() + left, "scan");
  if (!ways.empty())
    text << std::fixed << std::setprecision(3) << ", about " << upperMedian(ways)
         << " m and " << std::setprecision(2) << kDegrees * upperMedian(turns)
         << " deg in " << upperMedian(times) << " s, at most " << std::setprecision(3)
         << *std::max_element(ways.begin(), ways.end()) << " m and "
         << std::setprecision(2)
         << kDegrees * *std::max_element(turns.begin(), turns.end()) << " deg";
  if (left > 0)
    text << "; left as they were: " << left << words << ')';
}

/** The result of the verification, with reasons. */
void
describeVerification(const RunResult& run, std::ostream& text)
{
  if (!run.verification)
    return;
  const MapVerification& map = *run.verification;
  if (map.trust == MapTrust::kGood)
    text << "\nverified by points and rays: " << map.count(LinkTrust::kGood) << " of "
         << text::counted(map.links.size(), "link") << " confirm the map";
  for (const std::string& doubt : wordsOfEach(map.doubts))
    text << (map.trust == MapTrust::kGood ? "\nnote: "
             : map.trusted()              ? "\nunverified: "
                                          : "\nNOT TO BE TRUSTED: ")
         << doubt;
  if (map.scans.size() != run.scans.size()) // if not every scan was verified
    return;
  std::vector<std::string> files;
  for (const ScanResult& scan : run.scans)
    files.push_back(scan.file);
  const std::string exactness = exactnessOf(map, files);
  text << (exactness.empty() ? "" : "\n") << exactness;
}

/** Dynamic points, and their output files. */
void
describeMoving(const RunResult& run, std::ostream& text)
{
  if (!run.moving || run.scans.size() < 2)
    return;
  const MovingResult& moving = *run.moving;
  text << std::fixed << std::setprecision(1);
  if (moving.blind) {
    text << "\nwhat moved is not known: rays contradict " << 100 * moving.background
         << " % of the points even where scans fit best; scans are left as they are";
    return;
  }
  std::size_t all = 0;
  for (const ScanResult& scan : run.scans)
    all += scan.points;
  const std::size_t total = moving.total();
  if (total == 0)
    text << "\nnothing moved";
  else
    text << '\n'
         << text::counted(total, "point") << " moved ("
         << std::setprecision(total * 100 < all ? 2 : 1)
         << 100 * static_cast<double>(total) / static_cast<double>(all) << " %), in "
         << text::counted(static_cast<std::size_t>(std::count_if(
                              moving.points.begin(),
                              moving.points.end(),
                              [](std::size_t points) { return points > 0; })),
                          "scan")
         << ": "
         << (moving.removed ? "left out of scans and map"
                            : "field dynamic in scans/, not in the map");
  text << std::setprecision(0) << " (" << 100 * moving.unknown
       << " % of the places were seen by no other scan)";
}

/** The sweeps with keyframes that are the scans of the map. */
void
describeDrive(const RunResult& run, std::ostream& text)
{
  if (!run.drive)
    return;
  const DriveResult& drive = *run.drive;
  text << std::fixed << std::setprecision(1) << "\nthe scans are the keyframes of "
       << text::counted(drive.files.size(), "sweep") << " along " << drive.way << " m";
  if (drive.seconds > 0)
    text << " in " << drive.seconds << " s (" << drive.way / drive.seconds << " m/s, "
         << static_cast<double>(drive.files.size() - 1) / drive.seconds
         << " sweeps a second)";
  if (drive.lost.empty())
    return;
  std::vector<std::string> files;
  for (const int lost : drive.lost)
    files.push_back(drive.files.at(drive.placeOf(lost)));
  text << "\nNOT TO BE TRUSTED: " << text::counted(drive.lost.size(), "sweep")
       << " could not be matched, and their poses are predictions" << listed(files);
}
} // namespace

std::string
verdictOf(const RunResult& run)
{
  const std::string all = text::counted(run.scans.size(), "scan");
  const std::size_t pending = countScans(run.scans, ScanState::kPending);
  std::ostringstream text;
  if (pending > 0)
    text << "PARTIAL: interrupted; " << pending << " of " << all
         << " not registered, at predicted poses";
  else if (!run.complete)
    text << "PARTIAL: interrupted; the poses are complete, but scans, map and picture "
            "are missing";
  else if (countScans(run.scans, ScanState::kFixed) +
               countScans(run.scans, ScanState::kMatched) ==
           run.scans.size())
    text << (run.scans.size() == 1
                 ? "1 scan, nothing to match"
                 : "all " + all + " registered, every match converged");
  else
    text << countScans(run.scans, ScanState::kFixed) +
                countScans(run.scans, ScanState::kMatched)
         << " of " << all << " registered";
  describeDrive(run, text);
  describeLoose(run, text);
  describeRecovered(run, text);
  describeUnconverged(run, text);
  describeVerification(run, text);
  text << controlWords(run);
  describeQuality(run, text);
  describeStages(run, text);
  describeMoving(run, text);
  describeMotion(run, text);
  return text.str();
}

} // namespace pcl6d
