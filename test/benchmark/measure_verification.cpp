// SPDX-License-Identifier: BSD-3-Clause
// Right and wrong links of folders with a reference, and what verification sees of each, as
// CSV: the material that its constants are fitted to (share/doc/trust.md).
// usage: measure_verification [every=N] [gap=N] [scans=N] [pairs=N] FOLDER ...
#include "verification_links.h"

#include <pcl6d/verification/surface_fit.h>
#include <pcl6d/visibility/sight_evidence.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <map>
#include <string>

namespace pcl6d::bench {

namespace {
PlaceUncertainty
uncertaintyOf(const VerifiedScan& scan)
{
  PlaceUncertainty uncertainty;
  uncertainty.noise = scan.noise();
  return uncertainty;
}

void
printLink(const LinkSet& set, const TestedLink& link)
{
  using Clock = std::chrono::steady_clock;
  const VerifiedScan& a = set.scans[link.first];
  const VerifiedScan& b = set.scans[link.second];
  const double patch = 6 * set.voxel;
  const auto start = Clock::now();
  SightEvidence sight = sightEvidence(a.rays(),
                                      b.surfaces().points(),
                                      link.T_first_second,
                                      uncertaintyOf(b),
                                      patch);
  sight += sightEvidence(b.rays(),
                         a.surfaces().points(),
                         link.T_first_second.inverse(),
                         uncertaintyOf(a),
                         patch);
  const auto between = Clock::now();
  SurfaceFitOptions options;
  options.max_distance = set.icp.max_distance;
  const SurfaceFit fit = fitSurfaces(a, b, link.T_first_second, options);
  const auto end = Clock::now();
  const auto ms = [](auto d) { return std::chrono::duration<double, std::milli>(d).count(); };
  std::cout << set.name << ',' << link.kind << ',' << link.first << ',' << link.second
            << ',' << link.off << ',' << link.turn << ',' << set.voxel << ','
            << a.noise() << ',' << sight.confirmed << ',' << sight.free << ','
            << sight.points() << ',' << sight.patches << ',' << sight.contradicted_patches
            << ',' << fit.overlap << ',' << fit.residual << ',' << fit.displacement()
            << ',' << fit.deviation() << ',' << fit.mahalanobisSq() << ','
            << fit.open_directions << ',' << fit.spread << ',' << fit.pairs << ','
            << ms(between - start) << ',' << ms(end - between) << '\n';
}

int
run(const std::vector<std::string>& arguments)
{
  std::map<std::string, int> knobs{{"every", 1}, {"gap", 4}, {"scans", 60}, {"pairs", 60}};
  std::cout << "set,kind,first,second,off,turn,voxel,noise,confirmed,free,points,patches,"
               "contradicted,overlap,residual,displacement,deviation,mahalanobis_sq,open,"
               "spread,pairs,ms_rays,ms_fit\n";
  for (const std::string& argument : arguments) {
    const auto equals = argument.find('=');
    if (equals != std::string::npos) {
      knobs.at(argument.substr(0, equals)) = std::atoi(argument.c_str() + equals + 1);
      continue;
    }
    const LinkSet set = readLinkSet(
        argument, knobs["every"], static_cast<std::size_t>(knobs["scans"]));
    for (std::size_t i = 0; i < set.scans.size(); i += 5)
      std::cerr << set.name << " scan " << i << " voxel " << set.voxel << " noise "
                << set.scans[i].noise() << " self contradiction "
                << set.scans[i].selfContradiction() << " resolution "
                << set.scans[i].rays().resolution() << '\n';
    for (const TestedLink& link : makeLinks(set,
                                            static_cast<std::size_t>(knobs["gap"]),
                                            static_cast<std::size_t>(knobs["pairs"]),
                                            1))
      printLink(set, link);
  }
  return 0;
}
} // namespace

} // namespace pcl6d::bench

int
main(int argc, char** argv)
{
  return pcl6d::bench::run({argv + 1, argv + argc});
}
