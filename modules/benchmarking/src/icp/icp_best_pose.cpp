// SPDX-License-Identifier: BSD-3-Clause
#include "icp/icp_best_pose.h"

#include <pcl6d/common/angle.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pcl6d::benchmarking {

namespace {
std::string
doubtOf(const IcpResult& best, const IcpBasinOptions& options)
{
  const double largest_rms = options.max_rms_share * options.icp.max_distance;
  std::ostringstream doubt; // read by people
  doubt.precision(3);
  if (best.status == Status::kRankDeficient)
    doubt << "the pairs do not fix the pose (" << toString(best.status) << ")";
  else if (best.status != Status::kOk)
    doubt << "ICP stopped: " << toString(best.stop);
  else if (best.overlap < options.min_overlap)
    doubt << "overlap " << best.overlap << " is less than " << options.min_overlap;
  else if (best.rms > largest_rms)
    doubt << "rms " << best.rms << " m means unrelated points (more than "
          << largest_rms << " m)";
  return doubt.str();
}

/** \return given, or the root of the summed variances of three of the six, at least min */
double
sigmaOf(const std::optional<double>& given,
        const std::optional<PoseCovariance>& covariance,
        int first,
        double min)
{
  if (given)
    return *given;
  if (!covariance)
    return min;
  const double variance = covariance->diagonal().segment<3>(first).sum();
  return std::max(std::sqrt(variance), min);
}

double
rootOfSquares(double a, double b)
{
  return std::sqrt(a * a + b * b);
}
} // namespace

IcpBestPose
evaluatedBestPose(Metric metric,
                  const IcpResult& result,
                  const IcpBasinOptions& options)
{
  IcpBestPose best;
  best.metric = metric;
  best.result = result;
  best.doubt = doubtOf(result, options);
  best.sigma_position =
      sigmaOf(options.sigma_position, result.covariance, 0, options.min_sigma_position);
  best.sigma_orientation = sigmaOf(
      options.sigma_orientation, result.covariance, 3, options.min_sigma_orientation);
  return best;
}

bool
isWithin(double sigmas, const IcpBestPose& best, const MotionSize& distance)
{
  return distance.translation <= sigmas * best.sigma_position &&
         distance.rotation <= sigmas * best.sigma_orientation;
}

std::string
doubtOfReturn(const IcpBestPose& best,
              const IcpResult& again,
              const IcpBasinOptions& options)
{
  const MotionSize distance =
      distanceBetween(best.result.T_target_source, again.T_target_source);
  if (isWithin(options.sigmas, best, distance))
    return "";
  std::ostringstream doubt;
  doubt.precision(3);
  doubt << "ICP started in the pose found leaves it by " << distance.translation
        << " m and " << degrees(distance.rotation) << " deg";
  return doubt.str();
}

std::vector<IcpDisagreement>
disagreementsOf(const std::vector<IcpBestPose>& best, const IcpBasinOptions& options)
{
  std::vector<IcpDisagreement> found;
  for (auto a = best.begin(); a != best.end(); ++a)
    for (auto b = a + 1; b != best.end(); ++b) {
      if (!a->doubt.empty() || !b->doubt.empty())
        continue;
      IcpBestPose both = *a; // the sigma of the difference of two poses
      both.sigma_position = rootOfSquares(a->sigma_position, b->sigma_position);
      both.sigma_orientation =
          rootOfSquares(a->sigma_orientation, b->sigma_orientation);
      const MotionSize distance =
          distanceBetween(a->result.T_target_source, b->result.T_target_source);
      if (!isWithin(options.disagreement_sigmas, both, distance))
        found.push_back({a->metric, b->metric, distance});
    }
  return found;
}

} // namespace pcl6d::benchmarking
