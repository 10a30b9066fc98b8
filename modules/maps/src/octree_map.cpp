// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>
#include <pcl6d/maps/octree_map.h>

#include <algorithm>
#include <cmath>
#include <octomap/OcTree.h>
#include <ostream>
#include <sstream>

namespace pcl6d {

namespace {
/** [byte] maximum per node: 32 for the node allocated by glibc, and 80 for an array of children
 * shared by at least two nodes. */
constexpr std::size_t kBytesOfNode = 72;
/** [byte] of a key in a hash set: 32 for the node, 8 for a bucket, up to twice as many buckets
 * as keys. */
constexpr std::size_t kBytesOfKey = 48;
constexpr double kVoxelsOfSide = 32768; ///< on each side of the origin, of OctoMap

octomap::point3d
toOctomap(const Eigen::Vector3f& p)
{
  return {p.x(), p.y(), p.z()};
}
} // namespace

void
OctreeMapOptions::validate() const
{
  require(std::isfinite(resolution) && resolution > 0,
          "resolution",
          resolution,
          "> 0 and finite");
  require(max_range > 0, "max_range", max_range, "> 0");
  require(hit > 0.5 && hit < 1, "hit", hit, "in (0.5, 1)");
  require(miss > 0 && miss < 0.5, "miss", miss, "in (0, 0.5)");
  require(lowest > 0 && lowest < 0.5, "lowest", lowest, "in (0, 0.5)");
  require(highest > 0.5 && highest < 1, "highest", highest, "in (0.5, 1)");
}

/** \brief The octree, with the update by a scan. */
struct OctreeMap::Tree {
  explicit Tree(const OctreeMapOptions& options) : tree(options.resolution)
  {
    tree.setProbHit(options.hit);
    tree.setProbMiss(options.miss);
    tree.setClampingThresMin(options.lowest);
    tree.setClampingThresMax(options.highest);
    tree.setOccupancyThres(0.5);
  }

  octomap::OcTreeKey
  keyOf(const Eigen::Vector3f& p) const
  {
    octomap::OcTreeKey key;
    if (tree.coordToKeyChecked(toOctomap(p), key))
      return key;
    std::ostringstream rule;
    rule << "at least " << p.cwiseAbs().maxCoeff() / (kVoxelsOfSide - 1)
         << " [m], as OctoMap has " << kVoxelsOfSide
         << " voxels on each side of the origin";
    require(false, "resolution", tree.getResolution(), rule.str());
    return key;
  }

  octomap::OcTree tree;
};

namespace {
/** \brief The voxels changed by a scan. */
class ScanUpdate {
public:
  ScanUpdate(octomap::OcTree& tree, std::size_t memory) : tree_(tree), memory_(memory)
  {}

  octomap::KeySet&
  occupied()
  {
    return occupied_;
  }

  /** Marks the voxels from the origin up to the end, except the voxel of the end.
   * \return false: too many voxels */
  bool
  addRay(const octomap::point3d& origin, const octomap::point3d& end)
  {
    if (tree_.computeRayKeys(origin, end, ray_))
      free_.insert(ray_.begin(), ray_.end());
    const std::size_t keys = free_.size() + occupied_.size();
    return keys * kBytesOfKey + tree_.size() * kBytesOfNode <= memory_;
  }

  /** \return false: the tree may become too large */
  bool
  apply()
  {
    for (const octomap::OcTreeKey& key : free_)
      if (occupied_.count(key) == 0)
        tree_.updateNode(key, false);
    for (const octomap::OcTreeKey& key : occupied_)
      tree_.updateNode(key, true);
    return tree_.size() * kBytesOfNode <= memory_;
  }

private:
  octomap::OcTree& tree_;
  std::size_t memory_;
  octomap::KeySet free_, occupied_;
  octomap::KeyRay ray_;
};
} // namespace

OctreeMap::OctreeMap(const OctreeMapOptions& options) : options_(options)
{
  options.validate();
  tree_ = std::make_unique<Tree>(options);
}

OctreeMap::~OctreeMap() = default;

bool
OctreeMap::insert(const MappedScan& scan)
{
  ScanUpdate update(tree_->tree, options_.memory);
  tree_->keyOf(scan.origin);
  const octomap::point3d origin = toOctomap(scan.origin);
  octomap::KeySet ends;
  for (const Eigen::Vector3f& p : scan.points) {
    const octomap::OcTreeKey key = tree_->keyOf(p);
    if (!ends.insert(key).second)
      continue; // a ray to the voxel exists already
    octomap::point3d end = tree_->tree.keyToCoord(key);
    const octomap::point3d ray = end - origin;
    if (ray.norm() <= options_.max_range)
      update.occupied().insert(key);
    else
      end = origin + ray.normalized() * static_cast<float>(options_.max_range);
    if (scan.has_rays && !update.addRay(origin, end))
      return false;
  }
  return update.apply();
}

CellState
OctreeMap::state(const Eigen::Vector3d& place) const
{
  const auto* const node = tree_->tree.search(place.x(), place.y(), place.z());
  if (node == nullptr)
    return CellState::kUnknown;
  return tree_->tree.isNodeOccupied(node) ? CellState::kOccupied : CellState::kFree;
}

double
OctreeMap::probability(const Eigen::Vector3d& place) const
{
  const auto* const node = tree_->tree.search(place.x(), place.y(), place.z());
  return node == nullptr ? 0.5 : node->getOccupancy();
}

std::size_t
OctreeMap::numNodes() const
{
  return tree_->tree.size();
}

bool
OctreeMap::isEmpty() const
{
  const octomap::OcTree& tree = tree_->tree;
  return std::none_of(tree.begin_leafs(), tree.end_leafs(), [&](const auto& node) {
    return tree.isNodeOccupied(node);
  });
}

void
OctreeMap::write(const std::filesystem::path& path)
{
  const std::string extension = path.extension().string();
  const bool is_binary = extension == ".bt";
  require(is_binary || extension == ".ot", "path", path.string(), "a file .bt or .ot");
  octomap::OcTree& tree = tree_->tree;
  if (is_binary)
    tree.toMaxLikelihood();
  tree.prune();
  writeFileAtomically(path, [&](std::ostream& stream) {
    // OctoMap's own write() prints to the terminal.
    stream << "# Octomap OcTree " << (is_binary ? "binary " : "")
           << "file\n# (feel free to add / change comments, but leave the first line "
              "as it "
              "is!)\n#\nid OcTree\nsize "
           << tree.size() << "\nres " << text::shortest(tree.getResolution())
           << "\ndata\n";
    if (is_binary)
      tree.writeBinaryNode(stream, tree.getRoot()); // writeBinaryData() prints
    else
      tree.writeData(stream);
  });
}

} // namespace pcl6d
