// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/output/folder_job.h"
#include "evaluate/verbs.h"
#include "evaluate/verify/verify_report.h"

#include <pcl6d/slam6d/pose_bounds.h>
#include <pcl6d/verification/map_verifier.h>
#include <pcl6d/verification/pair_verifier.h>
#include <pcl6d/verification/pose_mistake.h>

namespace pcl6d::app {

namespace {
MapTrust
mapTrustOf(LinkTrust trust)
{
  return trust == LinkTrust::kGood         ? MapTrust::kGood
         : trust == LinkTrust::kUnverified ? MapTrust::kUnverified
                                           : MapTrust::kDoubtful;
}

/** Duplicate scans are no evidence: they would confirm each other at any pose. */
void
doubtCopies(const VerifySource& source, MapVerification& map)
{
  std::size_t copies = 0;
  std::string example;
  for (std::size_t i = 0; i < source.names.size(); ++i) {
    const std::size_t first = source.scans.firstLike(i);
    if (first == i)
      continue;
    if (++copies == 1)
      example = source.names[i] + " and " + source.names[first];
  }
  if (copies == 0)
    return;
  map.doubts.emplace_back(RejectReason::kScansAreCopies, static_cast<double>(copies));
  map.doubts.back().text = example;
  if (map.trust == MapTrust::kGood)
    map.trust = MapTrust::kUnverified;
}
} // namespace

MapVerification
verifyMap(const VerifySettings& s, const VerifySource& source)
{
  MapVerifierOptions options;
  options.num_threads = s.num_threads;
  options.unsure = source.unsure;
  options.unregistered = source.unregistered;
  MapVerification map =
      MapVerifier(source.scans.scans(), source.names, options).verify(source.poses);
  boundPoses(source.poses, map, s.num_threads);
  if (source.names.size() == 1)
    map.doubts.emplace_back(RejectReason::kSingleScan);
  doubtCopies(source, map);
  if (map.trust == MapTrust::kDoubtful || map.trust == MapTrust::kUnverified) {
    const std::string mistake =
        likelyPoseMistake(source.scans.scans(), source.poses, s.num_threads);
    if (!mistake.empty()) {
      map.trust = MapTrust::kDoubtful;
      map.doubts.emplace_back(RejectReason::kPoseMistake).text = "poses: " + mistake;
    }
  }
  return map;
}

MapVerification
verifyPair(const VerifySource& source)
{
  const PairVerdict verdict =
      verifyLink(source.scans, 0, 1, source.poses[0].inverse() * source.poses[1]);
  const LinkTrust trust = verdict.test_result.trust;
  MapVerification map;
  map.trust = mapTrustOf(trust);
  map.background = verdict.background;
  map.links.push_back(linkCheck(0, 1, verdict.evidence, verdict.test_result));
  map.scans.resize(2);
  for (std::size_t i = 0; i < 2; ++i) {
    map.scans[i].abstains = source.scans.scans()[i].abstains();
    map.scans[i].off_centre = source.scans.scans()[i].isOffCentre();
  }
  map.scans[0].tied = true;
  map.scans[1].tied = map.trusted();
  boundPoses(source.poses, map, 1);
  const auto& scans = source.scans.scans();
  map.links.front().noticed = map.scans[1].noticed =
      noticedError(scans[0], scans[1], verdict.evidence, verdict.background);
  if (map.scans[1].noticed)
    map.scans[1].noticed->weakest =
        source.poses[0].linear() * map.scans[1].noticed->weakest;
  if (trust == LinkTrust::kGood)
    return map;
  if (map.links.front().patches == 0 && verdict.evidence.fit.pairs == 0)
    map.doubts.emplace_back(RejectReason::kNoSurfacesAtPose);
  else
    map.doubts.emplace_back(trust == LinkTrust::kWrong ? RejectReason::kPoseContradicted
                            : trust == LinkTrust::kWeak ? RejectReason::kPoseUndecided
                                                        : RejectReason::kPoseNotTested,
                            verdict.test_result.rejection);
  if (!map.trusted())
    map.scans[1].doubt = verdict.test_result.rejection;
  return map;
}

int
runVerify(const std::vector<std::string>& arguments)
{
  VerifySettings s;
  if (!parseVerifySettings(arguments, s))
    return kDone;
  FolderJob job(s.quiet, s.without_effect, verifyFolderRules(s));
  const auto source = loadVerifySource(s, job.bar, job.interrupt);
  if (!source) {
    job.bar.warn("interrupted; nothing written");
    return kInterrupted;
  }
  const MapVerification map = s.isPair() ? verifyPair(*source) : verifyMap(s, *source);
  printVerification(s, *source, map);
  const bool is_drawn = !job.out || publishVerification(job, s, *source, map);
  flushOutput();
  if (map.trust == MapTrust::kUnverified)
    job.bar.warn("no link contradicts the poses, but not every pose is verified");
  return map.trusted() && is_drawn ? kDone : kDoubtful;
}

} // namespace pcl6d::app
