// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/visualization/image.h>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Shapes drawn over the points of a picture, in the world [m].
 * \ingroup visualization */
struct Overlay {
  struct Line {
    std::vector<Eigen::Vector3d> points; ///< joined in order
    Colour colour{};
    double width = 2; ///< [px] on a picture of usual size
  };
  /** \brief A filled circle. */
  struct Mark {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    Colour colour{};
    double size = 8; ///< [px] diameter on a picture of usual size
  };
  struct Text {
    Eigen::Vector3d place = Eigen::Vector3d::Zero(); ///< the text's middle
    std::string text;
    Colour colour{};
  };
  /** \brief An entry of the legend. */
  struct Key {
    std::string text;
    Colour colour{};
  };

  /** later lines over earlier lines; likewise for other shapes */
  std::vector<Line> lines;
  std::vector<Mark> marks; ///< over lines
  std::vector<Text> texts; ///< over marks
  std::vector<Key> keys;

  /** \brief Appends the content of another overlay. */
  void
  append(const Overlay& other);
};

} // namespace pcl6d
