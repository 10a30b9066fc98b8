// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "cut_evidence.h"

#include <algorithm>
#include <cmath>

namespace pcl6d::verification {

namespace {
/** Number of backgrounds, each larger than the one before by a factor: to 0.054, beyond
 * kMostBackground. */
constexpr std::size_t kLevels = 22;
constexpr double kLadder = 1.25;

/** Log ratio of two normal distributions: of twice the deviation, and of the deviation. */
double
surfacesAgainstLink(const LinkCheck& link)
{
  constexpr double kLogTwo = 0.69314718055994531;
  if (link.open_directions > 0 || !(link.deviation > 0))
    return 0;
  const double sigmas = std::min(link.shift / link.deviation, kMostCutSigmas);
  return 3.0 / 8 * sigmas * sigmas - kLogTwo;
}
} // namespace

CutConstants
cutConstants()
{
  return {kEvenShare,
          kCutPrecision,
          kLeastCutBackground,
          kRestPatches,
          kCutSurfaces,
          kGoodBelow};
}

CutEvidence::CutEvidence(const std::vector<LinkCheck>& links,
                         const CutConstants& constants)
: links_(links), constants_(constants), known_(links.size() * kLevels)
{}

std::size_t
CutEvidence::levelOf(double background) const
{
  std::size_t level = 0;
  for (double b = constants_.least_background * kLadder;
       b < background && level + 1 < kLevels;
       b *= kLadder)
    ++level;
  return level;
}

double
CutEvidence::backgroundOf(std::size_t level) const
{
  double background = constants_.least_background;
  for (std::size_t i = 0; i < level; ++i)
    background *= kLadder;
  return background;
}

RaysAgainst
CutEvidence::against(const std::vector<std::size_t>& cut,
                     const std::vector<double>& backgrounds)
{
  RaysAgainst sum;
  for (std::size_t i = 0; i < cut.size(); ++i) {
    const std::size_t k = cut[i];
    const RaysAgainst& rays = raysOf(k, levelOf(backgrounds[i]));
    const double surfaces = constants_.surfaces * surfacesAgainstLink(links_[k]);
    sum.usual += rays.usual + surfaces;
    sum.even += rays.even + surfaces;
  }
  const double root =
      std::sqrt(static_cast<double>(std::max<std::size_t>(1, cut.size())));
  return {sum.usual / root, sum.even / root};
}

const RaysAgainst&
CutEvidence::raysOf(std::size_t link, std::size_t level)
{
  std::optional<RaysAgainst>& known = known_[link * kLevels + level];
  if (!known)
    known = raysAgainst(
        links_[link].contradicted,
        links_[link].patches,
        {backgroundOf(level), constants_.least_background, constants_.precision});
  return *known;
}

} // namespace pcl6d::verification
