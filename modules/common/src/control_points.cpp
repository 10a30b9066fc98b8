// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/control_points.h>
#include <pcl6d/common/name_table.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
constexpr Named<ControlUse> kControlUses[] = {{ControlUse::kControl, "control"},
                                              {ControlUse::kCheck, "check"},
                                              {ControlUse::kRejected, "rejected"},
                                              {ControlUse::kUnused, "unused"}};
} // namespace

const char*
toString(ControlUse use)
{
  return nameOf(kControlUses, use);
}

ControlUse
controlUseFromName(const std::string& name)
{
  return fromName(kControlUses, "use of a control point", name, WordList::kOneOf);
}

std::optional<double>
ControlResult::rms(ControlUse use) const
{
  double sum = 0;
  std::size_t count = 0;
  for (const ControlResidual& one : residuals)
    if (one.use == use) {
      sum += one.residual.squaredNorm();
      ++count;
    }
  if (count == 0)
    return {};
  return std::sqrt(sum / static_cast<double>(count));
}

std::optional<double>
ControlResult::largest(ControlUse use) const
{
  std::optional<double> most;
  for (const ControlResidual& one : residuals)
    if (one.use == use)
      most = std::max(most.value_or(0), one.residual.norm());
  return most;
}

std::vector<std::string>
ControlResult::rejected() const
{
  std::vector<std::string> names;
  for (const ControlResidual& one : residuals)
    if (one.use == ControlUse::kRejected &&
        std::find(names.begin(), names.end(), one.name) == names.end())
      names.push_back(one.name);
  return names;
}

} // namespace pcl6d
