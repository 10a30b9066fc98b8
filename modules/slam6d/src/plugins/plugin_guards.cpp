// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/plugin_guards.h"

#include <pcl6d/common/error.h>

#include <cmath>
#include <memory>
#include <new>
#include <utility>

namespace pcl6d::slam6d {

namespace {
/** Tolerance of a rotation computed in float: several rounding errors. */
constexpr double kRigid = 1e-5;

/** \return the result of the call */
template <typename Call>
auto
named(const std::string& who, Call&& call)
{
  try {
    return call();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw ComputeFailed(who + ": " + e.what());
  } catch (...) {
    throw ComputeFailed(who + ": threw an object that is no std::exception");
  }
}

bool
isRigid(const Eigen::Isometry3d& T)
{
  const Eigen::Matrix3d R = T.linear();
  return T.matrix().allFinite() && R.determinant() > 0 &&
         (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <
             kRigid;
}

/** Guard of a minimiser, over pairs of points or of points and planes. */
template <typename Sums>
std::function<RigidEstimate(const Sums&)>
guardedStep(const std::string& who, std::function<RigidEstimate(const Sums&)> step)
{
  return [who, step = std::move(step)](const Sums& sums) {
    const RigidEstimate found = named(who, [&] { return step(sums); });
    if (!isRigid(found.transform))
      throw ComputeFailed(who + ": returned a matrix that is no rigid motion");
    return found;
  };
}
} // namespace

RigidMinimiser
guarded(const std::string& who, RigidMinimiser step)
{
  return guardedStep<PairSums>(who, std::move(step));
}

PlaneMinimiser
guarded(const std::string& who, PlaneMinimiser step)
{
  return guardedStep<PlaneSums>(who, std::move(step));
}

SearchMaker
guarded(const std::string& who, SearchMaker search)
{
  return [who, search = std::move(search)](const Points& points) -> NearestSearch {
    NearestSearch nearest = named(who, [&] { return search(points); });
    if (!nearest)
      throw ComputeFailed(who + ": made no search");
    return [who, nearest = std::move(nearest), own = std::make_shared<Points>(points)](
               const Eigen::Vector3f& query, float limit_sq) {
      const Neighbour found = named(who, [&] { return nearest(query, limit_sq); });
      if (found.index < 0)
        return Neighbour();
      if (static_cast<std::size_t>(found.index) >= own->size())
        throw ComputeFailed(who + ": found point " + std::to_string(found.index) +
                            " of " + std::to_string(own->size()));
      const auto place = static_cast<std::size_t>(found.index);
      const Neighbour checked{found.index, distanceSq(query, (*own)[place])};
      return checked.distance_sq < limit_sq ? checked : Neighbour();
    };
  };
}

ScanFilter
guarded(const std::string& who, ScanFilter filter)
{
  return [who, filter = std::move(filter)](const pcl::PCLPointCloud2& cloud) {
    return named(who, [&] { return filter(cloud); });
  };
}

ScanReader
guarded(const std::string& who, ScanReader reader)
{
  return [who, reader = std::move(reader)](const std::filesystem::path& file) {
    return named(who, [&] { return reader(file); });
  };
}

} // namespace pcl6d::slam6d
