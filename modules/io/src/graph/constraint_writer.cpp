// SPDX-License-Identifier: BSD-3-Clause
#include "graph/constraint_rows.h"

namespace pcl6d::io {

namespace {
void
appendConstraintNumbers(std::string& text, std::initializer_list<double> numbers)
{
  for (const double number : numbers) {
    text += ' ';
    text::appendNumber(text, number);
  }
}

void
appendConstraintVector(std::string& text, const Eigen::Vector3d& v)
{
  appendConstraintNumbers(text, {v.x(), v.y(), v.z()});
}
} // namespace

void
appendConstraints(std::string& text,
                  const GraphConstraints& constraints,
                  const std::vector<std::size_t>& ids)
{
  const auto idOf = [&](std::size_t pose) {
    return std::to_string(ids.empty() ? pose : ids[pose]);
  };
  if (!constraints.priors.empty() || !constraints.sightings.empty())
    text += "PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n";
  for (std::size_t k = 0; k < constraints.landmarks.size(); ++k) {
    text += "VERTEX_TRACKXYZ " + std::to_string(constraints.landmark_ids[k]);
    appendConstraintVector(text, constraints.landmarks[k]);
    text += '\n';
  }
  for (const LandmarkSighting& sighting : constraints.sightings) {
    text += "EDGE_SE3_TRACKXYZ " + idOf(sighting.pose) + " " +
            std::to_string(constraints.landmark_ids[sighting.landmark]) + " 0";
    appendConstraintVector(text, sighting.position);
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        appendConstraintNumbers(text, {sighting.information(i, j)});
    text += '\n';
  }
  const GraphTag& tag = constraintTag("EDGE_SE3_PRIOR")->row;
  for (const PosePrior& prior : constraints.priors) {
    text.append(tag.name).append(" ").append(idOf(prior.pose)).append(" 0");
    appendPose(text, tag, prior.T_world_pose);
    appendInformation(text, tag, prior.information);
    text += '\n';
  }
  for (const LinkSwitch& one : constraints.switches) {
    text += "VERTEX_SWITCH " + std::to_string(one.id);
    appendConstraintNumbers(text, {one.value});
    text += "\nEDGE_SWITCH_PRIOR " + std::to_string(one.id);
    appendConstraintNumbers(text, {one.prior, one.information});
    text += '\n';
  }
}

} // namespace pcl6d::io
