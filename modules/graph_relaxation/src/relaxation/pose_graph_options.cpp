// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>

#include <cmath>

namespace pcl6d {

namespace {
constexpr GraphMethod kMethods[] = {GraphMethod::kGaussNewton,
                                    GraphMethod::kLevenbergMarquardt};
} // namespace

const char*
toString(GraphMethod method)
{
  return method == GraphMethod::kGaussNewton ? "gauss-newton" : "levenberg-marquardt";
}

std::vector<std::string>
graphMethodNames()
{
  std::vector<std::string> names;
  for (const GraphMethod method : kMethods)
    names.emplace_back(toString(method));
  return names;
}

GraphMethod
graphMethodFromName(const std::string& name)
{
  std::string all;
  for (const GraphMethod method : kMethods) {
    if (name == toString(method))
      return method;
    all += (all.empty() ? "" : ", ") + std::string(toString(method));
  }
  throw BadArgument("method = " + name + ", but must be one of " + all);
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
