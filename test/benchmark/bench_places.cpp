// SPDX-License-Identifier: BSD-3-Clause
// Pairs of scans with a reference, placed without a guess: how many right places are found and
// accepted, by overlap, what is said of wrong ones, how near places come once matched finely,
// and the same of other ways (peers=1).
// usage: bench_places [every=N] [scans=N] [pairs=N] [peers=1] [verbose=1] [broken=FIRST-LAST]
//                     [contradiction=N] FOLDER ...
// contradiction: so many thousandths of the surfaces a unique place may contradict
// broken: the reference is wrong from one scan to another: pairs lie before or after them
#include "place_peers.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/global_registration/place_search.h>
#include <pcl6d/verification/prepared_scans.h>
#include <pcl6d/verification/surface_fit.h>

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <iomanip>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::bench {

namespace {
constexpr double kRightWay = 0.5, kRightTurn = 0.087; // [m], 5 deg
constexpr double kExactWay = 0.02;                    // [m] after fine matching
constexpr int kClasses = 5;
const char* const kClassNames[] = {"< 0.1", "< 0.3", "< 0.5", "< 0.7", "above"};

/** What a method did with pairs of one class of overlap. */
struct Tally {
  int pairs = 0, best = 0, exact = 0; ///< the best place is right, and after matching
  int right = 0, wrong = 0;           ///< of what it accepted
  double seconds = 0, matching = 0;
};

using Tallies = std::map<std::pair<int, std::string>, Tally>;

struct Knobs {
  std::map<std::string, int> numbers{{"every", 1},
                                     {"scans", 60},
                                     {"pairs", 40},
                                     {"contradiction", 10},
                                     {"peers", 0},
                                     {"verbose", 0}};
  std::size_t broken_from = 1, broken_to = 0;

  void
  set(const std::string& argument, std::size_t equals)
  {
    const std::string name = argument.substr(0, equals);
    const std::string value = argument.substr(equals + 1);
    if (name != "broken") {
      numbers.at(name) = std::atoi(value.c_str());
      return;
    }
    broken_from = std::stoul(value);
    broken_to = std::stoul(value.substr(value.find('-') + 1));
  }

  bool
  isSound(std::size_t i, std::size_t j) const
  {
    if (broken_from > broken_to)
      return true;
    return std::max(i, j) < broken_from || std::min(i, j) > broken_to;
  }
};

int
classOf(double overlap)
{
  return overlap < 0.1   ? 0
         : overlap < 0.3 ? 1
         : overlap < 0.5 ? 2
         : overlap < 0.7 ? 3
                         : 4;
}

bool
isRight(const Eigen::Isometry3d& truth, const Eigen::Isometry3d& found)
{
  const MotionSize off = distanceBetween(truth, found);
  return off.translation < kRightWay && off.rotation < kRightTurn;
}

/** The pairs of one set, method by method. */
class Pairs {
public:
  Pairs(const LinkSet& set, const Knobs& knobs) : set_(set), knobs_(knobs), peers_(set)
  {
    for (const auto& scan : set_.scans)
      scans_.emplace_back(scan);
    const auto start = secondsOfProcessor();
    PreparedScans prepared(1, deriveScanParameters({}, {set_.measured.front()}), 1);
    prepared.set(0, set_.measured.front(), set_.name);
    const PlaceableScan placeable(prepared.scans().front());
    std::cout << set_.name << ": " << scans_.size() << " scans, voxel " << set_.voxel
              << " m, the first made ready in " << secondsOfProcessor() - start
              << " s\n";
  }

  /** Judges as many pairs of each class as there are, and prints what came out. */
  void
  run()
  {
    Random random(1);
    std::map<int, int> taken;
    const int wanted = knobs_.numbers.at("pairs") / kClasses;
    for (int trial = 0; trial < 4000; ++trial) {
      const auto i = static_cast<std::size_t>(random.uniform() * scans_.size());
      const auto j = static_cast<std::size_t>(random.uniform() * scans_.size());
      if (i == j || !knobs_.isSound(i, j))
        continue;
      const double overlap = overlapOf(i, j);
      if (taken[classOf(overlap)]++ < wanted)
        evaluate(i, j, overlap);
    }
    print();
  }

private:
  Eigen::Isometry3d
  truth(std::size_t i, std::size_t j) const
  {
    return set_.T_world_scan[i].inverse() * set_.T_world_scan[j];
  }

  double
  overlapOf(std::size_t i, std::size_t j) const
  {
    SurfaceFitOptions options;
    options.max_distance = 3 * set_.voxel;
    options.covariance = false;
    return fitSurfaces(set_.scans[i], set_.scans[j], truth(i, j), options).overlap;
  }

  void
  evaluate(std::size_t i, std::size_t j, double overlap)
  {
    judgeOurs(i, j, overlap);
    if (knobs_.numbers.at("peers") == 0)
      return;
    for (const auto& name : PlacePeers::names()) {
      const PeerPlace found = peers_.place(name, i, j);
      Tally& tally = tallies_[{classOf(overlap), name}];
      add(found.accepted, isRight(truth(i, j), found.T_first_second), tally);
      tally.seconds += found.seconds;
    }
  }

  static void
  add(bool accepted, bool is_right, Tally& tally)
  {
    ++tally.pairs;
    tally.best += is_right;
    tally.right += accepted && is_right;
    tally.wrong += accepted && !is_right;
  }

  void
  judgeOurs(std::size_t i, std::size_t j, double overlap)
  {
    PlaceSearchOptions options = PlaceSearchOptions::forTwoScans();
    options.max_contradiction = 1e-3 * knobs_.numbers.at("contradiction");
    options.num_threads = 1;
    const auto start = secondsOfProcessor();
    const PlaceResult found = placeScan(scans_[i], scans_[j], options);
    const double seconds = secondsOfProcessor() - start;
    Tally& tally = tallies_[{classOf(overlap), "placeScan"}];
    tally.seconds += seconds;
    bool is_right = false;
    if (!found.candidates.empty()) {
      const auto& best = found.candidates.front().T_first_second;
      is_right = isRight(truth(i, j), best);
      const auto then = secondsOfProcessor();
      const Eigen::Isometry3d fine = refinePlace(scans_[i], scans_[j], best, 1);
      tally.matching += secondsOfProcessor() - then;
      tally.exact += distanceBetween(truth(i, j), fine).translation < kExactWay;
    }
    add(found.answer == PlaceAnswer::kUnique, is_right, tally);
    if (knobs_.numbers.at("verbose") > 0)
      show(i, j, overlap, seconds, found);
  }

  void
  show(std::size_t i,
       std::size_t j,
       double overlap,
       double seconds,
       const PlaceResult& found) const
  {
    std::cout << "pair " << set_.name << ' ' << i << ' ' << j << ' ' << overlap << ' '
              << seconds << ' ' << toString(found.answer) << ' '
              << set_.scans[i].selfContradiction() << ' '
              << set_.scans[j].selfContradiction() << ' ' << found.rejection << '\n';
    for (const auto& one : found.candidates)
      show("cand", truth(i, j), one);
    show("truth", truth(i, j), evaluatePlace(scans_[i], scans_[j], truth(i, j)));
  }

  static void
  show(const char* kind, const Eigen::Isometry3d& truth, const PlaceCandidate& one)
  {
    const MotionSize off = distanceBetween(truth, one.T_first_second);
    const SightEvidence& s = one.evidence.sight;
    const SurfaceFit& fit = one.evidence.fit;
    std::cout << "  " << kind << ' ' << isRight(truth, one.T_first_second) << ' '
              << off.translation << ' ' << off.rotation << ' ' << one.score << ' '
              << one.overlap << ' ' << one.contradiction << ' ' << s.confirmed << ' '
              << s.free << ' ' << s.behind << ' ' << s.edge << ' ' << s.unseen << ' '
              << s.patches << ' ' << s.confirmed_patches << ' '
              << s.contradicted_patches << ' ' << one.test_result.probability_wrong
              << ' ' << one.evidence.leaving() << ' ' << one.evidence.deviation() << ' '
              << fit.open_directions << ' ' << fit.residual << ' ' << fit.overlap
              << '\n';
  }

  void
  print() const
  {
    std::cout << std::setprecision(3);
    for (const auto& [key, tally] : tallies_)
      std::cout << set_.name << " overlap " << kClassNames[key.first] << " "
                << key.second << ": " << tally.pairs << " pairs, best right "
                << tally.best << ", accepted " << tally.right << " right "
                << tally.wrong << " wrong, within 2 cm " << tally.exact << ", "
                << tally.seconds / tally.pairs << " s + "
                << tally.matching / tally.pairs << " s\n";
    if (knobs_.numbers.at("peers") > 0)
      std::cout << set_.name
                << " normals, FPFH and key points of PCL: " << peers_.secondsOfScan()
                << " s a scan\n";
  }

  const LinkSet& set_;
  const Knobs& knobs_;
  PlacePeers peers_;
  std::deque<PlaceableScan> scans_;
  Tallies tallies_;
};

int
run(const std::vector<std::string>& arguments)
{
  Knobs knobs;
  for (const std::string& argument : arguments) {
    const auto equals = argument.find('=');
    if (equals != std::string::npos) {
      knobs.set(argument, equals);
      continue;
    }
    const LinkSet set =
        readLinkSet(argument,
                    knobs.numbers.at("every"),
                    static_cast<std::size_t>(knobs.numbers.at("scans")));
    Pairs(set, knobs).run();
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
