// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/options/moving_output.h"

#include <pcl6d/common/name_table.h>
#include <pcl6d/io/scan_fields.h>

#include <pcl/PCLPointField.h>

#include <limits>
#include <vector>

namespace pcl6d::app {

namespace {
constexpr const char* kField = "dynamic"; // 1: dynamic, 0: otherwise
}

Moving
movingFromName(const std::string& name)
{
  constexpr Named<Moving> kWords[] = {
      {Moving::kKeep, "keep"}, {Moving::kLabel, "label"}, {Moving::kRemove, "remove"}};
  return fromName(kWords, "word", name, WordList::kBars);
}

MovingOutput::MovingOutput(Moving policy, const Slam6D& slam)
: policy_(policy), slam_(slam)
{
  const auto& moving = slam.result().moving;
  if (policy == Moving::kKeep || !moving)
    return;
  result_.emplace();
  result_->points.assign(slam.result().scans.size(), 0);
  result_->removed = policy == Moving::kRemove;
  result_->blind = moving->blind;
  result_->background = moving->background;
  if (moving->evaluated > 0)
    result_->unknown =
        static_cast<double>(moving->unknown) / static_cast<double>(moving->evaluated);
}

MovingOutput::Parted
MovingOutput::apply(std::size_t scan, pcl::PCLPointCloud2& cloud)
{
  Parted parted;
  parted.standing = coordinatesOf(cloud);
  if (!result_)
    return parted;
  const std::vector<PointMotion> motion = slam_.motionOf(scan, parted.standing);
  std::vector<double> label(motion.size(), 0);
  std::vector<bool> stands(motion.size(), true);
  for (std::size_t p = 0; p < motion.size(); ++p)
    if (motion[p] == PointMotion::kDynamic) {
      label[p] = 1;
      stands[p] = false;
      parted.moving.push_back(parted.standing[p]);
      parted.standing[p].setConstant(std::numeric_limits<float>::quiet_NaN());
    }
  result_->points[scan] = parted.moving.size();
  if (policy_ == Moving::kLabel)
    storeField(cloud, kField, pcl::PCLPointField::UINT8, label);
  else if (!parted.moving.empty()) {
    keepPoints(cloud, stands);
    parted.standing = coordinatesOf(cloud);
  }
  return parted;
}

} // namespace pcl6d::app
