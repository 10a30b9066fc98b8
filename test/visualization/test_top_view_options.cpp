// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/visualization/top_view.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::BadArgument;
using pcl6d::TopView;
using pcl6d::TopViewOptions;

TEST(TopViewOptions, RefuseAbsurdValuesNamingTheField)
{
  const auto refuses = [](const std::string& field, auto change) {
    TopViewOptions options;
    change(options);
    try {
      TopView view(options);
      ADD_FAILURE() << field << " accepted";
    } catch (const BadArgument& e) {
      EXPECT_EQ(std::string(e.what()).rfind(field + " = ", 0), 0u) << e.what();
    }
  };
  refuses("width", [](auto& o) { o.width = 100; });
  refuses("width", [](auto& o) { o.width = 100000; });
  refuses("height", [](auto& o) { o.height = -1; });
  refuses("margin", [](auto& o) { o.margin = -1; });
  refuses("margin", [](auto& o) { o.margin = 800; });
  refuses("point_size", [](auto& o) { o.point_size = 0; });
  refuses("max_points", [](auto& o) { o.max_points = 0; });
  refuses("max_height", [](auto& o) { o.cut.max_height = std::nan(""); });
  refuses("above_trajectory", [](auto& o) { o.cut.above_trajectory = INFINITY; });
  refuses("thickness", [](auto& o) { o.cut.slice = {1.0, 0.0}; });
  refuses("area", [](auto& o) { o.area.emplace(); });
  refuses("shading", [](auto& o) { o.shading = -1; });
}
