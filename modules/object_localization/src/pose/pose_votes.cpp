// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/pose_votes.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pcl6d {

namespace {
/** Votes for the poses that put a model point on a scene point: by model point and by
 * turn about the normal. */
class Ballot {
public:
  Ballot(const PairFeatureTable& table, int turn_steps)
  : table_(table)
  , turns_(static_cast<std::size_t>(turn_steps))
  , counts_(table.numPoints() * turns_)
  {}

  /** Collects the votes of every pair with a point of the scene. */
  std::optional<VotedPose>
  at(std::size_t reference, const OrientedPoints& scene, const PointTree& tree)
  {
    std::fill(counts_.begin(), counts_.end(), 0);
    const Eigen::Vector3f& p = scene.points[reference];
    const Eigen::Vector3f& n = scene.normals[reference];
    const Eigen::Isometry3f frame = frameOf(p, n);
    const auto reach = static_cast<float>(table_.diameter() * table_.diameter());
    for (const Neighbour& near : tree.withinRadius(p, reach)) {
      const auto i = static_cast<std::size_t>(near.index);
      const int feature = table_.featureOf(p, n, scene.points[i], scene.normals[i]);
      if (feature >= 0)
        count(feature, frame * scene.points[i]);
    }
    return winner(frame);
  }

private:
  void
  count(int feature, const Eigen::Vector3f& second)
  {
    const auto angle = static_cast<float>(portableAtan2(second.z(), second.y()));
    const float scale = static_cast<float>(turns_) / static_cast<float>(2 * M_PI);
    for (const auto& pair : table_.pairsWith(feature)) {
      const float turn = (angle - pair.angle) * scale + static_cast<float>(turns_);
      auto step = static_cast<std::size_t>(turn + 0.5F); // >= 0: turn > -turns + turns
      while (step >= turns_)
        step -= turns_;
      ++counts_[pair.first * turns_ + step];
    }
  }

  /** The highest sum of three adjacent turns, at its centre of mass. */
  std::optional<VotedPose>
  winner(const Eigen::Isometry3f& frame) const
  {
    std::uint32_t most = 0;
    std::size_t point = 0, turn = 0;
    for (std::size_t i = 0; i < table_.numPoints(); ++i) {
      const std::uint32_t* row = counts_.data() + i * turns_;
      for (std::size_t k = 0; k < turns_; ++k) {
        const std::uint32_t sum = row[k] + row[k == 0 ? turns_ - 1 : k - 1] +
                                  row[k + 1 == turns_ ? 0 : k + 1];
        if (sum > most) {
          most = sum;
          point = i;
          turn = k;
        }
      }
    }
    if (most == 0)
      return {};
    return VotedPose{poseOf(frame, point, centred(point, turn)),
                     static_cast<double>(most)};
  }

  double
  centred(std::size_t point, std::size_t turn) const
  {
    const std::uint32_t* row = counts_.data() + point * turns_;
    const double before = row[turn == 0 ? turns_ - 1 : turn - 1];
    const double after = row[turn + 1 == turns_ ? 0 : turn + 1];
    const double sum = before + row[turn] + after;
    return static_cast<double>(turn) + (after - before) / sum;
  }

  Eigen::Isometry3d
  poseOf(const Eigen::Isometry3f& frame, std::size_t point, double turn) const
  {
    const SinCos angle = portableSinCos(2 * M_PI * turn / static_cast<double>(turns_));
    Eigen::Isometry3d about = Eigen::Isometry3d::Identity();
    about.linear() << 1, 0, 0, 0, angle.cos, -angle.sin, 0, angle.sin, angle.cos;
    return frame.cast<double>().inverse() * about * table_.frame(point).cast<double>();
  }

  const PairFeatureTable& table_;
  std::size_t turns_;
  std::vector<std::uint32_t> counts_;
};
} // namespace

void
PoseVoteOptions::validate() const
{
  require(turn_steps >= 8 && turn_steps <= 90, "turn_steps", turn_steps, "8 to 90");
  require(reference_stride >= 1, "reference_stride", reference_stride, ">= 1");
}

std::vector<VotedPose>
voteForPoses(const PairFeatureTable& table,
             const OrientedPoints& scene,
             const PointTree& tree,
             const PoseVoteOptions& options)
{
  options.validate();
  const auto stride = static_cast<std::size_t>(options.reference_stride);
  const std::size_t references = (scene.size() + stride - 1) / stride;
  std::vector<std::optional<VotedPose>> found(references);
  constexpr std::size_t kBlock = 16;
  parallelBlocks(references, kBlock, options.num_threads, [&](const Block& block) {
    Ballot ballot(table, options.turn_steps);
    for (std::size_t r = block.begin; r < block.end; ++r)
      found[r] = ballot.at(r * stride, scene, tree);
  });
  std::vector<VotedPose> poses;
  for (const auto& pose : found)
    if (pose)
      poses.push_back(*pose);
  return poses;
}

} // namespace pcl6d
