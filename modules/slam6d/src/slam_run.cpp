// SPDX-License-Identifier: BSD-3-Clause
#include "global_stage.h"
#include "packing.h"
#include "second_look.h"
#include "slam_run.h"
#include "task_names.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/slam6d/auto_parameters.h>
#include <pcl6d/slam6d/scan_preparation.h>

#include <chrono>
#include <utility>

namespace pcl6d::slam6d {

SlamRun::SlamRun(const Slam6DOptions& options)
: options_(options)
, scans_(options_)
, motion_(options_)
, verification_(options.num_threads)
, moving_(options.num_threads)
, recovery_(options_, verification_.scans())
{
  options_.validate();
}

void
SlamRun::addScan(const Points& points, ScanResult scan, const std::string& given_name)
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
SlamRun::addRegistered(const Points& points,
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
  addStill(points, earlier, name);
  groups_.push_back(group);
  ++num_registered_;
}

bool
SlamRun::optimize()
{
  addUndone(true);
  if (result_.scans.empty())
    throw BadArgument("no scan was added");
  if (options_.motion.gives_poses && motion_.anyMoved())
    options_.initial_guess = InitialGuess::kOdometry;
  prepareScans();
  if (options_.verify || options_.leave_out_moving || isWithoutSequence() ||
      isRecovering(options_))
    verification_.prepare(scans_.reduced(),
                          scans_.measured(),
                          matcher_->matcher().modelOptions(true),
                          result_.parameters.voxel.value);
  const std::size_t total = result_.scans.size();
  if (isWithoutSequence() ? next_ < total && !optimizeWithoutPoses()
                          : !optimizeInOrder())
    return false;
  relaxMotions();
  if (options_.leave_out_moving && !leaveOutMoving())
    return false;
  if (!options_.verify)
    return true;
  verification_.verify(scans_.names(), result_);
  const bool is_whole = lookAgain();
  if (options_.leave_out_moving) // where poses were looked at again
    moving_.judge(verification_.scans(), result_);
  motion_.describe(result_.scans);
  return is_whole;
}

void
SlamRun::setSharing(WorkSharing* with)
{
  sharing = with;
  scans_.setSharing(with);
  verification_.setSharing(with);
}

bool
SlamRun::optimizeInOrder()
{
  const std::size_t total = result_.scans.size();
  bool is_whole = true;
  if (scans_.isFirst())
    is_whole = registerAll() && (improved_ == total || recoverLost());
  if (sharing) {
    is_whole = sharing->fromFirst(is_whole);
    takeRegistered();
  }
  for (std::size_t i = next_; i < total; ++i)
    predict(i);
  return is_whole && (improved_ == total || improve());
}

bool
SlamRun::recoverLost()
{
  if (!isRecovering(options_))
    return true;
  const auto start = std::chrono::steady_clock::now();
  struct Stopped {};
  Slam6DResult found = result_; // taken as a whole or not at all
  try {
    matcher_->recover(
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
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  result_.matching_seconds += spent.count();
  return true;
}

bool
SlamRun::lookAgain()
{
  if (!isRecovering(options_) || !hasUntied(result_))
    return true;
  Slam6DResult before = result_;
  loosen(num_registered_, result_);
  startAnew(result_.scans.size());
  bool is_whole = !scans_.isFirst() || recoverLost();
  if (sharing) {
    is_whole = sharing->fromFirst(is_whole);
    takeResult();
  }
  is_whole = is_whole && improve();
  if (is_whole)
    verification_.verify(scans_.names(), result_);
  if (is_whole && isBetterTied(result_, before)) {
    keepMatchedPoses(before, result_);
    return true;
  }
  result_ = std::move(before);
  startAnew(result_.scans.size());
  return is_whole;
}

bool
SlamRun::optimizeWithoutPoses()
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

bool
SlamRun::registerAll()
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
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  result_.matching_seconds += spent.count();
  return next_ == total;
}

void
SlamRun::takeRegistered()
{
  next_ = sharing->fromFirst(next_);
  takeResult();
  if (!scans_.isFirst())
    for (std::size_t i = 0; i < next_; ++i)
      scans_.dropMeasured(i);
}

void
SlamRun::takeResult()
{
  const std::string bytes =
      sharing->fromFirst(scans_.isFirst() ? packed(result_) : std::string());
  if (!scans_.isFirst())
    unpack(bytes, result_);
}

void
SlamRun::takeInRegistered()
{
  for (; next_ < num_registered_; ++next_) {
    matcher_->takeIn(next_, result_.scans);
    if (next_ > 0)
      scans_.dropMeasured(next_ - 1); // needed no more
  }
}

void
SlamRun::prepareScans()
{
  if (!matcher_) {
    result_.parameters = scans_.derive();
    matcher_.emplace(options_, result_.parameters, scans_, recovery_);
  }
  scans_.prepare(matcher_->matcher(), result_.parameters, result_.scans);
}

void
SlamRun::registerScan(std::size_t i)
{
  ScanResult& scan = result_.scans[i];
  const std::uint64_t task = taskOf(inputs_[i], result_, improved_);
  auto known = memory ? memory->matched(i, task) : std::nullopt;
  if (known) {
    scan = *known;
    matcher_->takeIn(i, result_.scans);
  }
  else
    matcher_->match(i, result_.scans);
  scan.matched_pose = scan.T_world_scan;
  if (i > 0)
    scans_.dropMeasured(i - 1); // needed no more
  next_ = i + 1;
  if (memory && !known)
    memory->keepMatched(i, task, scan);
}

bool
SlamRun::improve()
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
  startAnew(improved_); // further scans meet the new poses
  if (memory && !known)
    memory->keepRelaxed(task, result_);
  return true;
}

GraphStage
SlamRun::makeGraphStage(WorkSharing* with, const Slam6DParameters& parameters) const
{
  return GraphStage(
      options_,
      parameters,
      matcher_->matcher().icpOptions(scans_.reduced().front().points().size()),
      matcher_->matcher().modelOptions(true),
      with);
}

void
SlamRun::closeLoopsOnline(std::size_t scan)
{
  if (!online_loops_.isBegun())
    online_loops_.begin(makeGraphStage(nullptr, result_.parameters));
  if (!online_loops_.close(scans_.reduced(), scan, options_, result_))
    return;
  startAnew(scan + 1);
}

void
SlamRun::startAnew(std::size_t count)
{
  matcher_.emplace(options_, result_.parameters, scans_, recovery_);
  for (std::size_t i = 0; i < count; ++i)
    matcher_->takeIn(i, result_.scans);
}

GraphStage::Observer
SlamRun::relaxing()
{
  return [this](int round) {
    if (progress)
      progress({"relaxing",
                static_cast<std::size_t>(round),
                static_cast<std::size_t>(options_.relaxation_rounds)});
    const bool stop = cancelled_.exchange(false);
    return !(sharing ? sharing->fromFirst(stop) : stop);
  };
}

bool
SlamRun::runGraphStage()
{
  GraphStage stage = makeGraphStage(sharing, result_.parameters);
  for (const IcpModel& model : scans_.reduced())
    stage.add(model);
  Slam6DResult improved = result_; // taken as a whole or not at all
  const bool done = stage.run(improved, online_loops_.closed(), relaxing());
  cancelled_ = false;
  if (done)
    result_ = std::move(improved);
  return done;
}

} // namespace pcl6d::slam6d
