// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "doctor/peers/class_run.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/rotation.h>

#include <pcl/common/io.h>

#include <chrono>

namespace pcl6d::app {

/** \brief Exposes the iteration count, which is protected in PCL's base class. */
template <typename Class>
struct Counting : Class {
  int
  iterations() const
  {
    return this->nr_iterations_;
  }
};

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
cloudFor(const pcl::PointCloud<pcl::PointNormal>& cloud)
{
  auto copy = pcl::make_shared<pcl::PointCloud<PointT>>();
  pcl::copyPointCloud(cloud, *copy);
  return copy;
}

/** Accepts a pose if rigid within float precision. */
inline void
takePose(const Eigen::Matrix4d& matrix, ClassOutcome& out)
{
  const Eigen::Isometry3d pose(matrix);
  out.is_rigid = matrix.allFinite() && isRigid(pose);
  if (!out.is_rigid)
    return;
  out.pose = pose;
  out.pose.linear() = nearestRotation(pose.linear());
}

/** \brief The calls of every tutorial: input, align(), hasConverged(), getFitnessScore(). */
template <typename PointT, typename Class>
void
alignAsUser(Class& registration, const ClassInput& input, ClassOutcome& out)
{
  enterStage("setInputSource() or setInputTarget()");
  registration.setInputSource(cloudFor<PointT>(*input.source));
  registration.setInputTarget(cloudFor<PointT>(*input.target));
  if (input.indices)
    registration.setIndices(input.indices);
  pcl::PointCloud<PointT> aligned;
  enterStage("align()");
  const auto begin = std::chrono::steady_clock::now();
  registration.align(aligned, input.guess.matrix().cast<float>());
  const auto end = std::chrono::steady_clock::now();
  out.seconds = std::chrono::duration<double>(end - begin).count();
  out.converged = registration.hasConverged();
  out.iterations = registration.iterations();
  out.limit = registration.getMaximumIterations();
  out.at_limit = out.iterations >= out.limit;
  takePose(registration.getFinalTransformation().template cast<double>(), out);
  enterStage("getFitnessScore()");
  out.fitness = registration.getFitnessScore();
}

} // namespace pcl6d::app
