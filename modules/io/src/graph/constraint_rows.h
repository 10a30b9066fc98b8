// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "graph/pose_graph_row.h"

#include <pcl6d/common/graph_constraints.h>

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

/** \file Rows of g2o files that constrain poses: sensor offsets, landmarks, priors, switches. */
namespace pcl6d::io {

enum class ConstraintKind {
  kLandmark,
  kSighting,
  kPrior,
  kPlanarPrior,
  kPositionPrior, ///< x y of a planar pose
  kSwitch,
  kSwitchPrior,
  kSwitchedLink
};

struct ConstraintTag {
  GraphTag row;
  ConstraintKind kind;
};

/** \return the tag by name, nullptr if unknown */
const ConstraintTag*
constraintTag(std::string_view name);

/** \brief The constraints of a file, with ids instead of indices. */
class ConstraintRows {
public:
  using Index = std::unordered_map<std::size_t, std::size_t>; // from id to vertex

  /** \brief Reads the rest of a line PARAMS_SE3OFFSET. \throws IoFailed naming file and line */
  void
  addOffset(const std::filesystem::path& path,
            const text::Lines& lines,
            text::Tokens& tokens);

  /** \param[in] link index of the link of a kSwitchedLink
   * \throws IoFailed the numbers are not a valid constraint */
  void
  add(const std::filesystem::path& path,
      ConstraintKind kind,
      const GraphRow& row,
      std::size_t link);

  /** \param[in] poses of the file, by their ids
   * \throws IoFailed naming file and line: a repeated id, a row with an unknown vertex id, a
   * landmark without observations, a switch without a prior or of several links */
  GraphConstraints
  resolved(const std::filesystem::path& path, const Index& poses) const;

private:
  struct Row {
    GraphRow row;
    ConstraintKind kind;
    std::size_t link;
  };
  using Lines = std::unordered_map<std::size_t, std::size_t>; // from id to line

  Eigen::Isometry3d
  offsetOf(const std::filesystem::path& path,
           const GraphRow& row,
           std::size_t id) const;
  void
  addLandmarks(const std::filesystem::path& path,
               const Index& poses,
               GraphConstraints& found) const;
  void
  addPriors(const std::filesystem::path& path,
            const Index& poses,
            GraphConstraints& found) const;
  void
  addSwitches(const std::filesystem::path& path,
              const Index& poses,
              GraphConstraints& found) const;

  std::map<std::size_t, Eigen::Isometry3d> offsets_;
  std::vector<Row> rows_;
};

/** \brief Appends the rows of landmarks, priors and switches, for a sensor at the pose.
 * \param[in] ids of the poses; empty: 0, 1, ... */
void
appendConstraints(std::string& text,
                  const GraphConstraints& constraints,
                  const std::vector<std::size_t>& ids);

} // namespace pcl6d::io
