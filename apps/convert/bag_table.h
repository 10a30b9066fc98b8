// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/options/bag_options.h"
#include "common/options/option_table.h"

#include <pcl6d/io/bag_options.h>

namespace pcl6d::app {

/** \brief Adds the options of a recording to a table. */
inline void
addBagOptions(OptionTable& table, BagOptions& bag)
{
  table.add("topic NAME", &bag.topic).help(kTopicHelp);
  table.add("odometry TOPIC", &bag.odometry).help(kOdometryHelp);
  table.add("imu TOPIC", &bag.imu).help(kImuHelp);
  table.add("time NAME", &bag.time, bagTimeFromName).help(kTimeHelp);
}

} // namespace pcl6d::app
