// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/control_points.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/map_verification.h>
#include <pcl6d/common/moved_points.h>
#include <pcl6d/common/rejection.h>
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

/** \file Results of a run and of the run's scans, links and stages, in plain data: slam6d fills
 * the structs, the module run reads and writes them. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief State of a scan after registration. */
enum class ScanState {
  kPending, ///< not yet registered; the pose is predicted from the odometry
  kFixed,   ///< the first scan: the pose is fixed
  kMatched, ///< registered, and ICP converged; tracking may have fixed a motion left open
  kUnconverged, ///< registered, but ICP stopped at the iteration limit
  kPredicted,   ///< could not be matched; the pose is predicted from the odometry
  kUnknown      ///< of a run without a summary
};

/** \return "pending", "fixed", "matched", "unconverged", "predicted"; "" if not known */
const char*
toString(ScanState state);
/** \throws BadArgument unknown name */
ScanState
scanStateFromName(const std::string& name);

/** \brief Where a scan's registration starts from. */
enum class InitialGuess {
  kOdometry, ///< the initial poses, carried over from the scan before (book 5.1.1)
  kOverlap,  ///< the odometry, then the nearby motion with the largest octree overlap
  kFeatures, ///< no initial poses: descriptors of consecutive scans are matched
  kGlobal    ///< no initial poses: all scans are considered together, in any order
};

/** \return odometry, overlap, features, global */
std::vector<std::string>
initialGuessNames();
/** \throws BadArgument another name; the message lists the valid names */
InitialGuess
initialGuessFromName(const std::string& name);
const char*
toString(InitialGuess guess);

/** \return whether the method works without initial poses */
inline bool
isWithoutPrior(InitialGuess guess)
{
  return guess == InitialGuess::kFeatures || guess == InitialGuess::kGlobal;
}

/** \brief How a scan without a match at the predicted pose was found again. */
enum class RecoveredBy {
  kNone,       ///< never lost, or never found
  kMotion,     ///< the motion of the scans before was carried on
  kSearch,     ///< around the pose predicted from the odometry
  kEverywhere, ///< among all scans nearby, by place recognition
  kTogether, ///< in one piece with the scans before and after, matched among themselves
  kBeside ///< not in the map: matched with scans of a piece beside the map, whose place is
          ///< that of the odometry
};

/** \return "", "motion", "search", "everywhere", "together" or "beside" */
const char*
toString(RecoveredBy by);
/** \throws BadArgument unknown name */
RecoveredBy
recoveredByFromName(const std::string& name);

/** \brief Motion of the scanner during a scan. */
struct MotionWithinScan {
  bool deskewed = false;  ///< to the pose at the stamp of the scan
  Rejection rejection;    ///< why not
  double seconds = 0;     ///< from the first to the last point
  double translation = 0; ///< [m] between their poses
  double rotation = 0;    ///< [rad]
  std::size_t knots = 0;  ///< poses of the motion; 0: not deskewed
  /** T_scan_knot at times [s] since the stamp of the scan; empty if the scan was not deskewed,
   * or the run was read from a file */
  Trajectory path;
};

/** \brief A scan, registered or pending. \ingroup common */
struct ScanResult {
  std::string file; ///< name in the input folder
  int index = 0;    ///< NNN in the names of the scan's files
  Eigen::Isometry3d initial_pose = Eigen::Isometry3d::Identity(); ///< as given
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity(); ///< full coordinates
  Eigen::Isometry3d matched_pose =
      Eigen::Isometry3d::Identity(); ///< T_world_scan before loops and relaxation
  /** of x y z roll pitch yaw [m, rad]; zero for the fixed scan, empty if not known */
  std::optional<Eigen::Matrix<double, 6, 6>> covariance;
  ScanState state = ScanState::kPending;
  Status status = Status::kTooFewPairs;         ///< of ICP
  InitialGuess start = InitialGuess::kOdometry; ///< initial guess of ICP: kOdometry
                                                ///< also if kOverlap had no effect
  std::size_t points = 0;                       ///< finite points of the scan
  std::size_t dropped = 0;                      ///< points left out because not finite
  std::size_t reduced = 0;                      ///< points left for matching
  std::size_t pairs = 0; ///< pairs within max_distance at the end
  double rms = 0;        ///< [m] of the pairs
  double overlap = 0;    ///< pairs / reduced points
  int iterations = 0;
  double correction = 0; ///< [m] from the predicted to the matched position; with
                         ///< kFeatures and kGlobal, from the position of their guess
  /** why the match at the predicted pose was rejected, then why recovery failed; empty if the
   * scan is registered */
  std::vector<Rejection> rejections;
  RecoveredBy recovered = RecoveredBy::kNone;
  std::optional<MotionWithinScan> motion; ///< none: not estimated
};

/** \return the number of scans in a state */
std::size_t
countScans(const std::vector<ScanResult>& scans, ScanState state);

/** \brief The stages that change poses. */
enum class StageKind {
  kMatching,
  kLoopClosing,
  kRelaxation,
  kMotion, ///< the motion within scans, in one adjustment of all scans
  kLinks,  ///< the adjustment to refined links of sparse scans
  kControl ///< the adjustment to control points
};

/** \return "matching", "loop closing", "relaxation", "motion within scans", "refined links" or "control
 * points" */
const char*
toString(StageKind kind);
/** \throws BadArgument unknown name */
StageKind
stageKindFromName(const std::string& name);

/** \brief Change of the poses by a stage, and agreement of the scans before and after. */
struct StageResult {
  StageKind kind = StageKind::kMatching;
  bool reverted = false;       ///< the map became worse: previous poses are kept
  Rejection rejection;         ///< why the stage was reverted, or had no effect
  double agreement_before = 0; ///< in [-1, 1]
  double agreement_after = 0;
  int rounds = 0; ///< of relaxation
  double seconds = 0;
  /** T_world_scan of all scans after each round, the last round as accepted; empty if the stage
   * was reverted, or the run was read from a file */
  std::vector<std::vector<Eigen::Isometry3d>> history;
};

/** \brief Dynamic points of a run. */
struct MovingResult {
  std::vector<std::size_t> points; ///< number of dynamic points of each scan
  bool removed = false;            ///< removed from scans/; false: labelled in scans/
  bool blind = false;              ///< too many free-space violations to decide
  double background = 0; ///< share of free-space violations in the best-fitting scans
  double unknown = 0;    ///< share of places seen by a single scan

  /** \return number of dynamic points in all scans */
  std::size_t
  total() const
  {
    return std::accumulate(points.begin(), points.end(), std::size_t{0});
  }
};

/** \brief The sweeps of a drive; the keyframes are the scans of the map. */
struct DriveResult {
  int first = 0; ///< index of the first sweep in the folder; the rest follows
  std::vector<std::string> files; ///< names of all sweeps, including keyframes
  std::vector<int> lost;          ///< indices of sweeps without a match in tracking
  double way = 0;                 ///< [m] along the poses of all sweeps
  double seconds = 0; ///< from the first to the last sweep; 0: without stamps
  /** T_world_sweep of all sweeps; empty if the run was read from a file */
  std::vector<Eigen::Isometry3d> poses;
  std::vector<double> stamps; ///< [s] for each pose, or empty

  /** \return the index of a sweep in `files` and `poses` \param[in] index of a sweep of the
   * drive */
  std::size_t
  placeOf(int index) const
  {
    return static_cast<std::size_t>(index - first);
  }
};

/** \brief Origin of a link between two scans. */
enum class LinkKind {
  kSequence, ///< consecutive scans
  kNetwork,  ///< overlapping scans (book 6.3)
  kLoop,     ///< a closed loop (book 5.1.2)
  kGiven     ///< by the user
};

/** \return "sequence", "network", "loop" or "given" */
const char*
toString(LinkKind kind);
/** \throws BadArgument unknown name */
LinkKind
linkKindFromName(const std::string& name);

/** \brief Use of a link. */
enum class LinkVerdict {
  kUsed,     ///< the link is used
  kOdometry, ///< too few constraints: replaced by the predicted relative pose
  kRefused   ///< the link is rejected
};

/** \return "used", "odometry" or "refused" */
const char*
toString(LinkVerdict verdict);
/** \throws BadArgument unknown name */
LinkVerdict
linkVerdictFromName(const std::string& name);

/** \brief A link between two scans, or a candidate for a link. \ingroup common */
struct RunLink {
  std::size_t from = 0; ///< index NNN of a scan
  std::size_t to = 0;   ///< index NNN of a scan
  LinkKind kind = LinkKind::kNetwork;
  LinkVerdict verdict = LinkVerdict::kUsed;
  Rejection rejection; ///< why the verdict is not kUsed
  double distance = 0; ///< [m] between the two positions
  std::size_t pairs = 0;
  double rms = 0;       ///< [m] of the pairs; NaN without pairs
  double overlap = 0;   ///< share of points with a partner
  double condition = 0; ///< smallest eigenvalue of the Localizability, in [0, 1]
  double weight = 1;    ///< after robust switching, in [0, 1]

  /** \return whether the link connects the scans */
  bool
  counts() const
  {
    return verdict != LinkVerdict::kRefused;
  }
};

/** \brief Size and checksum of a written file of a run. \ingroup common */
struct WrittenFile {
  std::uint64_t bytes = 0;
  std::uint32_t crc32 = 0; ///< checksum of the content, as in zlib and gzip
};

/** \return whether the contents are equal */
inline bool
operator==(const WrittenFile& a, const WrittenFile& b)
{
  return a.bytes == b.bytes && a.crc32 == b.crc32;
}

/** \brief Results of a run. \ingroup common */
struct RunResult {
  static constexpr int kSchemaVersion = 2;

  /** \brief An option with the origin of the value. */
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
  std::vector<StageResult> graph_stages; ///< stages that change poses
  std::vector<RunLink> links; ///< all links and loop candidates, in a separate file
  std::size_t links_used = 0;
  std::size_t links_refused = 0;     ///< loop candidates included
  std::vector<std::string> floating; ///< files without links to the first scan
  std::size_t map_points = 0;
  bool complete = true; ///< false: interrupted, part of the scans is not registered
  bool trusted = true;  ///< every scan is matched, verification has no contradiction
  /** scans indexed as in `scans`; empty for runs that are interrupted, not verified, or older */
  std::optional<MapVerification> verification;
  std::optional<MovingResult> moving;   ///< empty: no search for dynamic points
  std::optional<ControlResult> control; ///< scans indexed as in `scans`; or empty
  std::optional<DriveResult> drive;     ///< only if `scans` are keyframes
  std::vector<std::string> warnings;    ///< problems without effect on the poses
  std::string verdict; ///< in words, with the doubtful parts of the map
  /** files of the run by path in the run folder ("map.pcd"); empty in runs of older versions */
  std::map<std::string, WrittenFile> files;
};

/** \return the initial pose of a scan in the frame of the resulting poses: moved with the map if
 * the map was adjusted to control points \param[in] place index into run.scans */
Eigen::Isometry3d
initialPoseOf(const RunResult& run, std::size_t place);

} // namespace pcl6d
