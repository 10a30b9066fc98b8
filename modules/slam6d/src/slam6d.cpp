// SPDX-License-Identifier: BSD-3-Clause
#include "metascan.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/registration/icp.h>
#include <pcl6d/slam6d/auto_parameters.h>
#include <pcl6d/slam6d/scan_preparation.h>
#include <pcl6d/slam6d/slam6d.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

namespace pcl6d {

namespace {
/** So many scans are held back in full, until the parameters are derived from them. */
constexpr std::size_t kScansForParameters = 16;

/** A match is not believed if the rms of its pairs is a larger share of max_distance.
 * Partners spread evenly in the ball of max_distance have sqrt(3/5) = 0.77 of it;
 * unrelated clouds, which ICP has pulled together, 0.56 to 0.68. Good matches of hku1
 * (hand-held outdoors) have up to 0.458, but those of kurt3d, whose noise is about as
 * large as max_distance, 0.590. So this finds many unrelated clouds, not all. */
constexpr double kLargestRmsShare = 0.6;

/** A smaller correction, as share of max_distance, is always believed. Wrong matches of
 * hku1 (pairwise, or of each third scan) move a scan by 0.57 m and more, by a third of the
 * step and more; right ones by at most 0.29 m and a fifth of the step. */
constexpr double kSmallCorrection = 1.5;
} // namespace

class Slam6D::Implementation {
public:
  explicit Implementation(const Slam6DOptions& options) : options_(options)
  {
    options_.validate();
  }

  void
  addScan(const Points& points,
          const Eigen::Isometry3d& initial_pose,
          const std::string& given_name)
  {
    const std::size_t place = result_.scans.size();
    const std::string name =
        given_name.empty() ? "scan " + std::to_string(place) : given_name;
    const std::size_t finite = countFinite(points);
    if (finite < 3)
      throw BadArgument(tooFewPoints(name, finite, "with finite coordinates"));
    if (!isRigid(initial_pose))
      throw BadArgument(name + ": the initial pose is not a rigid motion");
    ScanResult scan;
    scan.initial_pose = initial_pose;
    scan.points = finite;
    result_.scans.push_back(scan);
    predict(place);
    unreduced_.push_back(points);
    names_.push_back(name);
    try {
      if (metascan_ || unreduced_.size() >= kScansForParameters)
        reducePending();
    } catch (...) {
      forget(place);
      throw;
    }
  }

  bool
  optimize()
  {
    if (result_.scans.empty())
      throw BadArgument("no scan was added");
    reducePending();
    const auto start = std::chrono::steady_clock::now();
    const std::size_t total = result_.scans.size();
    while (next_ < total && !cancelled_.exchange(false)) {
      registerScan(next_++);
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
    return next_ == total;
  }

  ProgressCallback progress;
  Observer observer;
  std::atomic<bool> cancelled_{false};
  Slam6DResult result_;

private:
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
    if (reduced_.size() + unreduced_.size() > place)
      unreduced_.pop_back();
  }

  void
  reducePending()
  {
    if (!metascan_) {
      result_.parameters =
          deriveParameters(options_, {unreduced_.begin(), unreduced_.end()});
      metascan_.emplace(0.5 * result_.parameters.voxel.value, options_.metascan);
    }
    for (; !unreduced_.empty(); unreduced_.pop_front()) {
      const std::size_t place = reduced_.size();
      reduced_.push_back(
          prepareScan(unreduced_.front(), names_[place], result_.parameters));
      result_.scans[place].reduced = reduced_.back().size();
    }
  }

  void
  registerScan(std::size_t i)
  {
    ScanResult& scan = result_.scans[i];
    predict(i);
    if (i == 0) {
      scan.state = ScanState::kFixed;
      scan.status = Status::kOk;
      scan.covariance = PoseCovariance(PoseCovariance::Zero());
    }
    else {
      match(reduced_[i], odometryStep(i), scan);
    }
    if (scan.state != ScanState::kPredicted)
      metascan_->add(reduced_[i], scan.T_world_scan);
  }

  /** Matches a scan against the metascan, from its predicted pose. */
  void
  match(const Points& points, double odometry_step, ScanResult& scan) const
  {
    const Slam6DParameters& p = result_.parameters;
    // Whole metres from the first scan: the same voxels wherever the world's origin is.
    const Eigen::Vector3d first = result_.scans.front().T_world_scan.translation();
    const Eigen::Vector3d origin =
        first.array() + (scan.T_world_scan.translation() - first).array().round();
    // A scan may move by more than the first limit on its way; twice leaves room.
    const double reach = radiusOf(points) + 2 * p.max_distance_start.value + 1;
    const Points model = metascan_->around(origin, reach);
    Eigen::Isometry3d guess = scan.T_world_scan;
    guess.translation() -= origin;
    const PointTree tree(model, options_.num_threads);
    const IcpResult found = icp(tree, model, points, guess, icpOptions());

    scan.status = found.status;
    scan.pairs = found.pairs;
    scan.rms = found.rms;
    scan.overlap = found.overlap;
    scan.iterations = found.iterations;
    scan.correction =
        (found.T_target_source.translation() - guess.translation()).norm();
    scan.reason = doubt(found, scan.correction, odometry_step);
    if (!scan.reason.empty()) {
      scan.state = ScanState::kPredicted;
      return;
    }
    scan.state =
        found.status == Status::kOk ? ScanState::kMatched : ScanState::kUnconverged;
    scan.covariance = found.covariance;
    scan.T_world_scan = found.T_target_source;
    scan.T_world_scan.translation() += origin;
  }

  /** \return the length of the odometry's motion from the scan before [m] */
  double
  odometryStep(std::size_t i) const
  {
    return distanceBetween(result_.scans[i - 1].initial_pose,
                           result_.scans[i].initial_pose)
        .translation;
  }

  /** \return why a match is not believed, or nothing */
  std::string
  doubt(const IcpResult& found, double correction, double odometry_step) const
  {
    const double max_distance = result_.parameters.max_distance.value;
    std::ostringstream reason;
    if (found.status != Status::kOk && found.status != Status::kMaxIterations)
      reason << "ICP: " << toString(found.status);
    else if (found.overlap < options_.min_overlap)
      reason << "overlap " << found.overlap << " is less than " << options_.min_overlap;
    else if (found.rms > kLargestRmsShare * max_distance)
      reason << "rms " << found.rms << " m is that of unrelated points";
    else if (odometry_step > 0 && correction > kSmallCorrection * max_distance &&
             correction > options_.max_correction * odometry_step)
      reason << "a correction of " << correction << " m is too much for a step of "
             << odometry_step << " m";
    return reason.str();
  }

  IcpOptions
  icpOptions() const
  {
    IcpOptions icp;
    icp.max_iterations = options_.max_iterations;
    icp.max_distance = result_.parameters.max_distance.value;
    icp.max_distance_start = result_.parameters.max_distance_start.value;
    icp.translation_epsilon = options_.translation_epsilon;
    icp.rotation_epsilon = options_.rotation_epsilon;
    icp.num_threads = options_.num_threads;
    return icp;
  }

  Slam6DOptions options_;
  std::vector<std::string> names_;
  std::deque<Points> unreduced_; ///< scans that wait for the parameters
  std::deque<Points> reduced_;   ///< a deque: the metascan refers to its elements
  std::optional<Metascan> metascan_;
  std::size_t next_ = 0; ///< first scan that is not registered
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
  implementation_->addScan(points, initial_pose, name);
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
Slam6D::setObserver(Observer observer)
{
  implementation_->observer = std::move(observer);
}

} // namespace pcl6d
