// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/common/require.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>

#include <cmath>

namespace pcl6d {

namespace {
constexpr Named<GraphMethod> kMethods[] = {
    {GraphMethod::kGaussNewton, "gauss-newton"},
    {GraphMethod::kLevenbergMarquardt, "levenberg-marquardt"}};
} // namespace

const char*
toString(GraphMethod method)
{
  return nameOf(kMethods, method);
}

std::vector<std::string>
graphMethodNames()
{
  return namesOf(kMethods);
}

GraphMethod
graphMethodFromName(const std::string& name)
{
  return fromName(kMethods, "method", name, WordList::kOneOf);
}

void
PoseGraphOptions::validate() const
{
  require(robust_width > 0 && std::isfinite(robust_width),
          "robust_width",
          robust_width,
          "> 0");
  require(max_iterations > 0, "max_iterations", max_iterations, "> 0");
  require(chi2_epsilon >= 0 && chi2_epsilon < 1,
          "chi2_epsilon",
          chi2_epsilon,
          ">= 0 and < 1");
}

} // namespace pcl6d
