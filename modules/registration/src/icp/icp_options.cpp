// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/registration/icp_options.h>

#include <cmath>

namespace pcl6d {

namespace {
constexpr Named<Metric> kMetrics[] = {{Metric::kPoint, "point"},
                                      {Metric::kPlane, "plane"},
                                      {Metric::kGicp, "gicp"}};
constexpr Named<RobustKernel> kKernels[] = {
    {RobustKernel::kNone, "none"},
    {RobustKernel::kHuber, "huber"},
    {RobustKernel::kCauchy, "cauchy"},
    {RobustKernel::kGemanMcClure, "geman-mcclure"}};
} // namespace

std::vector<std::string>
metricNames()
{
  return namesOf(kMetrics);
}

Metric
metricFromName(const std::string& name)
{
  return fromName(kMetrics, "metric", name);
}

const char*
toString(Metric metric)
{
  return nameOf(kMetrics, metric);
}

std::vector<std::string>
robustKernelNames()
{
  return namesOf(kKernels);
}

RobustKernel
robustKernelFromName(const std::string& name)
{
  return fromName(kKernels, "robust", name);
}

const char*
toString(RobustKernel kernel)
{
  return nameOf(kKernels, kernel);
}

double
robustWeight(RobustKernel kernel, double residual)
{
  const auto square = [](double x) { return x * x; };
  switch (kernel) {
  case RobustKernel::kHuber: // constants: 95 % efficiency on normal residuals
    return residual <= 1.345 ? 1 : 1.345 / residual;
  case RobustKernel::kCauchy:
    return 1 / (1 + square(residual / 2.385));
  case RobustKernel::kGemanMcClure:
    return 1 / square(1 + square(residual / 2));
  case RobustKernel::kNone:
    break;
  }
  return 1;
}

void
IcpOptions::validate() const
{
  require(
      gicp_epsilon > 0 && gicp_epsilon <= 1, "gicp_epsilon", gicp_epsilon, "in (0, 1]");
  require(max_iterations > 0, "max_iterations", max_iterations, "> 0");
  require(max_distance > 0, "max_distance", max_distance, "> 0");
  require(max_distance_start >= 0 && std::isfinite(max_distance_start),
          "max_distance_start",
          max_distance_start,
          "finite and >= 0");
  require(distance_decay > 0 && distance_decay < 1,
          "distance_decay",
          distance_decay,
          "in (0, 1)");
  require(shrinking_stride > 0, "shrinking_stride", shrinking_stride, "> 0");
  require(!estimate_scale || metric == Metric::kPoint,
          "estimate_scale",
          "true",
          "false for the metrics with planes: the minimisers have no scale");
  require(!symmetric || metric == Metric::kPlane,
          "symmetric",
          "true",
          "false but for the metric plane");
  require(max_scale > 1, "max_scale", max_scale, "> 1");
  require(kept_share > 0 && kept_share <= 1, "kept_share", kept_share, "in (0, 1]");
  require(translation_epsilon >= 0, "translation_epsilon", translation_epsilon, ">= 0");
  require(rotation_epsilon >= 0, "rotation_epsilon", rotation_epsilon, ">= 0");
  require(error_epsilon >= 0 && error_epsilon < 1,
          "error_epsilon",
          error_epsilon,
          "in [0, 1)");
  require(minimiser != nullptr, "minimiser", "none", "a function");
  require(plane_minimiser != nullptr, "plane_minimiser", "none", "a function");
}

} // namespace pcl6d
