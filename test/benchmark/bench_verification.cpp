// SPDX-License-Identifier: BSD-3-Clause
// Right and wrong links of folders with a reference, and what verification sees of each, as
// CSV: the material that its constants are fitted to (share/doc/trust.md).
// usage: bench_verification [every=N] [gap=N] [scans=N] [pairs=N] [leave=set|sensor]
//        [sensor=NAME] FOLDER ...
// leave=sensor fits the constants to all sensors except one, instead of all sets except one. The
// sensor of a simulated set is told by its scene.json; sensor=NAME names that of the following sets.
#include "verification_fit.h"
#include "verification_links.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/text.h>
#include <pcl6d/verification/link_evidence.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>

namespace pcl6d::bench {

namespace {
/** A link and what is seen of it. */
struct SeenLink {
  TestedLink link;
  LinkEvidence evidence;
  double milliseconds;
};

SeenLink
seen(const LinkSet& set, const TestedLink& link)
{
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  SeenLink result{
      link,
      linkEvidence(set.scans[link.first], set.scans[link.second], link.T_first_second),
      0};
  result.milliseconds =
      std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return result;
}

void
print(const LinkSet& set, const SeenLink& one, double background)
{
  const auto& [link, evidence, milliseconds] = one;
  const SightEvidence& sight = evidence.sight;
  const SurfaceFit& fit = evidence.fit;
  const LinkTestResult test_result = testLink(evidence, background);
  std::cout << set.name << ',' << link.kind << ',' << link.first << ',' << link.second
            << ',' << link.off << ',' << link.turn << ',' << set.voxel << ','
            << set.scans[link.first].noise() << ',' << sight.confirmed << ','
            << sight.free << ',' << sight.points() << ',' << sight.patches << ','
            << sight.contradicted_patches << ',' << fit.overlap << ',' << fit.residual
            << ',' << evidence.leaving() << ',' << evidence.deviation() << ','
            << fit.mahalanobisSq() << ',' << fit.open_directions << ',' << fit.spread
            << ',' << fit.pairs << ',' << milliseconds << ',' << background << ','
            << test_result.probability_wrong << ',' << toString(test_result.trust)
            << '\n';
}

/** Settings of the command line. */
class Knobs {
public:
  /** \return whether the argument is a setting, which is then kept
   * \throws BadArgument unknown name or value */
  bool
  take(const std::string& argument)
  {
    const auto equals = argument.find('=');
    if (equals == std::string::npos)
      return false;
    const std::string name = argument.substr(0, equals),
                      value = argument.substr(equals + 1);
    if (name == "sensor")
      sensor_ = value;
    else if (name == "leave" && (value == "set" || value == "sensor"))
      leaves_sensor_ = value == "sensor";
    else if (numbers_.count(name) > 0)
      numbers_[name] = std::atoi(value.c_str());
    else
      throw BadArgument(argument + ": no such setting");
    return true;
  }

  int
  operator[](const std::string& name) const
  {
    return numbers_.at(name);
  }

  /** \return what is left out of a fit together with a folder */
  std::string
  groupOf(const std::filesystem::path& folder) const
  {
    if (!leaves_sensor_)
      return folder.filename();
    const auto record = folder / "scene.json";
    if (!sensor_.empty() || !std::filesystem::exists(record))
      return sensor_.empty() ? "sensor of " + folder.filename().string() : sensor_;
    return nlohmann::json::parse(text::readFile(record)).at("scanner");
  }

private:
  std::map<std::string, int> numbers_{{"every", 1},
                                      {"gap", 4},
                                      {"scans", 60},
                                      {"pairs", 60}};
  std::string sensor_; ///< of the following sets; empty: by scene.json
  bool leaves_sensor_ = false;
};

void
printScans(const LinkSet& set)
{
  for (std::size_t i = 0; i < set.scans.size(); i += 5)
    std::cerr << set.name << " scan " << i << " voxel " << set.voxel << " noise "
              << set.scans[i].noise() << " self contradiction "
              << set.scans[i].selfContradiction() << " resolution "
              << set.scans[i].rays().resolution() << '\n';
}

/** Tests the links of a set, and prints them. */
void
evaluate(const LinkSet& set,
         const Knobs& knobs,
         const std::string& group,
         std::vector<EvaluatedLink>& evaluated)
{
  std::vector<SeenLink> links;
  std::vector<LinkEvidence> right; // as a run has them
  for (const TestedLink& link : makeLinks(set,
                                          static_cast<std::size_t>(knobs["gap"]),
                                          static_cast<std::size_t>(knobs["pairs"]),
                                          1)) {
    links.push_back(seen(set, link));
    if (link.kind == "truth")
      right.push_back(links.back().evidence);
  }
  const double background = contradictionBackground(right);
  for (const SeenLink& one : links) {
    print(set, one, background);
    evaluated.push_back({set.name,
                         group,
                         one.link.kind,
                         one.link.off,
                         one.link.turn,
                         one.evidence,
                         testLink(one.evidence, background).trust});
  }
}

int
run(const std::vector<std::string>& arguments)
{
  std::cout
      << "set,kind,first,second,off,turn,voxel,noise,confirmed,free,points,patches,"
         "contradicted,overlap,residual,displacement,deviation,mahalanobis_sq,open,"
         "spread,pairs,ms,background,wrong,trust\n";
  Knobs knobs;
  std::vector<EvaluatedLink> evaluated;
  for (const std::string& argument : arguments) {
    if (knobs.take(argument))
      continue;
    const LinkSet set =
        readLinkSet(argument, knobs["every"], static_cast<std::size_t>(knobs["scans"]));
    printScans(set);
    evaluate(set, knobs, knobs.groupOf(argument), evaluated);
  }
  printVerdicts(evaluated, std::cerr);
  printLeaveOneOut(evaluated, std::cerr);
  printShiftLimits(evaluated, std::cerr);
  return 0;
}
} // namespace

} // namespace pcl6d::bench

int
main(int argc, char** argv)
try {
  return pcl6d::bench::run({argv + 1, argv + argc});
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
