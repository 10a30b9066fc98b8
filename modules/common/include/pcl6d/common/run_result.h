// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>
#include <pcl6d/common/moved_points.h>
#include <pcl6d/common/status.h>
#include <pcl6d/common/trajectory.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

/** \file What is known of a run and of its scans, links and stages, in plain data: slam6d
 * fills it, the module run reads and writes it. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief What became of a scan. */
enum class ScanState {
  kPending,     ///< not yet registered; the pose is predicted from the odometry
  kFixed,       ///< the first scan, which keeps its pose
  kMatched,     ///< registered, and ICP converged
  kUnconverged, ///< registered, but ICP stopped at its iteration limit
  kPredicted,   ///< could not be matched; the pose is predicted from the odometry
  kUnknown      ///< of a run whose summary is gone
};

/** \return "pending", "fixed", "matched", "unconverged", "predicted"; "" if not known */
const char*
toString(ScanState state);
/** \throws BadArgument no state has that name */
ScanState
scanStateFromName(const std::string& name);

/** \brief Where a scan's registration starts from. */
enum class InitialGuess {
  kOdometry, ///< the initial poses, carried over from the scan before (book 5.1.1)
  kOverlap,  ///< the same, then the motion about it with the largest octree overlap
  kFeatures, ///< nothing: descriptors of the scan and the one before are matched
  kGlobal    ///< nothing: all scans are looked at together, in any order
};

/** \return odometry, overlap, features, global */
std::vector<std::string>
initialGuessNames();
/** \throws BadArgument no such name; the message lists all */
InitialGuess
initialGuessFromName(const std::string& name);
const char*
toString(InitialGuess guess);

/** \return whether it uses no initial poses */
inline bool
isWithoutPrior(InitialGuess guess)
{
  return guess == InitialGuess::kFeatures || guess == InitialGuess::kGlobal;
}

/** \brief How a scan was found again that could not be matched where it was expected. */
enum class RecoveredBy {
  kNone,       ///< it was not lost, or not found
  kMotion,     ///< the motion of the scans before was carried on
  kSearch,     ///< around where the odometry expected it
  kEverywhere, ///< among all scans near by, without a guess
  kTogether ///< in one piece with scans before and after it, matched among themselves
};

/** \return "", "motion", "search", "everywhere" or "together" */
const char*
toString(RecoveredBy by);
/** \throws BadArgument no way back has that name */
RecoveredBy
recoveredByFromName(const std::string& name);

/** \brief How the scanner moved while it took a scan. */
struct MotionWithinScan {
  bool undone = false;    ///< the scan's points were brought to the pose at its stamp
  std::string reason;     ///< why not; else empty
  double seconds = 0;     ///< from the first to the last point
  double translation = 0; ///< [m] between their poses
  double rotation = 0;    ///< [rad]
  std::size_t knots = 0;  ///< poses that the motion is made of; 0: it was not undone
  /** T_scan_knot at times [s] since the scan's stamp; empty if it was not undone, or of a run
   * that was read */
  Trajectory path;
};

/** \brief A scan that was registered, or is to be. \ingroup common */
struct ScanResult {
  std::string file; ///< its name in the folder that it came from
  int index = 0;    ///< NNN of the run's files that belong to it
  Eigen::Isometry3d initial_pose = Eigen::Isometry3d::Identity(); ///< as given
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity(); ///< full coordinates
  Eigen::Isometry3d matched_pose =
      Eigen::Isometry3d::Identity(); ///< T_world_scan before loops and relaxation
  /** of x y z roll pitch yaw [m, rad]; zero for the fixed scan, none if not known */
  std::optional<Eigen::Matrix<double, 6, 6>> covariance;
  ScanState state = ScanState::kPending;
  Status status = Status::kTooFewPairs;         ///< of ICP
  InitialGuess start = InitialGuess::kOdometry; ///< where ICP started from: kOdometry
                                                ///< also where kOverlap found nothing
  std::size_t points = 0;                       ///< finite points of the scan
  std::size_t dropped = 0; ///< points left out because they were not finite
  std::size_t reduced = 0; ///< points left for matching
  std::size_t pairs = 0;   ///< pairs within max_distance at the end
  double rms = 0;          ///< [m] of these pairs
  double overlap = 0;      ///< pairs / reduced points
  int iterations = 0;
  double correction = 0; ///< [m] from the predicted to the matched position; with
                         ///< kFeatures and kGlobal, from the one they found
  std::string reason;    ///< why the match is not believed; else empty
  RecoveredBy recovered = RecoveredBy::kNone;
  std::optional<MotionWithinScan> motion; ///< none: it was not looked for
};

/** \return the number of scans in a state */
std::size_t
countScans(const std::vector<ScanResult>& scans, ScanState state);

/** \brief The stages that change poses. */
enum class StageKind {
  kMatching,
  kLoopClosing,
  kRelaxation,
  kMotion ///< the motion within scans, of all at once
};

/** \return "matching", "loop closing", "relaxation" or "motion within scans" */
const char*
toString(StageKind kind);
/** \throws BadArgument no stage has that name */
StageKind
stageKindFromName(const std::string& name);

/** \brief What a stage did to the poses, and how the agreement of the scans judged it. */
struct StageResult {
  StageKind kind = StageKind::kMatching;
  bool undone = false;         ///< it made the map worse: its poses were not taken
  std::string reason;          ///< why it was undone, or did nothing; else empty
  double agreement_before = 0; ///< in [-1, 1]
  double agreement_after = 0;
  int rounds = 0; ///< of relaxation
  double seconds = 0;
  /** T_world_scan of all scans after each round, the last as it was taken; empty if it was
   * undone, or of a run that was read */
  std::vector<std::vector<Eigen::Isometry3d>> history;
};

/** \brief What a run did with points that moved while its scans were taken. */
struct MovingResult {
  std::vector<std::size_t> points; ///< of each scan, those that moved
  bool removed = false;            ///< they are not in scans/; else labelled there
  bool blind = false;              ///< rays contradict too much to tell what moved
  double background = 0; ///< share of points that rays contradict where scans fit best
  double unknown = 0;    ///< share of places that no other scan saw

  /** \return points that moved, of all scans */
  std::size_t
  total() const
  {
    return std::accumulate(points.begin(), points.end(), std::size_t{0});
  }
};

/** \brief Where a link between two scans comes from. */
enum class LinkKind {
  kSequence, ///< a scan and the next one
  kNetwork,  ///< scans that see the same places (book 6.3)
  kLoop,     ///< a closed loop (book 5.1.2)
  kGiven     ///< by the user
};

/** \return "sequence", "network", "loop" or "given" */
const char*
toString(LinkKind kind);
/** \throws BadArgument no kind has that name */
LinkKind
linkKindFromName(const std::string& name);

/** \brief What became of a link. */
enum class LinkVerdict {
  kUsed,     ///< it counts
  kOdometry, ///< its scans do not fix it: their predicted relative pose counts instead
  kRefused   ///< it does not count
};

/** \return "used", "odometry" or "refused" */
const char*
toString(LinkVerdict verdict);
/** \throws BadArgument no verdict has that name */
LinkVerdict
linkVerdictFromName(const std::string& name);

/** \brief Two scans that a run joined, or might have. \ingroup common */
struct RunLink {
  std::size_t from = 0; ///< index NNN of a scan
  std::size_t to = 0;   ///< index NNN of a scan
  LinkKind kind = LinkKind::kNetwork;
  LinkVerdict verdict = LinkVerdict::kUsed;
  std::string reason;  ///< of a verdict other than kUsed
  double distance = 0; ///< [m] between the two positions
  std::size_t pairs = 0;
  double rms = 0;       ///< [m] of these pairs; NaN without pairs
  double overlap = 0;   ///< share of points with a partner
  double condition = 0; ///< smallest eigenvalue of the Localizability, in [0, 1]
  double weight = 1;    ///< what robust switching left of it, in [0, 1]

  /** \return whether it joins the scans */
  bool
  counts() const
  {
    return verdict != LinkVerdict::kRefused;
  }
};

/** \brief A file of a run as it was written. \ingroup common */
struct WrittenFile {
  std::uint64_t bytes = 0;
  std::uint32_t crc32 = 0; ///< of its content, as zlib and gzip compute it
};

/** \return whether both tell of the same content */
inline bool
operator==(const WrittenFile& a, const WrittenFile& b)
{
  return a.bytes == b.bytes && a.crc32 == b.crc32;
}

/** \brief What is known of a run. \ingroup common */
struct RunResult {
  static constexpr int kSchemaVersion = 1;

  /** \brief An option and where its value comes from. */
  struct Option {
    std::string name;
    std::string value;
    std::string source; ///< "given", "default" or "derived"
    std::string why;    ///< of a derived value; else empty
  };

  /** \brief A part of the program's work: "reading", "matching", "writing", ... */
  struct Stage {
    std::string name;
    double seconds = 0;
    double peak_memory_mb = 0; ///< largest resident size of the process so far [MB]
  };

  std::string generator; ///< the program's name
  std::string version;
  Eigen::Vector3d world_offset = Eigen::Vector3d::Zero(); ///< [m]
  std::string pose_source;
  std::optional<MovedPoints>
      moved; ///< how points far from their origin were brought near
  std::vector<Option> options;
  std::vector<Stage> stages;
  std::vector<ScanResult> scans;
  std::vector<StageResult> graph_stages; ///< those that change poses
  std::vector<RunLink> links; ///< all links and loop candidates; a file of its own
  std::size_t links_used = 0;
  std::size_t links_refused = 0;     ///< loop candidates included
  std::vector<std::string> floating; ///< files that no link joins to the first scan
  std::size_t map_points = 0;
  bool complete = true; ///< false: interrupted, part of the scans is not registered
  bool trusted = true;  ///< every scan was matched, and verification is not against it
  /** by places of scans; none of a run that was interrupted, not verified, or is older */
  std::optional<MapVerification> verification;
  std::optional<MovingResult> moving; ///< none: nobody asked
  std::vector<std::string> warnings;  ///< what went wrong without touching the poses
  std::string verdict; ///< the same in words, naming what is not to be trusted
  /** the files of the run as they were written, by their path in its folder ("map.pcd");
   * empty in runs of older versions */
  std::map<std::string, WrittenFile> files;
};

} // namespace pcl6d
