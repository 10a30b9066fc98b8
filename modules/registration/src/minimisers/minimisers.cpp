// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/require.h>
#include <pcl6d/registration/minimisers.h>

namespace pcl6d {

const std::vector<NamedMinimiser>&
namedMinimisers()
{
  static const std::vector<NamedMinimiser> all{
      {"svd", minimiseBySVD, minimiseBySVD},
      {"quaternion", minimiseByQuaternion, minimiseByQuaternion},
      {"orthonormal", minimiseByOrthonormal, minimiseByOrthonormal},
      {"dual-quaternion", minimiseByDualQuaternion, minimiseByDualQuaternion},
      {"scale-quaternion", minimiseByScaleQuaternion, minimiseByScaleQuaternion},
      {"helix", stepByHelix, minimiseByHelix},
      {"small-angle", stepBySmallAngle, minimiseBySmallAngle},
      {"euler", stepByEuler, minimiseByEuler},
      {"quaternion-linear", stepByQuaternionLinear, minimiseByQuaternionLinear}};
  return all;
}

std::vector<std::string>
minimiserNames()
{
  std::vector<std::string> names;
  for (const auto& minimiser : namedMinimisers())
    names.push_back(minimiser.name);
  return names;
}

RigidMinimiser
minimiserFromName(const std::string& name)
{
  std::string rule;
  for (const auto& minimiser : namedMinimisers()) {
    if (minimiser.name == name)
      return minimiser.step;
    rule += (rule.empty() ? "" : "|") + minimiser.name;
  }
  require(false, "minimiser", name, rule);
  return {};
}

} // namespace pcl6d
