// SPDX-License-Identifier: BSD-3-Clause
#include "plane_methods.h"

#include <pcl6d/plane_segmentation/segment_planes.h>

#include <pcl/features/normal_3d.h>
#include <pcl/filters/extract_indices.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/region_growing.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <Eigen/Eigenvalues>

#include <chrono>
#include <cmath>

namespace pcl6d::benchmarks {

namespace {
using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Clock = std::chrono::steady_clock;
constexpr std::size_t kMinPoints = 100;
constexpr double kMaxDistance = 0.03; // [m] of pcl::SACSegmentation

FoundPlanes
findOurs(const Points& points,
         PlaneMethod method,
         HoughVariant variant,
         unsigned threads)
{
  const auto start = Clock::now();
  PlaneSegmentationOptions options;
  options.hough.variant = variant;
  const auto segments = segmentPlanes(PlaneCloud(points, threads), method, options);
  FoundPlanes found;
  found.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  found.numbers.assign(points.size(), 0);
  for (const auto& segment : segments.planes) {
    found.planes.push_back(segment.plane);
    for (const auto i : segment.points)
      found.numbers[i] = static_cast<std::uint32_t>(found.planes.size());
  }
  return found;
}

/** The finite points, as PCL's classes want them, and their places. */
struct Finite {
  Cloud::Ptr cloud = pcl::make_shared<Cloud>();
  std::vector<std::uint32_t> places{};

  explicit Finite(const Points& points)
  {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i].allFinite()) {
        cloud->emplace_back(points[i].x(), points[i].y(), points[i].z());
        places.push_back(static_cast<std::uint32_t>(i));
      }
  }
};

/** \return the plane of least squares */
Plane
fitted(const Cloud& cloud, const pcl::Indices& indices)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto i : indices)
    mean +=
        cloud[i].getVector3fMap().cast<double>() / static_cast<double>(indices.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto i : indices) {
    const Eigen::Vector3d d = cloud[i].getVector3fMap().cast<double>() - mean;
    scatter += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  Plane plane;
  plane.normal = solver.eigenvectors().col(0);
  plane.offset = plane.normal.dot(mean);
  orientPlane(plane);
  return plane;
}

void
addPlane(FoundPlanes& found, const Finite& finite, const pcl::Indices& indices)
{
  found.planes.push_back(fitted(*finite.cloud, indices));
  for (const auto i : indices)
    found.numbers[finite.places[static_cast<std::size_t>(i)]] =
        static_cast<std::uint32_t>(found.planes.size());
}

/** One plane after the other until the next one is small. */
std::vector<pcl::Indices>
planesOfSac(const Cloud::Ptr& cloud)
{
  pcl::SACSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setOptimizeCoefficients(true);
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setMaxIterations(100);
  segmentation.setDistanceThreshold(kMaxDistance);
  segmentation.setInputCloud(cloud);
  auto left = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < cloud->size(); ++i)
    left->push_back(static_cast<pcl::index_t>(i));
  std::vector<pcl::Indices> planes;
  while (left->size() > cloud->size() / 100) {
    segmentation.setIndices(left);
    pcl::PointIndices inliers;
    pcl::ModelCoefficients coefficients;
    segmentation.segment(inliers, coefficients);
    if (inliers.indices.size() < cloud->size() / 200)
      break;
    std::vector<char> taken(cloud->size(), 0);
    for (const auto i : inliers.indices)
      taken[static_cast<std::size_t>(i)] = 1;
    auto rest = pcl::make_shared<pcl::Indices>();
    for (const auto i : *left)
      if (!taken[static_cast<std::size_t>(i)])
        rest->push_back(i);
    left = rest;
    planes.push_back(inliers.indices);
  }
  return planes;
}

FoundPlanes
findBySac(const Points& points, unsigned int)
{
  const Finite finite(points);
  const auto start = Clock::now();
  const auto planes = planesOfSac(finite.cloud);
  FoundPlanes found;
  found.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  found.numbers.assign(points.size(), 0);
  for (const auto& indices : planes)
    addPlane(found, finite, indices);
  return found;
}

FoundPlanes
findByRegionGrowing(const Points& points, unsigned int)
{
  const Finite finite(points);
  const auto start = Clock::now();
  const auto tree = pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  const auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setSearchMethod(tree);
  estimation.setInputCloud(finite.cloud);
  estimation.setKSearch(30);
  estimation.compute(*normals);
  pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
  growing.setMinClusterSize(static_cast<pcl::index_t>(kMinPoints));
  growing.setSearchMethod(tree);
  growing.setNumberOfNeighbours(30);
  growing.setInputCloud(finite.cloud);
  growing.setInputNormals(normals);
  growing.setSmoothnessThreshold(static_cast<float>(3 * M_PI / 180));
  growing.setCurvatureThreshold(1);
  std::vector<pcl::PointIndices> clusters;
  growing.extract(clusters);
  FoundPlanes found;
  found.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  found.numbers.assign(points.size(), 0);
  for (const auto& cluster : clusters)
    addPlane(found, finite, cluster.indices);
  return found;
}

PlaneMethodCase
ours(const std::string& name, PlaneMethod method, HoughVariant variant = {})
{
  return {name, [=](const Points& points, unsigned int threads) {
            return findOurs(points, method, variant, threads);
          }};
}
} // namespace

std::vector<PlaneMethodCase>
ourPlaneMethods()
{
  return {
      ours("region-growing", PlaneMethod::kRegionGrowing),
      ours("ransac", PlaneMethod::kRansac),
      ours("hough-randomized", PlaneMethod::kHough, HoughVariant::kRandomized),
      ours("hough-probabilistic", PlaneMethod::kHough, HoughVariant::kProbabilistic),
      ours("hough-standard", PlaneMethod::kHough, HoughVariant::kStandard),
      ours("hough-adaptive", PlaneMethod::kHough, HoughVariant::kAdaptive),
      ours("hough-progressive", PlaneMethod::kHough, HoughVariant::kProgressive)};
}

std::vector<PlaneMethodCase>
peerPlaneMethods()
{
  return {{"pcl::SACSegmentation", findBySac},
          {"pcl::RegionGrowing", findByRegionGrowing}};
}

} // namespace pcl6d::benchmarks
