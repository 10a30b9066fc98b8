// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "graph_problem.h"

namespace pcl6d {

/** \brief Where the search for the minimum of a part of a graph ended. */
struct GraphDescent {
  GraphProblem::Poses poses;
  std::vector<double> squared_errors; ///< of each link of the part
  std::vector<double> weights;        ///< of each link
  double chi2_before = 0;
  double chi2_after = 0;
  int iterations = 0;
  Status status = Status::kOk;
};

/** \brief Minimises a problem from the given poses. Internal to the module
 * graph_relaxation. */
GraphDescent
descend(GraphProblem& problem,
        const GraphProblem::Poses& poses,
        const PoseGraphOptions& options);

} // namespace pcl6d
