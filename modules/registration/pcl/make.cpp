// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/registration/pcl/make.h>

namespace pcl6d {

namespace registration {

namespace {
constexpr Named<RegistrationKind> kRegistrations[] = {
    {RegistrationKind::kPoint, "point"},
    {RegistrationKind::kPlane, "plane"},
    {RegistrationKind::kGicp, "gicp"},
    {RegistrationKind::kNdt, "ndt"},
    {RegistrationKind::kOverlap, "overlap"},
    {RegistrationKind::kFeatures, "features"}};
} // namespace

RegistrationKind
registrationKindFromName(const std::string& name)
{
  return fromName(kRegistrations, "registration", name);
}

void
refuseNoKdTree(SearchMethod method)
{
  throw BadArgument(std::string("search = ") + toString(method) +
                    ", but must be kdtree|cached-tree|remembered|approximate|flann: "
                    "pcl::Registration takes a k-d tree alone");
}

} // namespace registration

std::vector<std::string>
registrationNames()
{
  return namesOf(registration::kRegistrations);
}

#define PCL6D_MAKE_NOTHING_
PCL6D_FOR_POINT_TYPES(PCL6D_MAKE_ALL_, PCL6D_MAKE_NOTHING_)

} // namespace pcl6d
