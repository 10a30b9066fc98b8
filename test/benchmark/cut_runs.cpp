// SPDX-License-Identifier: BSD-3-Clause
#include "cut_runs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_links_io.h>
#include <pcl6d/run/run_summary.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <evaluate/suite/map_truth.h>
#include <map>

namespace pcl6d::bench {

namespace {
namespace fs = std::filesystem;
using Json = nlohmann::json;

bool
isRegistered(const ScanResult& scan)
{
  return scan.state == ScanState::kFixed || scan.state == ScanState::kMatched ||
         scan.state == ScanState::kUnconverged;
}

/** \return the end of the reason of links that were cut, which no other reason has */
std::string
endOfCutReason()
{
  const std::string words =
      toWords(Rejection(RejectReason::kInconsistentTogether, 0, 0));
  return words.substr(words.rfind(" 0 ") + 3);
}

bool
hasDoubt(const MapVerification& map, RejectReason reason)
{
  return std::any_of(map.doubts.begin(), map.doubts.end(), [&](const auto& doubt) {
    return doubt.reason == reason;
  });
}

/** \return whether matching doubts the map, though verification does not */
bool
isDoubtedByMatching(const RunResult& result)
{
  return result.verification->trusted() &&
         result.verdict.find("NOT TO BE TRUSTED") != std::string::npos;
}

CutRun
readWithTruth(const fs::path& run, const fs::path& truth)
{
  CutRun read;
  read.result = readRunSummary(run / "summary.json");
  if (!read.result.verification)
    throw IoFailed(run.string() + ": has no verdict: run it without --no-verification");
  read.links =
      linksBeforeCuts(readLinkChecks(run / "verification.csv"), read.result.scans);
  read.truth = readTrajectory(truth).poses;
  return read;
}

/** \return a run of a suite; none without a map */
std::optional<CutRun>
readSuiteRun(const fs::path& results, const fs::path& folder)
{
  const Json record = Json::parse(text::readFile(folder / "run.json"));
  if (!fs::exists(folder / "result" / "verification.csv"))
    return std::nullopt;
  const std::string name = folder.parent_path().parent_path().filename();
  const auto truthIn = [&](const std::string& data) {
    return results / "data" / data / "groundtruth.txt";
  };
  fs::path truth = truthIn(name);
  if (!fs::exists(truth)) // no file differs from the undamaged data
    truth = truthIn(name.substr(0, name.rfind(", ")));
  CutRun run = readWithTruth(folder / "result", truth);
  run.name = name;
  if (const std::string method = folder.parent_path().filename(); method != "defaults")
    run.name += ", " + method;
  const Json& data = record.at("inputs").at("data");
  run.sensor = (data.contains("source") ? data.at("source") : data)
                   .at("options")
                   .value("scanner", std::string("default"));
  if (data.contains("damage") && data.at("damage").contains("foreign"))
    run.foreign = data.at("damage").at("foreign").get<std::size_t>();
  return run;
}

/** \return whether a scan is named as unreliable with other connections than recorded */
std::vector<bool>
namedWith(const std::vector<bool>& tied, const RunResult& result)
{
  std::vector<bool> named = app::namedScans(result);
  for (std::size_t i = 0; i < named.size(); ++i)
    if (isRegistered(result.scans[i]) && !result.verification->scans[i].tied)
      named[i] = !tied[i];
    else
      named[i] = named[i] || !tied[i];
  return named;
}

/** \return whether the relative pose of a link is wrong: farther from the truth than right links
 * may be (as right links of bench_verification); true for a scan of another scene */
bool
isMisplaced(const LinkCheck& link, const CutRun& run)
{
  constexpr double kRightWay = 0.3, kRightTurn = 0.05; // [m], [rad]
  const ScanResult &from = run.result.scans[link.from], &to = run.result.scans[link.to];
  const auto first = static_cast<std::size_t>(from.index),
             second = static_cast<std::size_t>(to.index);
  if (run.foreign == first || run.foreign == second)
    return true;
  const MotionSize off =
      distanceBetween(run.truth.at(first).inverse() * run.truth.at(second),
                      from.T_world_scan.inverse() * to.T_world_scan);
  return off.translation > kRightWay || off.rotation > kRightTurn;
}

/** Sets how the cuts meet right and wrong links. */
void
compareCuts(const verification::Ties& ties, const CutRun& run, CutVerdict& verdict)
{
  bool is_cut_right = false;
  for (std::size_t k = 0; k < run.links.size(); ++k) {
    const LinkCheck& link = run.links[k];
    if (link.trust != LinkTrust::kGood)
      continue;
    const bool is_wrong = isMisplaced(link, run);
    verdict.is_misplaced |= is_wrong;
    verdict.is_missed |=
        is_wrong && !ties.cut[k] && ties.tied[link.from] && ties.tied[link.to];
    is_cut_right |= !is_wrong && ties.cut[k];
  }
  verdict.is_right_cut = is_cut_right && !verdict.is_misplaced;
}

/** Scans too small for verification are disconnected, and no doubt. */
bool
isTooSmall(const ScanCheck& scan)
{
  return !scan.tied && !scan.doubt;
}

/** \return the verdict on the map with other connected scans than recorded */
TrustRun
verdictOn(const CutRun& run, const std::vector<bool>& tied)
{
  const MapVerification& recorded = *run.result.verification;
  TrustRun verdict;
  verdict.data = run.sensor;
  verdict.name = run.name;
  verdict.doubted_by_matching = isDoubtedByMatching(run.result);
  bool is_doubted = verdict.doubted_by_matching ||
                    hasDoubt(recorded, RejectReason::kScansContradict) ||
                    hasDoubt(recorded, RejectReason::kPosesAmbiguous);
  for (std::size_t i = 0; i < tied.size(); ++i)
    is_doubted = is_doubted || (!tied[i] && !isTooSmall(recorded.scans[i]));
  for (const LinkCheck& link : run.links) {
    const bool was_open =
        !recorded.scans[link.from].tied || !recorded.scans[link.to].tied;
    is_doubted = is_doubted || (link.trust == LinkTrust::kWrong && was_open &&
                                tied[link.from] && tied[link.to]);
  }
  verdict.call = is_doubted                                ? TrustCall::kDoubted
                 : recorded.trust == MapTrust::kUnverified ? TrustCall::kUnverified
                                                           : TrustCall::kGood;
  verdict.scans = app::compareWithTruth(
      run.result, namedWith(tied, run.result), run.truth, run.foreign);
  return verdict;
}
} // namespace

std::vector<LinkCheck>
linksBeforeCuts(std::vector<LinkCheck> links, const std::vector<ScanResult>& scans)
{
  std::map<std::size_t, std::size_t> position;
  for (std::size_t i = 0; i < scans.size(); ++i)
    position[static_cast<std::size_t>(scans[i].index)] = i;
  const std::string cut = endOfCutReason();
  for (LinkCheck& link : links) {
    link.from = position.at(link.from);
    link.to = position.at(link.to);
    if (toWords(link.rejection).find(cut) != std::string::npos)
      link.trust = LinkTrust::kGood;
    if (!isRegistered(scans[link.from]) || !isRegistered(scans[link.to]))
      link.trust = LinkTrust::kWeak;
  }
  return links;
}

std::vector<CutRun>
readSuiteRuns(const fs::path& results)
{
  std::vector<fs::path> folders;
  for (const auto& entry : fs::recursive_directory_iterator(results / "runs"))
    if (entry.path().filename() == "run.json")
      folders.push_back(entry.path().parent_path());
  std::sort(folders.begin(), folders.end());
  std::vector<CutRun> runs;
  for (const fs::path& folder : folders)
    if (auto run = readSuiteRun(results, folder))
      runs.push_back(std::move(*run));
  return runs;
}

CutRun
readCutRun(const fs::path& run, const fs::path& data)
{
  CutRun read = readWithTruth(run, data / "groundtruth.txt");
  read.name = run.filename();
  read.sensor = Json::parse(text::readFile(data / "scene.json")).at("scanner");
  return read;
}

CutVerdict
verdictWith(const verification::CutConstants& constants, const CutRun& run)
{
  verification::Ties ties = verification::tiesOf(run.result.scans.size(),
                                                 run.links,
                                                 run.result.verification->background,
                                                 constants);
  for (std::size_t i = 0; i < ties.tied.size(); ++i)
    ties.tied[i] = ties.tied[i] && isRegistered(run.result.scans[i]);
  CutVerdict verdict;
  verdict.map = verdictOn(run, ties.tied);
  compareCuts(ties, run, verdict);
  return verdict;
}

TrustRun
recordedVerdict(const CutRun& run)
{
  TrustRun verdict;
  verdict.data = run.sensor;
  verdict.name = run.name;
  verdict.doubted_by_matching = isDoubtedByMatching(run.result);
  const MapVerification& map = *run.result.verification;
  verdict.call = !map.trusted() || verdict.doubted_by_matching ? TrustCall::kDoubted
                 : map.trust == MapTrust::kGood                ? TrustCall::kGood
                                                               : TrustCall::kUnverified;
  verdict.scans = app::compareWithTruth(
      run.result, app::namedScans(run.result), run.truth, run.foreign);
  for (const std::string& words : wordsOfEach(map.doubts))
    verdict.message += (verdict.message.empty() ? "" : "; ") + words;
  return verdict;
}

} // namespace pcl6d::bench
