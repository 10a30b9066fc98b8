// SPDX-License-Identifier: BSD-3-Clause
#include "stages.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>

#include <utility>

namespace pcl6d::slam6d {

namespace {
class UserStage : public Stage {
public:
  UserStage(std::shared_ptr<SlamStage> stage, SlamStage::Place place)
  : stage_(std::move(stage)), place_(place)
  {}

  bool
  isDue(const SlamState& state) const override
  {
    return place_ != SlamStage::Place::kAfterMatching ||
           (!state.isWithoutSequence() && state.improved < state.size());
  }

  StageEnd
  run(SlamState& state, SlamContext& context) override
  {
    std::vector<const Points*> scans;
    for (const IcpModel& model : state.scans.reduced())
      scans.push_back(&model.points());
    const std::size_t count = state.size();
    const SlamStage::Report report = stage_->run(
        scans, state.result, [&](const Progress& now) { context.report(now); });
    if (!report.accepted)
      return StageEnd::kReverted;
    check(report, count, state.result);
    auto& links = state.options.given_links;
    links.insert(links.end(), report.links.begin(), report.links.end());
    return StageEnd::kDone;
  }

private:
  void
  check(const SlamStage::Report& report, std::size_t count, const Slam6DResult& result)
  {
    const std::string who = "stage " + stage_->name() + ": ";
    if (result.scans.size() != count)
      throw BadArgument(who + "changed the number of scans");
    for (const ScanResult& scan : result.scans)
      if (!isRigid(scan.T_world_scan))
        throw BadArgument(who + "gave a scan a pose that is not a rigid motion");
    for (const auto& [from, to] : report.links)
      if (from >= count || to >= count || from == to)
        throw BadArgument(who + "links scans " + std::to_string(from) + " and " +
                          std::to_string(to) + ", but there are " +
                          std::to_string(count));
  }

  std::shared_ptr<SlamStage> stage_;
  SlamStage::Place place_;
};
} // namespace

StagePtr
userStage(std::shared_ptr<SlamStage> stage, SlamStage::Place place)
{
  return std::make_unique<UserStage>(std::move(stage), place);
}

} // namespace pcl6d::slam6d
