// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/run_result.h>

#include <algorithm>

namespace pcl6d {

namespace {
constexpr Named<ScanState> kStates[] = {{ScanState::kPending, "pending"},
                                        {ScanState::kFixed, "fixed"},
                                        {ScanState::kMatched, "matched"},
                                        {ScanState::kUnconverged, "unconverged"},
                                        {ScanState::kPredicted, "predicted"},
                                        {ScanState::kUnknown, ""}};
constexpr Named<InitialGuess> kGuesses[] = {{InitialGuess::kOdometry, "odometry"},
                                            {InitialGuess::kOverlap, "overlap"},
                                            {InitialGuess::kFeatures, "features"},
                                            {InitialGuess::kGlobal, "global"}};
constexpr Named<RecoveredBy> kRecoveries[] = {{RecoveredBy::kNone, ""},
                                              {RecoveredBy::kMotion, "motion"},
                                              {RecoveredBy::kSearch, "search"},
                                              {RecoveredBy::kEverywhere, "everywhere"},
                                              {RecoveredBy::kTogether, "together"},
                                              {RecoveredBy::kBeside, "beside"}};
constexpr Named<StageKind> kStageKinds[] = {{StageKind::kMatching, "matching"},
                                            {StageKind::kLoopClosing, "loop closing"},
                                            {StageKind::kRelaxation, "relaxation"},
                                            {StageKind::kMotion, "motion within scans"},
                                            {StageKind::kLinks, "refined links"},
                                            {StageKind::kControl, "control points"}};
constexpr Named<LinkKind> kKinds[] = {{LinkKind::kSequence, "sequence"},
                                      {LinkKind::kNetwork, "network"},
                                      {LinkKind::kLoop, "loop"},
                                      {LinkKind::kGiven, "given"}};
constexpr Named<PoseReading> kReadings[] = {{PoseReading::kFile, "file"},
                                            {PoseReading::kScanner, "scanner"},
                                            {PoseReading::kStation, "station"}};
constexpr Named<LinkVerdict> kVerdicts[] = {{LinkVerdict::kUsed, "used"},
                                            {LinkVerdict::kOdometry, "odometry"},
                                            {LinkVerdict::kRefused, "refused"}};
} // namespace

const char*
toString(ScanState state)
{
  return nameOf(kStates, state);
}

ScanState
scanStateFromName(const std::string& name)
{
  if (const auto state = findNamed(kStates, name))
    return *state;
  throw BadArgument("no state of a scan is called '" + name + "'");
}

std::vector<std::string>
initialGuessNames()
{
  return namesOf(kGuesses);
}

InitialGuess
initialGuessFromName(const std::string& name)
{
  return fromName(kGuesses, "initial guess", name);
}

const char*
toString(InitialGuess guess)
{
  return nameOf(kGuesses, guess);
}

const char*
toString(RecoveredBy by)
{
  return nameOf(kRecoveries, by);
}

RecoveredBy
recoveredByFromName(const std::string& name)
{
  if (const auto by = findNamed(kRecoveries, name))
    return *by;
  throw BadArgument("no way back of a scan is called '" + name + "'");
}

std::size_t
countScans(const std::vector<ScanResult>& scans, ScanState state)
{
  return static_cast<std::size_t>(
      std::count_if(scans.begin(), scans.end(), [&](const auto& scan) {
        return scan.state == state;
      }));
}

const char*
toString(PoseReading reading)
{
  return nameOf(kReadings, reading);
}

PoseReading
poseReadingFromName(const std::string& name)
{
  return fromName(kReadings, "reading of poses", name);
}

const char*
toString(StageKind kind)
{
  return nameOf(kStageKinds, kind);
}

StageKind
stageKindFromName(const std::string& name)
{
  return fromName(kStageKinds, "stage", name);
}

const char*
toString(LinkKind kind)
{
  return nameOf(kKinds, kind);
}

LinkKind
linkKindFromName(const std::string& name)
{
  return fromName(kKinds, "kind", name);
}

const char*
toString(LinkVerdict verdict)
{
  return nameOf(kVerdicts, verdict);
}

LinkVerdict
linkVerdictFromName(const std::string& name)
{
  return fromName(kVerdicts, "verdict", name);
}

Eigen::Isometry3d
initialPoseOf(const RunResult& run, std::size_t place)
{
  const Eigen::Isometry3d& pose = run.scans.at(place).initial_pose;
  return run.control ? run.control->T_control_initial * pose : pose;
}

} // namespace pcl6d
