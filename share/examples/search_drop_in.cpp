// SPDX-License-Identifier: BSD-3-Clause
// Shows: pcl6d::KdTree wherever PCL expects a pcl::search::Search, here in
// pcl::NormalEstimation on points of a sphere, whose normals are known.
#include <pcl6d/search/pcl/kd_tree.h>

#include <pcl/features/normal_3d.h>

#include <cmath>
#include <cstdio>

using Point = pcl::PointXYZ;

// Even points on the unit sphere (Fibonacci lattice).
pcl::PointCloud<Point>::Ptr
makeSphere(int num_points)
{
  pcl::PointCloud<Point>::Ptr sphere(new pcl::PointCloud<Point>);
  const double golden_angle = M_PI * (3 - std::sqrt(5.0));
  for (int i = 0; i < num_points; ++i) {
    const double z = 1 - (2 * i + 1.0) / num_points;
    const double r = std::sqrt(1 - z * z);
    sphere->push_back(Point(static_cast<float>(r * std::cos(golden_angle * i)),
                            static_cast<float>(r * std::sin(golden_angle * i)),
                            static_cast<float>(z)));
  }
  return sphere;
}

int
main()
{
  const auto sphere = makeSphere(5000);

  pcl::NormalEstimation<Point, pcl::Normal> estimation;
  estimation.setSearchMethod(
      pcl::make_shared<pcl6d::KdTree<Point>>()); // the only change
  estimation.setInputCloud(sphere);
  estimation.setKSearch(12);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);

  // On the unit sphere the normal is the point itself, up to its sign.
  float worst_cosine = 1;
  for (std::size_t i = 0; i < sphere->size(); ++i) {
    const float cosine =
        std::abs(normals[i].getNormalVector3fMap().dot((*sphere)[i].getVector3fMap()));
    worst_cosine = std::fmin(worst_cosine, std::isfinite(cosine) ? cosine : 0);
  }
  const double worst = std::acos(worst_cosine) * 180 / M_PI;
  std::printf("%zu normals, the worst is %.2f deg off\n", normals.size(), worst);
  return worst < 2 ? 0 : 1;
}
