// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "relaxation/pose_graph_problem.h"

namespace pcl6d::graph_relaxation {

/** \brief Where the search for the minimum of a part of a graph ended. */
struct GraphDescent {
  PoseGraphProblem::Poses poses;
  std::vector<double> squared_errors; ///< of each link of the part
  std::vector<double> weights;        ///< of each link
  double chi2_before = 0;
  double chi2_after = 0;
  int iterations = 0;
  Status status = Status::kOk;
};

/** \brief Minimises a problem from the given poses. */
GraphDescent
descend(PoseGraphProblem& problem,
        const PoseGraphProblem::Poses& poses,
        const PoseGraphOptions& options);

} // namespace pcl6d::graph_relaxation
