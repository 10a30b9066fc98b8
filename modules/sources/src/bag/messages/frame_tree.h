// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bag/messages/pose_messages.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::sources {

/** \brief Poses by time, interpolated between. */
class PoseSeries {
public:
  void
  add(std::int64_t time, const Eigen::Isometry3d& pose);

  bool
  empty() const
  {
    return samples_.empty();
  }

  /** Sorts by time; among poses of equal time the last is kept. */
  void
  finish();

  /** \return the pose: linear in position, by slerp in rotation; empty if the neighbouring poses
   * are more than 2 s apart, or more than 0.2 s outside of the series
   * \param[in] time [ns] */
  std::optional<Eigen::Isometry3d>
  at(std::int64_t time) const;

private:
  struct Sample {
    std::int64_t time = 0; ///< [ns]
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  };
  std::vector<Sample> samples_;
};

/** \brief The frames of a robot, each with parent and pose in the parent over time (tf). */
class FrameTree {
public:
  /** \param[in] path of the recording, for messages */
  explicit FrameTree(const std::filesystem::path& path) : path_(path) {}

  /** \param[in] time [ns], ignored for static poses */
  void
  add(const FramePose& pose, std::int64_t time, bool is_static);

  void
  finish();

  /** \return the frame, the parent and so on up to the root
   * \throws IoFailed the frames form a loop, or a frame has two parents */
  std::vector<std::string>
  chainFrom(const std::string& frame) const;

  /** \return whether any of the frames but the last moves in its parent */
  bool
  movesAlong(const std::vector<std::string>& chain) const;

  /** \return the pose of the first frame of a chain in the last; empty if a transform is missing
   * at the time [ns] */
  std::optional<Eigen::Isometry3d>
  poseAlong(const std::vector<std::string>& chain, std::int64_t time) const;

  /** \return the pose of a frame in a second frame of the tree; empty if a transform is missing
   * (poseAlong()), or without a common ancestor */
  std::optional<Eigen::Isometry3d>
  poseIn(const std::string& frame, const std::string& other, std::int64_t time) const;

private:
  struct Edge {
    std::string parent;
    std::string other_parent; ///< a second, contradictory parent; or empty
    std::optional<Eigen::Isometry3d> fixed;
    PoseSeries moving;
  };

  std::filesystem::path path_;
  std::map<std::string, Edge> edges_; ///< by child
};

} // namespace pcl6d::sources
