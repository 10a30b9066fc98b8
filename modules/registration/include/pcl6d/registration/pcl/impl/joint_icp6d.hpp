// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/registration/pcl/impl/joint_sides.h>
#include <pcl6d/registration/pcl/joint_icp6d.h>

#include <pcl/types.h>

#include <optional>
#include <utility>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointSource, typename PointTarget, typename Scalar>
struct JointICP6D<PointSource, PointTarget, Scalar>::Target
: registration::JointTarget {
  typename PointCloudTarget::Ptr cloud = pcl::make_shared<PointCloudTarget>();
  pcl::Indices all; ///< of the cloud
  Normals normals;  ///< if needed by a metric
  std::optional<ScanNormals> normals_made;
};

template <typename PointSource, typename PointTarget, typename Scalar>
struct JointICP6D<PointSource, PointTarget, Scalar>::Sources {
  typename PointCloudSource::Ptr cloud = pcl::make_shared<PointCloudSource>();
  pcl::IndicesPtr all = pcl::make_shared<pcl::Indices>();
  std::vector<Points> parts; ///< the points of each source
  Points points;             ///< of all
  Normals normals;           ///< if needed by the metric
};

template <typename PointSource, typename PointTarget, typename Scalar>
void
JointICP6D<PointSource, PointTarget, Scalar>::setInputSource(
    const typename Pcl::PointCloudSourceConstPtr&)
{
  throw BadArgument("JointICP6D takes several sources: addInputSource()");
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
JointICP6D<PointSource, PointTarget, Scalar>::setInputTarget(
    const typename Pcl::PointCloudTargetConstPtr&)
{
  throw BadArgument("JointICP6D takes several targets: addInputTarget()");
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
JointICP6D<PointSource, PointTarget, Scalar>::addInputSource(
    const typename Pcl::PointCloudSourceConstPtr& cloud)
{
  registration::requireGiven(cloud, "an input source");
  if (sources_.empty()) // align() of PCL's class needs a source
    Base::setInputSource(cloud);
  sources_.push_back(cloud);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
JointICP6D<PointSource, PointTarget, Scalar>::addInputTarget(
    const typename Pcl::PointCloudTargetConstPtr& cloud)
{
  registration::requireGiven(cloud, "an input target");
  if (targets_.empty())
    Base::setInputTarget(cloud);
  targets_.push_back(cloud);
  joint_.reset();
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
JointICP6D<PointSource, PointTarget, Scalar>::addCorrespondenceEstimation(
    const typename Pcl::CorrespondenceEstimationPtr& estimation)
{
  registration::requireGiven(estimation, "a correspondence estimation");
  estimations_.push_back(estimation);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
JointICP6D<PointSource, PointTarget, Scalar>::requirePairs(
    const IcpOptions& options) const
{
  const auto count = [](std::size_t n) { return std::to_string(n); };
  if (sources_.empty() || sources_.size() != targets_.size())
    throw BadArgument("JointICP6D: there are " + count(sources_.size()) +
                      " sources and " + count(targets_.size()) +
                      " targets, but there must be as many of both, and some");
  if (!estimations_.empty() && estimations_.size() != sources_.size())
    throw BadArgument("JointICP6D: there are " + count(estimations_.size()) +
                      " correspondence estimations for " + count(sources_.size()) +
                      " pairs of clouds");
  if (this->use_indices_)
    throw BadArgument(
        "JointICP6D: indices are those of one cloud, and there are several");
  if (options.estimate_scale)
    throw BadArgument("JointICP6D: a scale cannot be estimated");
}

/** Joins the targets, if needed. */
template <typename PointSource, typename PointTarget, typename Scalar>
void
JointICP6D<PointSource, PointTarget, Scalar>::makeTarget(unsigned int num_threads)
{
  if (joint_)
    return;
  joint_ = std::make_shared<Target>();
  std::vector<Points> parts;
  for (const auto& target : targets_) {
    *joint_->cloud += *target;
    parts.push_back(toPoints(*target));
  }
  joint_->all = registration::allOf(*joint_->cloud);
  joint_->make(std::move(parts), num_threads);
}

/** Adds the normals of the targets, each from its own cloud, if missing. */
template <typename PointSource, typename PointTarget, typename Scalar>
void
JointICP6D<PointSource, PointTarget, Scalar>::makeTargetNormals(
    const IcpOptions& options)
{
  if (joint_->normals_made == this->normal_settings_)
    return;
  joint_->normals.clear();
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const Normals normals = registration::normalsOf(*targets_[i],
                                                    registration::allOf(*targets_[i]),
                                                    joint_->parts[i],
                                                    joint_->trees[i].get(),
                                                    this->normal_settings_,
                                                    options);
    joint_->normals.insert(joint_->normals.end(), normals.begin(), normals.end());
  }
  joint_->normals_made = this->normal_settings_;
}

template <typename PointSource, typename PointTarget, typename Scalar>
typename JointICP6D<PointSource, PointTarget, Scalar>::Sources
JointICP6D<PointSource, PointTarget, Scalar>::makeSources(
    const IcpOptions& options) const
{
  Sources sources;
  for (const auto& source : sources_) {
    *sources.cloud += *source;
    const Points points = toPoints(*source);
    sources.points.insert(sources.points.end(), points.begin(), points.end());
    if (options.metric == Metric::kGicp || options.symmetric) {
      const Normals normals = registration::normalsOf(*source,
                                                      registration::allOf(*source),
                                                      points,
                                                      nullptr,
                                                      this->normal_settings_,
                                                      options);
      sources.normals.insert(sources.normals.end(), normals.begin(), normals.end());
    }
    sources.parts.push_back(points);
  }
  *sources.all = registration::allOf(*sources.cloud);
  return sources;
}

/** \return the finder of pairs of one source and target */
template <typename PointSource, typename PointTarget, typename Scalar>
typename JointICP6D<PointSource, PointTarget, Scalar>::Finder
JointICP6D<PointSource, PointTarget, Scalar>::finder(const Sources& sources,
                                                     std::size_t pair,
                                                     const IcpOptions& options) const
{
  auto estimation =
      estimations_.empty() ? this->correspondence_estimation_ : estimations_[pair];
  if (!estimation)
    return registration::pairFinder(sources.parts[pair],
                                    *joint_->trees[pair],
                                    joint_->parts[pair],
                                    this->reciprocal_,
                                    options.num_threads);
  if (estimations_.empty())
    estimation = estimation->clone();
  const auto tree = pcl::make_shared<KdTree<PointTarget>>();
  tree->setNumberOfThreads(options.num_threads);
  tree->setInputCloud(targets_[pair]);
  return std::make_shared<typename Base::Adapter>(
             sources_[pair],
             pcl::make_shared<const pcl::Indices>(registration::allOf(*sources_[pair])),
             targets_[pair],
             tree,
             joint_->origin)
      ->finder(estimation, this->reciprocal_);
}

template <typename PointSource, typename PointTarget, typename Scalar>
IcpHooks
JointICP6D<PointSource, PointTarget, Scalar>::hooks(const Sources& sources,
                                                    const IcpOptions& options)
{
  IcpHooks hooks;
  this->addObservers(hooks,
                     joint_->origin,
                     {&*sources.cloud, &*sources.all, &*joint_->cloud, &joint_->all});
  std::vector<Finder> finders;
  std::vector<std::size_t> begins;
  std::size_t begin = 0;
  for (std::size_t pair = 0; pair < sources_.size(); ++pair) {
    finders.push_back(finder(sources, pair, options));
    begins.push_back(begin);
    begin += sources.parts[pair].size();
  }
  hooks.find =
      registration::jointFinder(std::move(finders), std::move(begins), *joint_);
  const auto adapter = std::make_shared<typename Base::Adapter>(
      sources.cloud,
      sources.all,
      joint_->cloud,
      pcl::make_shared<KdTree<PointTarget>>(), // every point is searched
      joint_->origin);
  this->plugIn(adapter, {}, options, hooks);
  return hooks;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
JointICP6D<PointSource, PointTarget, Scalar>::computeTransformation(
    PointCloudSource& output,
    const Matrix4& guess)
{
  const IcpOptions options = this->startRun();
  requirePairs(options);
  Eigen::Isometry3d start = this->startPose(guess);
  makeTarget(options.num_threads);
  const bool has_normals = options.metric != Metric::kPoint;
  if (has_normals)
    makeTargetNormals(options);
  const Sources sources = makeSources(options);
  output = *sources.cloud;
  if (sources.points.empty() || joint_->points.empty()) {
    IcpResult nothing;
    nothing.T_target_source = start;
    this->keep(nothing, Eigen::Vector3d::Zero());
    return this->moveOutput(output);
  }
  IcpTargetPart part;
  part.points = &joint_->points;
  part.normals = has_normals ? &joint_->normals : nullptr;
  part.search_k = [this](const Eigen::Vector3f& query, std::size_t k) {
    return joint_->nearestOfItsTarget(query, k);
  };
  IcpSource source{&sources.points, nullptr};
  if (options.metric == Metric::kGicp || options.symmetric)
    source.normals = &sources.normals;
  start.pretranslate(-joint_->origin);
  this->keep(icp({part}, source, start, options, hooks(sources, options)),
             joint_->origin);
  this->moveOutput(output);
}

template <typename PointSource, typename PointTarget, typename Scalar>
double
JointICP6D<PointSource, PointTarget, Scalar>::getFitnessScore(double max_range)
{
  requirePairs(this->options_);
  makeTarget(this->options_.num_threads);
  Eigen::Isometry3d T = this->result_.T_target_source;
  T.pretranslate(-joint_->origin);
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t pair = 0; pair < sources_.size(); ++pair)
    for (const auto& p : transformed(toPoints(*sources_[pair]), T)) {
      const Neighbour found =
          joint_->trees[pair]->nearest(p, std::numeric_limits<float>::infinity());
      const double square = static_cast<double>(found.distance_sq);
      if (found.index < 0 || square > max_range)
        continue;
      sum += square;
      ++count;
    }
  return count > 0 ? sum / static_cast<double>(count)
                   : std::numeric_limits<double>::max();
}

} // namespace pcl6d
