// SPDX-License-Identifier: BSD-3-Clause
// Shows: code that was written for pcl::GeometricConsistencyGrouping or pcl::Hough3DGrouping
// gets the poses of an object by recognize(), without key points, descriptors and
// correspondences to make first. A stepped block on a table, seen by a camera.
#include <pcl6d/object_localization/pcl/object_localization.h>

#include <cstdio>

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

namespace {
/** A rectangle of points between a corner and two sides [m]. */
void
addSheet(Cloud& cloud,
         const Eigen::Vector3f& corner,
         const Eigen::Vector3f& a,
         const Eigen::Vector3f& b)
{
  constexpr float kSpacing = 0.004F; // [m]
  for (float u = 0; u <= a.norm(); u += kSpacing)
    for (float v = 0; v <= b.norm(); v += kSpacing) {
      const Eigen::Vector3f p = corner + u * a.normalized() + v * b.normalized();
      cloud.push_back(Point(p.x(), p.y(), p.z()));
    }
}

/** The faces of a stepped block that its front shows, in its own frame. */
Cloud::Ptr
block()
{
  const Eigen::Vector3f x = Eigen::Vector3f::UnitX(), y = Eigen::Vector3f::UnitY(),
                        z = Eigen::Vector3f::UnitZ();
  Cloud::Ptr cloud(new Cloud);
  addSheet(*cloud, {0, 0, 0.06F}, 0.08F * x, 0.2F * y);     // the step
  addSheet(*cloud, {0.08F, 0, 0.15F}, 0.1F * x, 0.12F * y); // the top
  addSheet(*cloud, {0.08F, 0, 0.06F}, 0.09F * z, 0.12F * y);
  addSheet(*cloud, {0, 0, 0}, 0.06F * z, 0.2F * y); // the front
  return cloud;
}
} // namespace

int
main()
{
  const Cloud::Ptr model = block();
  // The camera at the origin looks along x, down on a table; the block lies turned.
  Eigen::Isometry3f T_scene_model = Eigen::Isometry3f::Identity();
  T_scene_model.linear() =
      Eigen::AngleAxisf(0.3F, Eigen::Vector3f::UnitZ()).toRotationMatrix();
  T_scene_model.translation() << 0.8F, -0.1F, -0.35F;
  Cloud::Ptr scene(new Cloud);
  // the table, but for what the block hides
  addSheet(*scene, {0.5F, -0.7F, -0.352F}, {0.9F, 0, 0}, {0, 0.45F, 0});
  addSheet(*scene, {0.5F, 0.35F, -0.352F}, {0.9F, 0, 0}, {0, 0.45F, 0});
  for (const auto& point : *model) {
    const Eigen::Vector3f p = T_scene_model * point.getVector3fMap();
    scene->push_back(Point(p.x(), p.y(), p.z()));
  }

  pcl6d::ObjectLocalization<Point> recognition;
  recognition.setModelCloud(model, "block");
  recognition.setInputCloud(scene);
  pcl6d::ObjectTransformations found;
  recognition.recognize(found);

  std::printf("%zu found\n", found.size());
  if (found.size() != 1)
    return 1;
  const float error =
      (found[0].topRightCorner<3, 1>() - T_scene_model.translation()).norm();
  std::printf("%.2f mm off, %.0f %% of its face seen\n",
              1000 * error,
              100 * recognition.objects()[0].visible_fraction);
  const bool right = error < 0.002F;
  std::printf("%s\n", right ? "the block is found" : "not where the block is");
  return right ? 0 : 1;
}
