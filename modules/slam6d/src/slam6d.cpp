// SPDX-License-Identifier: BSD-3-Clause
#include "graph_stage.h"
#include "run_verification.h"
#include "scan_matcher.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/fingerprint.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/slam6d/auto_parameters.h>
#include <pcl6d/slam6d/scan_preparation.h>
#include <pcl6d/slam6d/slam6d.h>

#include <atomic>
#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <utility>

namespace pcl6d {
using namespace slam6d;

namespace {
/** So many scans are held back in full, until the parameters are derived from them. */
constexpr std::size_t kScansForParameters = 16;
} // namespace

class Slam6D::Implementation {
public:
  explicit Implementation(const Slam6DOptions& options)
  : options_(options), verification_(options.num_threads)
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
    if (finite < 3)
      throw BadArgument(tooFewPoints(name, finite, "with finite coordinates"));
    if (!isRigid(scan.initial_pose) || !isRigid(scan.T_world_scan))
      throw BadArgument(name + ": the initial pose is not a rigid motion");
    scan.points = finite;
    result_.scans.push_back(scan);
    if (scan.state == ScanState::kPending)
      predict(place);
    unreduced_.push_back(points);
    names_.push_back(name);
    inputs_.push_back(inputsOf(points, result_.scans.back()));
    try {
      if (matcher_ || unreduced_.size() >= kScansForParameters)
        reducePending();
    } catch (...) {
      forget(place);
      throw;
    }
  }

  void
  addRegistered(const Points& points, ScanResult earlier, const std::string& name)
  {
    if (earlier.state == ScanState::kPending)
      throw BadArgument(nameOf(name) + ": is not registered, but pending");
    if (result_.scans.size() > num_registered_)
      throw BadArgument(nameOf(name) + ": is registered, but one before it is not");
    earlier.matched_pose = earlier.T_world_scan;
    addScan(points, earlier, name);
    ++num_registered_;
  }

  bool
  optimize()
  {
    if (result_.scans.empty())
      throw BadArgument("no scan was added");
    reducePending();
    if (options_.verify)
      verification_.prepare(reduced_,
                            measured_,
                            matcher_->modelOptions(true),
                            result_.parameters.voxel.value);
    const auto start = std::chrono::steady_clock::now();
    const std::size_t total = result_.scans.size();
    takeInRegistered();
    while (next_ < total && !cancelled_.exchange(false)) {
      registerScan(next_);
      if (observer)
        observer(next_ - 1, result_.scans[next_ - 1]);
      if (progress)
        progress({"matching", next_, total});
    }
    cancelled_ = false; // also a request that came with the last scan
    const std::chrono::duration<double> spent =
        std::chrono::steady_clock::now() - start;
    result_.matching_seconds += spent.count();
    for (std::size_t i = next_; i < total; ++i)
      predict(i);
    if (next_ < total || (improved_ < total && !improve()))
      return false;
    if (options_.verify)
      verification_.verify(names_, result_);
    return true;
  }

  ProgressCallback progress;
  Observer observer;
  TaskMemory* memory = nullptr;
  std::atomic<bool> cancelled_{false};
  Slam6DResult result_;

private:
  /** \return the name of a scan that is about to be added */
  std::string
  nameOf(const std::string& given) const
  {
    return given.empty() ? "scan " + std::to_string(result_.scans.size()) : given;
  }

  /** \return what a scan and all before it are */
  std::uint64_t
  inputsOf(const Points& points, const ScanResult& scan) const
  {
    Fingerprint sum;
    if (!inputs_.empty())
      sum.add(inputs_.back());
    sum.add(points);
    sum.add(scan.initial_pose);
    if (scan.state != ScanState::kPending) { // by an earlier run
      sum.add(scan.T_world_scan);
      sum.add(static_cast<std::uint32_t>(scan.state));
    }
    return sum.value();
  }

  /** \return the name of the task that ends with a scan */
  std::uint64_t
  taskOf(std::size_t scan, const std::vector<ScanPair>& links = {}) const
  {
    Fingerprint sum;
    sum.add(inputs_[scan]);
    const Slam6DParameters& p = result_.parameters;
    for (const Parameter& one :
         {p.min_range, p.max_range, p.voxel, p.max_distance, p.max_distance_start})
      sum.add(one.value);
    for (std::size_t i = 0; i < improved_; ++i) // an earlier optimize() moved them
      sum.add(result_.scans[i].T_world_scan);
    for (const auto& [from, to] : links) {
      sum.add(static_cast<std::uint64_t>(from));
      sum.add(static_cast<std::uint64_t>(to));
    }
    return sum.value();
  }

  void
  takeInRegistered()
  {
    for (; next_ < num_registered_; ++next_) {
      matcher_->takeIn(reduced_[next_], measured_[next_], result_.scans[next_]);
      if (next_ > 0)
        measured_[next_ - 1] = MeasuredScan(); // needed no more
    }
  }

  /** Carries the odometry's motion over from the scan before. */
  void
  predict(std::size_t i)
  {
    ScanResult& scan = result_.scans[i];
    scan.T_world_scan = scan.initial_pose;
    if (i == 0)
      return;
    const ScanResult& before = result_.scans[i - 1];
    scan.T_world_scan = extrapolateOdometry(
        before.T_world_scan, before.initial_pose, scan.initial_pose);
  }

  /** Takes back a scan that was just added and could not be reduced. */
  void
  forget(std::size_t place)
  {
    result_.scans.resize(place);
    names_.resize(place);
    inputs_.resize(place);
    if (reduced_.size() + unreduced_.size() > place)
      unreduced_.pop_back();
  }

  void
  reducePending()
  {
    if (!matcher_) {
      result_.parameters =
          deriveParameters(options_, {unreduced_.begin(), unreduced_.end()});
      matcher_.emplace(options_, result_.parameters);
    }
    for (; !unreduced_.empty(); unreduced_.pop_front()) {
      const std::size_t place = reduced_.size();
      const Slam6DParameters& p = result_.parameters;
      Points gated = gateScan(unreduced_.front(), names_[place], p);
      reduced_.push_back(matcher_->prepare(reduceScan(gated, names_[place], p)));
      measured_.emplace_back(std::move(gated));
      result_.scans[place].reduced = reduced_.back().points().size();
    }
  }

  /** Goes on to the next one also if the result cannot be kept. */
  void
  registerScan(std::size_t i)
  {
    ScanResult& scan = result_.scans[i];
    const std::uint64_t task = taskOf(i);
    auto known = memory ? memory->matched(i, task) : std::nullopt;
    if (known) {
      scan = *known;
      matcher_->takeIn(reduced_[i], measured_[i], scan);
    }
    else
      matchScan(i);
    scan.matched_pose = scan.T_world_scan;
    if (i > 0)
      measured_[i - 1] = MeasuredScan(); // needed no more
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
      return matcher_->fix(reduced_[i], measured_[i], scan);
    const Eigen::Isometry3d odometry =
        result_.scans[i - 1].initial_pose.inverse() * scan.initial_pose;
    matcher_->match(reduced_[i], measured_[i], odometry, scan);
  }

  /** Chapter 5, when all scans are matched. \return false if cancelled */
  bool
  improve()
  {
    if (options_.loop_closing == LoopClosing::kNone && !options_.relaxation)
      return true;
    const std::uint64_t task = taskOf(result_.scans.size() - 1, options_.given_links);
    auto known = memory ? memory->relaxed(task) : std::nullopt;
    if (known) {
      known->parameters = result_.parameters;
      result_ = *known;
    }
    else if (!runGraphStage())
      return false;
    improved_ = result_.scans.size();
    matcher_.emplace(options_, result_.parameters); // further scans meet the new poses
    for (std::size_t i = 0; i < improved_; ++i)
      matcher_->takeIn(reduced_[i], measured_[i], result_.scans[i]);
    if (memory && !known)
      memory->keepRelaxed(task, result_);
    return true;
  }

  /** \return false if cancelled */
  bool
  runGraphStage()
  {
    GraphStage stage(options_,
                     result_.parameters,
                     matcher_->icpOptions(reduced_.front().points().size()),
                     matcher_->modelOptions(true),
                     reduced_);
    Slam6DResult improved = result_; // taken as a whole or not at all
    const bool done = stage.run(improved, [&](int round) {
      if (progress)
        progress({"relaxing",
                  static_cast<std::size_t>(round),
                  static_cast<std::size_t>(options_.relaxation_rounds)});
      return !cancelled_.exchange(false);
    });
    cancelled_ = false;
    if (done)
      result_ = std::move(improved);
    return done;
  }

  Slam6DOptions options_;
  std::vector<std::string> names_;
  std::vector<std::uint64_t> inputs_; ///< of each scan: what it and those before are
  std::deque<Points> unreduced_;      ///< scans that wait for the parameters
  std::deque<IcpModel> reduced_;      ///< a deque: the matcher refers to its elements
  std::deque<MeasuredScan> measured_; ///< emptied behind the scan before the next
  RunVerification verification_;
  std::optional<ScanMatcher> matcher_;
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
                      const std::string& name)
{
  implementation_->addRegistered(points, earlier, name);
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
Slam6D::setObserver(Observer observer)
{
  implementation_->observer = std::move(observer);
}

} // namespace pcl6d
