// SPDX-License-Identifier: BSD-3-Clause
#include "global_stage.h"
#include "graph_stage.h"
#include "kept_scans.h"
#include "online_loops.h"
#include "packing.h"
#include "recovery_stage.h"
#include "run_verification.h"
#include "scan_matcher.h"
#include "task_names.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/work_sharing.h>
#include <pcl6d/slam6d/auto_parameters.h>
#include <pcl6d/slam6d/scan_preparation.h>
#include <pcl6d/slam6d/slam6d.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <utility>

namespace pcl6d {
using namespace slam6d;

class Slam6D::Implementation {
public:
  explicit Implementation(const Slam6DOptions& options)
  : options_(options)
  , scans_(options_)
  , verification_(options.num_threads)
  , recovery_(options_, verification_.scans())
  {
    options_.validate();
  }

  /** \param[in] scan with the initial pose, and all else if it is registered */
  void
  addScan(const Points& points, ScanResult scan, const std::string& given_name)
  {
    const std::size_t place = result_.scans.size();
    const std::string name = nameOf(given_name);
    const std::size_t finite = countFinite(points);
    if (finite < 3 && scans_.isHere(place))
      throw BadArgument(tooFewPoints(name, finite, "with finite coordinates"));
    if (!isRigid(scan.initial_pose) || !isRigid(scan.T_world_scan))
      throw BadArgument(name + ": the initial pose is not a rigid motion");
    if (!isPlace(scan.T_world_scan.translation())) // near the initial one
      throw BadArgument(name + ": the pose lies 1e9 m or farther from the origin");
    scan.points = finite;
    result_.scans.push_back(scan);
    if (scan.state == ScanState::kPending)
      predict(place);
    scans_.add(points, name);
    const std::uint64_t before = place > 0 ? inputs_.back() : 0;
    inputs_.push_back(
        scans_.isFirst() ? inputsOf(before, place, points, result_.scans.back()) : 0);
    try {
      if (scans_.isFull(matcher_.has_value()))
        prepareScans();
    } catch (...) {
      result_.scans.resize(place);
      inputs_.resize(place);
      scans_.forget(place);
      throw;
    }
  }

  void
  addRegistered(const Points& points,
                ScanResult earlier,
                const std::string& name,
                std::size_t group)
  {
    if (!groups_.empty() && group != groups_.front() && !isWithoutSequence())
      throw BadArgument(nameOf(name) + ": is of another run than the first scan, but "
                                       "runs are joined by the initial guess global");
    if (earlier.state == ScanState::kPending)
      throw BadArgument(nameOf(name) + ": is not registered, but pending");
    if (result_.scans.size() > num_registered_)
      throw BadArgument(nameOf(name) + ": is registered, but one before it is not");
    earlier.matched_pose = earlier.T_world_scan;
    addScan(points, earlier, name);
    groups_.push_back(group);
    ++num_registered_;
  }

  bool
  optimize()
  {
    if (result_.scans.empty())
      throw BadArgument("no scan was added");
    prepareScans();
    if (options_.verify || isWithoutSequence() || isRecovering())
      verification_.prepare(scans_.reduced(),
                            scans_.measured(),
                            matcher_->modelOptions(true),
                            result_.parameters.voxel.value);
    const std::size_t total = result_.scans.size();
    if (isWithoutSequence() ? next_ < total && !optimizeWithoutPoses()
                            : !optimizeInOrder())
      return false;
    if (options_.verify)
      verification_.verify(scans_.names(), result_);
    return true;
  }

  void
  setSharing(WorkSharing* with)
  {
    sharing = with;
    scans_.setSharing(with);
    verification_.setSharing(with);
  }

  ProgressCallback progress;
  Observer observer;
  WorkSharing* sharing = nullptr;
  TaskMemory* memory = nullptr;
  std::atomic<bool> cancelled_{false};
  Slam6DResult result_;

private:
  /** Scan after scan. \return false if cancelled */
  bool
  optimizeInOrder()
  {
    const std::size_t total = result_.scans.size();
    bool is_whole = true;
    if (scans_.isFirst())
      is_whole = registerAll() && recoverLost();
    if (sharing) {
      is_whole = sharing->fromFirst(is_whole);
      takeRegistered();
    }
    for (std::size_t i = next_; i < total; ++i)
      predict(i);
    return is_whole && (improved_ == total || improve());
  }

  /** Scans that were lost are looked for once more, by all others. \return false if cancelled */
  bool
  recoverLost()
  {
    if (!isRecovering() || improved_ == result_.scans.size())
      return true;
    const auto start = std::chrono::steady_clock::now();
    struct Stopped {};
    Slam6DResult found = result_; // taken as a whole or not at all
    try {
      RecoveryStage(options_, scans_, recovery_, *matcher_)
          .run(
              [this](const Progress& now) {
                if (progress)
                  progress({"recovering", now.done, now.total});
                if (cancelled_.exchange(false))
                  throw Stopped();
              },
              found);
    } catch (const Stopped&) {
      return false;
    }
    result_ = std::move(found);
    const std::chrono::duration<double> spent =
        std::chrono::steady_clock::now() - start;
    result_.matching_seconds += spent.count();
    return true;
  }

  /** \return whether lost scans are looked for: where odometry tells how scans follow */
  bool
  isRecovering() const
  {
    return options_.recover && (options_.initial_guess == InitialGuess::kOdometry ||
                                options_.initial_guess == InitialGuess::kOverlap);
  }

  bool
  isWithoutSequence() const
  {
    return options_.initial_guess == InitialGuess::kGlobal;
  }

  /** Scans in any order. \return false if cancelled: no scan is registered then */
  bool
  optimizeWithoutPoses()
  {
    struct Stopped {};
    const auto report = [this](const Progress& now) {
      if (progress)
        progress(now);
      const bool stop = cancelled_.exchange(false);
      if (sharing ? sharing->fromFirst(stop) : stop)
        throw Stopped();
    };
    Slam6DResult found = result_; // taken as a whole or not at all
    try {
      const GlobalStage stage(
          options_, scans_, verification_.scans(), [&](const Slam6DParameters& now) {
            return makeGraphStage(sharing, now);
          });
      stage.run(groups_, sharing, report, found);
    } catch (const Stopped&) {
      return false;
    }
    result_ = std::move(found);
    groups_.assign(groups_.size(), groups_.empty() ? 0 : groups_.front()); // one world
    next_ = improved_ = result_.scans.size();
    for (std::size_t i = 0; observer && i < result_.scans.size(); ++i)
      observer(i, result_.scans[i]);
    return true;
  }

  /** \return false if cancelled */
  bool
  registerAll()
  {
    const auto start = std::chrono::steady_clock::now();
    const std::size_t total = result_.scans.size();
    takeInRegistered();
    while (next_ < total && !cancelled_.exchange(false)) {
      registerScan(next_);
      if (options_.close_loops_online)
        closeLoopsOnline(next_ - 1);
      if (observer)
        observer(next_ - 1, result_.scans[next_ - 1]);
      if (progress)
        progress({"matching", next_, total});
    }
    cancelled_ = false; // also a request that came with the last scan
    const std::chrono::duration<double> spent =
        std::chrono::steady_clock::now() - start;
    result_.matching_seconds += spent.count();
    return next_ == total;
  }

  /** Takes over what the first process has registered. */
  void
  takeRegistered()
  {
    next_ = sharing->fromFirst(next_);
    takeResult();
    if (!scans_.isFirst())
      for (std::size_t i = 0; i < next_; ++i)
        scans_.dropMeasured(i);
  }

  void
  takeResult()
  {
    const std::string bytes =
        sharing->fromFirst(scans_.isFirst() ? packed(result_) : std::string());
    if (!scans_.isFirst())
      unpack(bytes, result_);
  }

  /** \return the name of a scan that is about to be added */
  std::string
  nameOf(const std::string& given) const
  {
    return given.empty() ? "scan " + std::to_string(result_.scans.size()) : given;
  }

  void
  takeInRegistered()
  {
    for (; next_ < num_registered_; ++next_) {
      matcher_->takeIn(
          scans_.reduced()[next_], scans_.measured()[next_], result_.scans[next_]);
      if (next_ > 0)
        scans_.dropMeasured(next_ - 1); // needed no more
    }
  }

  /** Carries the odometry's motion over from the scan before. */
  void
  predict(std::size_t i)
  {
    result_.scans[i].T_world_scan = predictedPose(i);
  }

  Eigen::Isometry3d
  predictedPose(std::size_t i) const
  {
    const ScanResult& scan = result_.scans[i];
    if (i == 0)
      return scan.initial_pose;
    const ScanResult& before = result_.scans[i - 1];
    return extrapolateOdometry(
        before.T_world_scan, before.initial_pose, scan.initial_pose);
  }

  /** Those that wait; parameters follow from the first ones. */
  void
  prepareScans()
  {
    if (!matcher_) {
      result_.parameters = scans_.derive();
      matcher_.emplace(options_, result_.parameters);
    }
    scans_.prepare(*matcher_, result_.parameters, result_.scans);
  }

  /** Goes on to the next one also if the result cannot be kept. */
  void
  registerScan(std::size_t i)
  {
    ScanResult& scan = result_.scans[i];
    const std::uint64_t task = taskOf(inputs_[i], result_, improved_);
    auto known = memory ? memory->matched(i, task) : std::nullopt;
    if (known) {
      scan = *known;
      matcher_->takeIn(scans_.reduced()[i], scans_.measured()[i], scan);
    }
    else
      matchScan(i);
    scan.matched_pose = scan.T_world_scan;
    if (i > 0)
      scans_.dropMeasured(i - 1); // needed no more
    next_ = i + 1;
    if (memory && !known)
      memory->keepMatched(i, task, scan);
  }

  void
  matchScan(std::size_t i)
  {
    ScanResult& scan = result_.scans[i];
    predict(i);
    if (i == 0)
      return matcher_->fix(scans_.reduced()[i], scans_.measured()[i], scan);
    const Eigen::Isometry3d odometry =
        result_.scans[i - 1].initial_pose.inverse() * scan.initial_pose;
    const auto judge = [&](const ScanResult& found) {
      return isDoubtful(found, i)
                 ? recovery_.objection(i, found.T_world_scan, result_.scans)
                 : "";
    };
    matcher_->match(scans_.reduced()[i], scans_.measured()[i], odometry, scan, judge);
    if (isRecovering() && !isBelieved(scan))
      lookFor(i);
  }

  /** \return whether points and rays have to confirm a match: where the scan before was lost,
   * the odometry was far off, or a look at it raises doubts */
  bool
  isDoubtful(const ScanResult& found, std::size_t i)
  {
    return isRecovering() &&
           (!isBelieved(result_.scans[i - 1]) ||
            !matcher_->isSmallCorrection(found, predictedPose(i)) ||
            recovery_.seemsContradicted(i, found.T_world_scan, result_.scans));
  }

  /** A scan that could not be matched where it was predicted. */
  void
  lookFor(std::size_t i)
  {
    const auto found = recovery_.find(i, result_.scans);
    if (!found)
      return;
    ScanResult scan = result_.scans[i];
    const Eigen::Vector3d predicted = scan.T_world_scan.translation();
    scan.T_world_scan = found->T_world_scan;
    matcher_->matchFound(scans_.reduced()[i], scans_.measured()[i], scan);
    if (!isBelieved(scan))
      return matcher_->passOver(scans_.measured()[i], result_.scans[i].T_world_scan);
    scan.correction = (scan.T_world_scan.translation() - predicted).norm();
    scan.recovered = found->by;
    result_.scans[i] = scan;
  }

  /** Chapter 5, when all scans are matched. \return false if cancelled */
  bool
  improve()
  {
    online_loops_.end();
    if (options_.loop_closing == LoopClosing::kNone && !options_.relaxation &&
        !options_.simultaneous)
      return true;
    deriveLoopParameters(options_, result_.scans, result_.parameters);
    const std::uint64_t task =
        taskOf(inputs_.back(), result_, improved_, options_.given_links);
    auto known = memory ? memory->relaxed(task) : std::nullopt;
    const bool is_known = sharing ? sharing->fromFirst(known.has_value()) : !!known;
    if (known) {
      known->parameters = result_.parameters;
      result_ = *known;
    }
    if (is_known && sharing)
      takeResult();
    if (!is_known && !runGraphStage())
      return false;
    improved_ = result_.scans.size();
    matcher_.emplace(options_, result_.parameters); // further scans meet the new poses
    takeIn(improved_);
    if (memory && !known)
      memory->keepRelaxed(task, result_);
    return true;
  }

  GraphStage
  makeGraphStage(WorkSharing* with, const Slam6DParameters& parameters) const
  {
    return GraphStage(options_,
                      parameters,
                      matcher_->icpOptions(scans_.reduced().front().points().size()),
                      matcher_->modelOptions(true),
                      with);
  }

  /** A loop that a scan closes is closed before the next one is matched. */
  void
  closeLoopsOnline(std::size_t scan)
  {
    if (!online_loops_.isBegun())
      online_loops_.begin(makeGraphStage(nullptr, result_.parameters));
    if (!online_loops_.close(scans_.reduced(), scan, options_, result_))
      return;
    matcher_.emplace(options_, result_.parameters);
    takeIn(scan + 1);
  }

  /** The first scans, where they are. */
  void
  takeIn(std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i)
      matcher_->takeIn(scans_.reduced()[i], scans_.measured()[i], result_.scans[i]);
  }

  /** \return false if cancelled */
  bool
  runGraphStage()
  {
    GraphStage stage = makeGraphStage(sharing, result_.parameters);
    for (const IcpModel& model : scans_.reduced())
      stage.add(model);
    Slam6DResult improved = result_; // taken as a whole or not at all
    const bool done = stage.run(improved, online_loops_.closed(), [&](int round) {
      if (progress)
        progress({"relaxing",
                  static_cast<std::size_t>(round),
                  static_cast<std::size_t>(options_.relaxation_rounds)});
      const bool stop = cancelled_.exchange(false);
      return !(sharing ? sharing->fromFirst(stop) : stop);
    });
    cancelled_ = false;
    if (done)
      result_ = std::move(improved);
    return done;
  }

  Slam6DOptions options_;
  std::vector<std::uint64_t> inputs_; ///< of each scan: what it and those before are
  KeptScans scans_;
  std::vector<std::size_t> groups_; ///< of each registered scan: the number of its run
  RunVerification verification_;
  Recovery recovery_;
  std::optional<ScanMatcher> matcher_;
  OnlineLoops online_loops_;
  std::size_t num_registered_ =
      0;                     ///< so many first scans an earlier run has registered
  std::size_t next_ = 0;     ///< first scan that is not registered
  std::size_t improved_ = 0; ///< so many scans went through the graph stage
};

Slam6D::Slam6D(const Slam6DOptions& options)
: implementation_(std::make_unique<Implementation>(options))
{}

Slam6D::~Slam6D() = default;
Slam6D::Slam6D(Slam6D&&) noexcept = default;
Slam6D&
Slam6D::operator=(Slam6D&&) noexcept = default;

void
Slam6D::addScan(const Points& points,
                const Eigen::Isometry3d& initial_pose,
                const std::string& name)
{
  ScanResult scan;
  scan.initial_pose = initial_pose;
  scan.T_world_scan = initial_pose;
  implementation_->addScan(points, scan, name);
}

void
Slam6D::addRegistered(const Points& points,
                      const ScanResult& earlier,
                      const std::string& name,
                      std::size_t group)
{
  implementation_->addRegistered(points, earlier, name, group);
}

bool
Slam6D::optimize()
{
  return implementation_->optimize();
}

void
Slam6D::cancel()
{
  implementation_->cancelled_ = true;
}

const Slam6DResult&
Slam6D::result() const
{
  return implementation_->result_;
}

void
Slam6D::setProgressCallback(ProgressCallback callback)
{
  implementation_->progress = std::move(callback);
}

void
Slam6D::setMemory(TaskMemory* memory)
{
  implementation_->memory = memory;
}

void
Slam6D::setSharing(WorkSharing* sharing)
{
  implementation_->setSharing(sharing);
}

void
Slam6D::setObserver(Observer observer)
{
  implementation_->observer = std::move(observer);
}

} // namespace pcl6d
