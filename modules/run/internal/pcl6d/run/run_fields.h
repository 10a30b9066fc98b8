// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>

/** \file The fields of the records of a run, each listed once: under their names and in the
 * order of summary.json, links.csv and reports. A visitor is called with the name and the
 * value of each. */
namespace PCL6D_EXPORTS pcl6d {

/** \param[in] scan a ScanResult, const or not */
template <typename Scan, typename Visit>
void
visitScanFields(Scan& scan, Visit&& visit)
{
  visit("file", scan.file);
  visit("index", scan.index);
  visit("initial_pose", scan.initial_pose);
  visit("T_world_scan", scan.T_world_scan);
  visit("covariance", scan.covariance);
  visit("state", scan.state);
  visit("status", scan.status);
  visit("start", scan.start);
  visit("points", scan.points);
  visit("dropped", scan.dropped);
  visit("reduced", scan.reduced);
  visit("pairs", scan.pairs);
  visit("rms", scan.rms);
  visit("overlap", scan.overlap);
  visit("iterations", scan.iterations);
  visit("correction", scan.correction);
  visit("rejections", scan.rejections);
  visit("recovered", scan.recovered);
}

/** \param[in] motion a MotionWithinScan, const or not */
template <typename Motion, typename Visit>
void
visitMotionFields(Motion& motion, Visit&& visit)
{
  visit("deskewed", motion.deskewed);
  visit("rejection", motion.rejection);
  visit("seconds", motion.seconds);
  visit("translation", motion.translation);
  visit("rotation", motion.rotation);
  visit("knots", motion.knots);
}

/** \param[in] moved a MovedPoints, const or not */
template <typename Moved, typename Visit>
void
visitMovedFields(Moved& moved, Visit&& visit)
{
  visit("poses", moved.reading);
  visit("offset", moved.offset);
}

/** \param[in] stage a StageResult, const or not */
template <typename Stage, typename Visit>
void
visitStageFields(Stage& stage, Visit&& visit)
{
  visit("name", stage.kind);
  visit("reverted", stage.reverted);
  visit("rejection", stage.rejection);
  visit("agreement_before", stage.agreement_before);
  visit("agreement_after", stage.agreement_after);
  visit("rounds", stage.rounds);
  visit("seconds", stage.seconds);
}

/** \param[in] link a RunLink, const or not */
template <typename Link, typename Visit>
void
visitLinkFields(Link& link, Visit&& visit)
{
  visit("from", link.from);
  visit("to", link.to);
  visit("kind", link.kind);
  visit("verdict", link.verdict);
  visit("reason", link.rejection);
  visit("distance", link.distance);
  visit("pairs", link.pairs);
  visit("rms", link.rms);
  visit("overlap", link.overlap);
  visit("condition", link.condition);
  visit("weight", link.weight);
}

/** \brief For writing only: optional numbers are passed as pointers.
 * \param[in] link a LinkCheck */
template <typename Link, typename Visit>
void
visitLinkCheckFields(Link& link, Visit&& visit)
{
  visit("from", link.from);
  visit("to", link.to);
  visit("result", link.trust);
  visit("probability_wrong", link.probability_wrong);
  visit("patches", link.patches);
  visit("violated", link.contradicted);
  visit("shift", link.shift);
  visit("deviation", link.deviation);
  visit("open_directions", link.open_directions);
  // Written only: the covariance and the shift required by surfaces are not kept.
  visit("detectable_least", link.noticed ? &link.noticed->least : nullptr);
  visit("detectable_largest", link.noticed ? &link.noticed->most : nullptr);
  visit("detectable_turn", link.noticed ? &link.noticed->turn : nullptr);
  visit("reason", link.rejection);
}

/** \brief Sets a value from its word in files. \throws BadArgument unknown word */
inline void
takeWord(const std::string& word, ScanState& state)
{
  state = scanStateFromName(word);
}
inline void
takeWord(const std::string& word, Status& status)
{
  status = statusFromName(word);
}
inline void
takeWord(const std::string& word, InitialGuess& guess)
{
  guess = initialGuessFromName(word);
}
inline void
takeWord(const std::string& word, RecoveredBy& by)
{
  by = recoveredByFromName(word);
}
inline void
takeWord(const std::string& word, PoseReading& reading)
{
  reading = poseReadingFromName(word);
}
inline void
takeWord(const std::string& word, StageKind& kind)
{
  kind = stageKindFromName(word);
}
inline void
takeWord(const std::string& word, LinkKind& kind)
{
  kind = linkKindFromName(word);
}
inline void
takeWord(const std::string& word, LinkTrust& trust)
{
  trust = linkTrustFromName(word);
}
inline void
takeWord(const std::string& word, LinkVerdict& verdict)
{
  verdict = linkVerdictFromName(word);
}

} // namespace pcl6d
