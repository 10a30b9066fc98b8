// SPDX-License-Identifier: BSD-3-Clause
#include "proposals/cavities.h"
#include "proposals/crease_parts.h"
#include "proposals/footprint_box.h"
#include "proposals/surfel_graph.h"
#include "proposals/view_border.h"

#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/object_proposals.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace object_localization;

namespace {
/** Makes proposals of sets of surfels. */
class Proposer {
public:
  Proposer(const PlaneCloud& cloud,
           const PlaneSegments& planes,
           const ProposalOptions& options)
  : cloud_(cloud)
  , options_(options)
  , supports_(findSupports(cloud, planes, options))
  , border_(cloud)
  , graph_(linkSurfels(cloud,
                       surfelsOfThings(cloud, supports_, options),
                       border_.angularSpacing(),
                       options))
  {}

  std::vector<ObjectProposal>
  propose() const
  {
    std::vector<std::vector<ObjectProposal>> families; // each whole with its parts
    SurfelSets sets = connectedSets(cloud_, graph_, supports_);
    joinCavities(cloud_, graph_, supports_.up, sets);
    for (const auto& set : sets)
      if (auto whole = standing(set))
        families.push_back(withParts(std::move(*whole), set));
      else if (set.size() >=
               options_.min_points / 2) // too large, possibly several objects
        for (const auto& part : partsOf(set))
          if (auto piece = standing(part))
            families.push_back({std::move(*piece)});
    std::stable_sort(
        families.begin(), families.end(), [](const auto& a, const auto& b) {
          return a[0].points.size() > b[0].points.size();
        });
    std::vector<ObjectProposal> proposals;
    for (auto& family : families) {
      const std::size_t whole = proposals.size();
      for (auto& proposal : family) {
        if (proposals.size() > whole)
          proposal.part_of = whole;
        proposals.push_back(std::move(proposal));
      }
    }
    return proposals;
  }

private:
  const Eigen::Vector3f&
  placeOf(std::uint32_t i) const
  {
    return cloud_.surfels().points[graph_.surfels[i]];
  }

  Eigen::Vector3f
  middleOf(const std::vector<std::uint32_t>& set) const
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto i : set)
      sum += placeOf(i).cast<double>();
    return (sum / static_cast<double>(set.size())).cast<float>();
  }

  /** \return the lowest and the highest over a plane [m] */
  std::pair<double, double>
  heightsOver(std::size_t plane, const std::vector<std::uint32_t>& set) const
  {
    std::pair<double, double> heights(INFINITY, -INFINITY);
    for (const auto i : set) {
      const double height = supports_.prisms[plane].height(placeOf(i));
      heights.first = std::min(heights.first, height);
      heights.second = std::max(heights.second, height);
    }
    return heights;
  }

  /** \return the proposal, if the set stands on a plane and has the size of an
   * object */
  std::optional<ObjectProposal>
  standing(const std::vector<std::uint32_t>& set) const
  {
    const auto support = supportOf(set);
    return support ? proposalOf(set, *support) : std::nullopt;
  }

  /** \return the level plane that a set touches from above, or else the base over which
   * the set seems to float */
  std::optional<std::size_t>
  supportOf(const std::vector<std::uint32_t>& set) const
  {
    const Eigen::Vector3f middle = middleOf(set);
    std::optional<std::size_t> touched, below;
    double nearest = options_.contact;
    for (std::size_t k = 0; k < supports_.prisms.size(); ++k) {
      const PlaneRole role = supports_.roles[k];
      if ((role != PlaneRole::kBase && role != PlaneRole::kRaised) ||
          !supports_.prisms[k].covers(middle, options_.overhang))
        continue;
      const auto [low, high] = heightsOver(k, set);
      if (high <= options_.min_height || high >= options_.max_height)
        continue;
      if (std::abs(low) < nearest) {
        nearest = std::abs(low);
        touched = k;
      }
      if (role == PlaneRole::kBase && low > -options_.contact &&
          low < options_.max_float)
        below = below.value_or(k);
    }
    return touched ? touched : below;
  }

  /** \return the proposal, if the set has the size of an object */
  std::optional<ObjectProposal>
  proposalOf(const std::vector<std::uint32_t>& set, std::size_t support) const
  {
    ObjectProposal proposal;
    const Surfels& surfels = cloud_.surfels();
    Points points;
    for (const auto i : set) {
      const auto s = graph_.surfels[i];
      for (auto m = surfels.begin[s]; m < surfels.begin[s + 1]; ++m) {
        const auto point = surfels.members[m];
        proposal.points.push_back(cloud_.places()[point]);
        proposal.touches_border |= border_.touches(point);
        points.push_back(cloud_.points()[point]);
      }
    }
    if (points.size() < options_.min_points)
      return {};
    std::sort(proposal.points.begin(), proposal.points.end());
    const PlanePrism& base = supports_.prisms[support];
    const double height =
        supports_.up.dot(middleOf(set).cast<double>()) - base.height(middleOf(set));
    const FootprintBox box = footprintBox(points, supports_.up, height);
    if (box.size.head<2>().maxCoeff() > options_.max_extent)
      return {};
    proposal.T_scene_box = box.T_scene_box;
    proposal.size = box.size;
    proposal.support = support;
    return proposal;
  }

  /** \return the whole, then its parts, if it has several */
  std::vector<ObjectProposal>
  withParts(ObjectProposal whole, const std::vector<std::uint32_t>& set) const
  {
    std::vector<ObjectProposal> family;
    const std::size_t support = whole.support;
    family.push_back(std::move(whole));
    if (!options_.parts)
      return family;
    const SurfelSets parts = partsOf(set);
    if (parts.size() > 1)
      for (const auto& part : parts)
        if (auto proposal = proposalOf(part, supportOf(part).value_or(support)))
          family.push_back(std::move(*proposal));
    return family;
  }

  /** \return the disjoint parts of a set, divided by level planes and creases */
  SurfelSets
  partsOf(const std::vector<std::uint32_t>& set) const
  {
    SurfelSets parts;
    for (const auto& layer : layersOf(set))
      for (auto& part : divideAtCreases(cloud_, graph_, layer, options_))
        parts.push_back(std::move(part));
    return parts;
  }

  /** \return the objects on level planes of a set, and the rest */
  SurfelSets
  layersOf(const std::vector<std::uint32_t>& set) const
  {
    SurfelSets layers;
    std::vector<std::uint32_t> rest = set;
    for (std::size_t k = 0; k < supports_.prisms.size(); ++k) {
      if (supports_.roles[k] != PlaneRole::kRaised || !carries(k, rest))
        continue;
      std::vector<char> over(graph_.size(), 0);
      for (const auto i : rest)
        over[i] = isOver(k, i);
      for (auto& part : connectedSets(graph_, over)) {
        const auto [low, high] = heightsOver(k, part);
        if (low > options_.contact || high < options_.min_height ||
            !proposalOf(part, k)) {
          for (const auto i : part)
            over[i] = 0;
          continue;
        }
        layers.push_back(std::move(part));
      }
      rest.erase(std::remove_if(
                     rest.begin(), rest.end(), [&](auto i) { return over[i] != 0; }),
                 rest.end());
    }
    layers.push_back(std::move(rest));
    return layers;
  }

  bool
  isOver(std::size_t plane, std::uint32_t i) const
  {
    const PlanePrism& prism = supports_.prisms[plane];
    return supports_.plane_of_surfel[graph_.surfels[i]] != plane &&
           prism.height(placeOf(i)) > 0 && prism.covers(placeOf(i), graph_.spacings[i]);
  }

  bool
  carries(std::size_t plane, const std::vector<std::uint32_t>& set) const
  {
    return std::any_of(set.begin(), set.end(), [&](std::uint32_t i) {
      return supports_.plane_of_surfel[graph_.surfels[i]] == plane;
    });
  }

  const PlaneCloud& cloud_;
  const ProposalOptions& options_;
  SceneSupports supports_;
  ViewBorder border_;
  SurfelGraph graph_;
};
} // namespace

void
ProposalOptions::validate() const
{
  require(!up || (up->allFinite() && up->norm() > 0),
          "up",
          up.value_or(Eigen::Vector3d::Zero()).transpose(),
          "finite and not zero");
  require(max_tilt > 0 && max_tilt < M_PI / 2, "max_tilt", max_tilt, "in (0, pi/2)");
  require(max_extent > 0, "max_extent", max_extent, "> 0");
  require(max_height > 0, "max_height", max_height, "> 0");
  require(min_height > 0, "min_height", min_height, "> 0");
  require(contact > 0, "contact", contact, "> 0");
  require(max_float >= 0, "max_float", max_float, ">= 0");
  require(overhang >= 0, "overhang", overhang, ">= 0");
  require(gap >= 1 && std::isfinite(gap), "gap", gap, ">= 1 and finite");
  require(crease > 0 && crease < 1, "crease", crease, "in (0, 1)");
  require(min_points >= 3, "min_points", min_points, ">= 3");
}

std::vector<ObjectProposal>
proposeObjects(const PlaneCloud& cloud,
               const PlaneSegments& planes,
               const ProposalOptions& options)
{
  options.validate();
  return Proposer(cloud, planes, options).propose();
}

} // namespace pcl6d
