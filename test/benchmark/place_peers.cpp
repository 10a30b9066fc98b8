// SPDX-License-Identifier: BSD-3-Clause
#include "place_peers.h"

#include <pcl6d/registration/feature_alignment.h>

#include <pcl/console/print.h>
#include <pcl/features/fpfh.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/keypoints/harris_3d.h>
#include <pcl/point_types.h>
#include <pcl/registration/ia_fpcs.h>
#include <pcl/registration/ia_kfpcs.h>
#include <pcl/registration/sample_consensus_prerejective.h>
#include <pcl/search/kdtree.h>

#include <cstdlib>
#include <ctime>
#include <stdexcept>

namespace pcl6d::bench {

namespace {
using Point = pcl::PointNormal;
using Cloud = pcl::PointCloud<Point>;
using Features = pcl::PointCloud<pcl::FPFHSignature33>;

/** [voxels] The leaf of the peers: with 1 features are too small for rooms (no pair of 8 is
 * found), and a pair takes four times as long. */
constexpr float kLeaf = 2;

/** [leaves] As PCL's tutorial on alignment has them: normals 2, features 5, inliers 2.5; key
 * points 5. */
constexpr float kNormals = 2, kFeatures = 5, kInliers = 2.5f, kKeyPoints = 5;
constexpr int kDraws = 50000;
constexpr float kInlierShare = 0.25f, kOverlap = 0.5f;
constexpr int kSeconds = 5, kSamples = 500;

Cloud::Ptr
cloudOf(const Points& points)
{
  const auto cloud = pcl::make_shared<Cloud>();
  for (const auto& p : points) {
    Point one;
    one.getVector3fMap() = p;
    cloud->push_back(one);
  }
  return cloud;
}

Eigen::Isometry3d
poseOf(const Eigen::Matrix4f& matrix)
{
  return Eigen::Isometry3d(matrix.cast<double>());
}

/** Runs a class of pcl::Registration that has all but its clouds. */
PeerPlace
aligned(pcl::Registration<Point, Point>& method,
        const Cloud::ConstPtr& target,
        const Cloud::ConstPtr& source)
{
  method.setInputTarget(target);
  method.setInputSource(source);
  Cloud moved;
  method.align(moved);
  PeerPlace place;
  place.accepted = method.hasConverged();
  place.T_first_second = poseOf(method.getFinalTransformation());
  return place;
}

template <typename Sets>
PeerPlace
byFourPoints(Sets& sets, const Cloud::ConstPtr& target, const Cloud::ConstPtr& source)
{
  if (target->size() < 10 ||
      source->size() < 10) // it reads candidates that are not there
    return {};
  sets.setApproxOverlap(kOverlap);
  sets.setMaxComputationTime(kSeconds);
  sets.setNumberOfThreads(1);
  return aligned(sets, target, source);
}
} // namespace

double
secondsOfProcessor()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct PlacePeers::Scan {
  Cloud::Ptr points;
  Features::Ptr features = pcl::make_shared<Features>();
  Cloud::Ptr key_points;
  double seconds = 0;

  Scan(const Points& measured, float leaf)
  {
    const auto start = secondsOfProcessor();
    pcl::VoxelGrid<Point> grid;
    grid.setLeafSize(leaf, leaf, leaf);
    grid.setInputCloud(cloudOf(measured));
    points = pcl::make_shared<Cloud>();
    grid.filter(*points);
    const auto tree = pcl::make_shared<pcl::search::KdTree<Point>>();
    pcl::NormalEstimation<Point, Point> normals;
    normals.setInputCloud(points);
    normals.setSearchMethod(tree);
    normals.setRadiusSearch(kNormals * leaf);
    normals.compute(*points);
    withoutNan();
    pcl::FPFHEstimation<Point, Point> estimation;
    estimation.setInputCloud(points);
    estimation.setInputNormals(points);
    estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<Point>>());
    estimation.setRadiusSearch(kFeatures * leaf);
    estimation.compute(*features);
    findKeyPoints(leaf);
    seconds = secondsOfProcessor() - start;
  }

private:
  void
  withoutNan()
  {
    const auto kept = pcl::make_shared<Cloud>();
    for (const auto& p : *points)
      if (p.getNormalVector3fMap().allFinite())
        kept->push_back(p);
    points = kept;
  }

  void
  findKeyPoints(float leaf)
  {
    pcl::HarrisKeypoint3D<Point, pcl::PointXYZI, Point> harris;
    harris.setInputCloud(points);
    harris.setNormals(points);
    harris.setRadius(kKeyPoints * leaf);
    harris.setNonMaxSupression(true);
    harris.setNumberOfThreads(1);
    pcl::PointCloud<pcl::PointXYZI> found;
    harris.compute(found);
    key_points = pcl::make_shared<Cloud>();
    for (const auto& p : found) {
      Point one;
      one.getVector3fMap() = p.getVector3fMap();
      key_points->push_back(one);
    }
  }
};

PlacePeers::PlacePeers(const LinkSet& set) : set_(set), scans_(set.scans.size())
{
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
}

PlacePeers::~PlacePeers() = default;

const std::vector<std::string>&
PlacePeers::names()
{
  static const std::vector<std::string> all = {
      "prerejective", "fpcs", "kfpcs", "features"};
  return all;
}

const PlacePeers::Scan&
PlacePeers::scan(std::size_t i)
{
  if (!scans_[i])
    scans_[i] = std::make_unique<Scan>(set_.measured[i],
                                       kLeaf * static_cast<float>(set_.voxel));
  return *scans_[i];
}

double
PlacePeers::secondsOfScan() const
{
  double sum = 0;
  int count = 0;
  for (const auto& one : scans_)
    if (one) {
      sum += one->seconds;
      ++count;
    }
  return count > 0 ? sum / count : 0;
}

PeerPlace
PlacePeers::place(const std::string& name, std::size_t first, std::size_t second)
{
  const Scan& target = scan(first);
  const Scan& source = scan(second);
  const auto leaf = kLeaf * static_cast<float>(set_.voxel);
  std::srand(1); // PCL draws by it
  const auto start = secondsOfProcessor();
  PeerPlace place;
  if (name == "prerejective") {
    pcl::SampleConsensusPrerejective<Point, Point, pcl::FPFHSignature33> method;
    method.setTargetFeatures(target.features);
    method.setSourceFeatures(source.features);
    method.setMaximumIterations(kDraws);
    method.setNumberOfSamples(3);
    method.setCorrespondenceRandomness(5);
    method.setSimilarityThreshold(0.9f);
    method.setMaxCorrespondenceDistance(kInliers * leaf);
    method.setInlierFraction(kInlierShare);
    place = aligned(method, target.points, source.points);
  }
  else if (name == "fpcs") {
    pcl::registration::FPCSInitialAlignment<Point, Point> sets;
    sets.setDelta(leaf, false);
    sets.setNumberOfSamples(kSamples);
    place = byFourPoints(sets, target.points, source.points);
  }
  else if (name == "kfpcs") {
    pcl::registration::KFPCSInitialAlignment<Point, Point> sets;
    sets.setDelta(leaf, false);
    place = byFourPoints(sets, target.key_points, source.key_points);
  }
  else if (name == "features") {
    FeatureAlignmentOptions options;
    options.num_threads = 1;
    const CoarseEstimate found =
        alignByFeatures(set_.measured[first], set_.measured[second], options);
    place.accepted = found.status == Status::kOk;
    place.T_first_second = found.T_target_source;
  }
  else
    throw std::invalid_argument("no peer " + name);
  place.seconds = secondsOfProcessor() - start;
  return place;
}

} // namespace pcl6d::bench
