// SPDX-License-Identifier: BSD-3-Clause
// Shows: a stage of one's own in a run of Slam6D. A loop detector that links each scan with the
// first one once the robot is back near it; the relaxation then counts these links as given ones.
#include "synthetic.h"

#include <pcl6d/slam6d/slam6d.h>

#include <cstdio>
#include <memory>
#include <vector>

class BackAtStart : public pcl6d::SlamStage {
public:
  std::string
  name() const override
  {
    return "back at start";
  }

  Report
  run(const std::vector<const pcl6d::Points*>& scans,
      pcl6d::Slam6DResult& result,
      const pcl6d::ProgressCallback& report) override
  {
    const double near = 1; // [m]
    Report found;
    for (std::size_t i = 4; i < scans.size(); ++i) {
      report({name(), i, scans.size()});
      const auto apart = pcl6d::distanceBetween(result.scans[0].T_world_scan,
                                                result.scans[i].T_world_scan);
      if (apart.translation < near)
        found.links.emplace_back(0, i);
    }
    std::printf("%s: %zu links\n", name().c_str(), found.links.size());
    return found;
  }
};

int
main()
{
  pcl6d::Slam6D slam;
  slam.addStage(std::make_shared<BackAtStart>(),
                pcl6d::SlamStage::Place::kAfterMatching);
  const Eigen::Isometry3d drift =
      pcl6d::poseFromEuler({0.03, -0.02, 0.02}, {0.005, -0.005, 0.01});
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity(), odometry = truth;
  for (int i = 0; i < 12; ++i) { // six steps there, six back
    slam.addScan(scanRoom(truth), odometry);
    const Eigen::Isometry3d step = pcl6d::poseFromEuler({i < 6 ? 0.4 : -0.4, 0, 0}, {});
    truth = truth * step;
    odometry = odometry * step * drift;
  }
  slam.optimize();

  std::size_t given = 0; // links of the stage that the relaxation used
  for (const pcl6d::ScanLink& link : slam.result().links)
    given += link.kind == pcl6d::LinkKind::kGiven &&
             link.verdict == pcl6d::LinkVerdict::kUsed;
  std::printf("%zu of them used by the relaxation\n", given);
  return slam.result().trusted() && given > 0 ? 0 : 1;
}
