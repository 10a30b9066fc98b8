// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/option_table.h"
#include "common/progress_bar.h"
#include "common/reduction_options.h"
#include "evaluate/pair_pose.h"
#include "evaluate/pair_scan.h"
#include "evaluate/result_file.h"
#include "evaluate/result_json.h"
#include "evaluate/verbs.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/global_registration/place_search.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/verification/prepared_scans.h>

#include <cstdio>
#include <string>
#include <vector>

namespace pcl6d::app {

namespace {
/** The command line of `pcl_slam6d_evaluate place`. */
struct PlaceSettings {
  std::string scan_a, scan_b, output;
  ScanFormat format = ScanFormat::kAuto;
  ScanParameterOptions parameters;
  PlaceSearchOptions search;
  bool quiet = false;
};

/** What was found, of the points as the files have them. */
struct FoundPlaces {
  PlaceResult result;
  std::vector<Eigen::Isometry3d> T_a_b; ///< of each candidate
  double voxel = 0;                     ///< [m]
};

bool
parse(const std::vector<std::string>& arguments, PlaceSettings& s)
{
  OptionTable table(std::string("usage: ") + kEvaluate +
                    R"( place SCAN_A SCAN_B [options]
Where scan B was taken, seen from scan A, without any guess: all turns and shifts are
tried, the best places are judged by points and rays. Unique is of these two scans alone:
rooms that are equal to the last chair deceive it.
Exit code 0: one place, and no other nearly as good; 3: several, or none.
)");
  table.positional("SCAN_A", &s.scan_a);
  table.positional("SCAN_B", &s.scan_b);
  table.group("Input");
  table.add("format", &s.format, scanFormatFromName).help("auto|pcd|ply|uos|kitti|xyz");
  table.group("Range gate and reduction; auto: as pcl_slam6d does");
  addReductionOptions(table, s.parameters);
  table.group("Search");
  table.addAs<int>("candidates", &s.search.candidates)
      .within(1, 30, "in [1, 30]")
      .help("so many places are listed");
  table.add("max-ambiguity", &s.search.max_ambiguity)
      .help("largest second score / score of a unique place; in [0, 1]");
  table.group("Run");
  table.add("output,o FILE", &s.output).help("write the candidates (.json)");
  table.addAs<int>("threads", &s.search.num_threads)
      .within(0, 1024, "in [0, 1024]")
      .help("0: one per core; never changes the result");
  table.add("quiet", &s.quiet).help("print the answer, warnings and errors only");
  if (!table.parse(arguments))
    return false;
  requireExtension("--output", s.output, {".json"});
  refuseInputs(s.output, {s.scan_a, s.scan_b});
  table.check([&] {
    s.parameters.validate();
    s.search.validate();
  });
  return true;
}

FoundPlaces
find(const PlaceSettings& s, ProgressBar& bar)
{
  const NearScan a = readNear(s.scan_a, s.format, bar);
  const NearScan b = readNear(s.scan_b, s.format, bar);
  PreparedScans scans(2,
                      deriveScanParameters(s.parameters, {a.points, b.points}),
                      s.search.num_threads);
  scans.set(0, a.points, s.scan_a);
  scans.set(1, b.points, s.scan_b);
  FoundPlaces found;
  found.voxel = scans.parameters().voxel.value;
  found.result = placeScan(
      PlaceableScan(scans.scans()[0]), PlaceableScan(scans.scans()[1]), s.search);
  for (const auto& one : found.result.candidates)
    found.T_a_b.push_back(farPose(one.T_first_second, a, b));
  if (scans.firstLike(1) == 0 && found.result.answer == PlaceAnswer::kUnique) {
    found.result.answer = PlaceAnswer::kNone;
    found.result.reason = "both hold the very same points, which is no evidence";
  }
  return found;
}

/** \return x y z [m] roll pitch yaw [deg], as --pose and --guess take them */
std::string
poseText(const Eigen::Isometry3d& pose)
{
  const Eigen::Vector3d& t = pose.translation();
  const EulerAngles angles = eulerFromRotation(pose.linear());
  char text[200];
  std::snprintf(text,
                sizeof text,
                "%.4f %.4f %.4f %.3f %.3f %.3f",
                t.x(),
                t.y(),
                t.z(),
                degrees(angles.roll),
                degrees(angles.pitch),
                degrees(angles.yaw));
  return text;
}

void
print(const PlaceSettings& s, const FoundPlaces& found)
{
  const PlaceResult& result = found.result;
  if (!s.quiet && !result.candidates.empty()) {
    std::printf("%4s %8s %8s %13s  %-10s  %s\n",
                "",
                "score",
                "overlap",
                "contradicted",
                "judged",
                "pose of B from A: x y z [m] roll pitch yaw [deg]");
    for (std::size_t i = 0; i < result.candidates.size(); ++i) {
      const PlaceCandidate& one = result.candidates[i];
      std::printf("%4zu %8.4f %6.1f %% %11.2f %%  %-10s  %s\n",
                  i + 1,
                  one.score,
                  100 * one.overlap,
                  100 * one.contradiction,
                  toString(one.opinion.trust),
                  poseText(found.T_a_b[i]).c_str());
    }
    std::printf("voxel %g m\n", found.voxel);
  }
  if (result.answer == PlaceAnswer::kUnique)
    std::printf("unique: %s\n", poseText(found.T_a_b.front()).c_str());
  else
    std::printf("%s: %s\n", toString(result.answer), result.reason.c_str());
}

void
write(const PlaceSettings& s, const FoundPlaces& found)
{
  Json candidates = Json::array();
  for (std::size_t i = 0; i < found.result.candidates.size(); ++i) {
    const PlaceCandidate& one = found.result.candidates[i];
    Json rows = Json::array();
    for (int k = 0; k < 16; ++k)
      rows.push_back(found.T_a_b[i].matrix()(k / 4, k % 4));
    candidates.push_back({{"T_a_b", rows},
                          {"score", one.score},
                          {"overlap", one.overlap},
                          {"contradiction", one.contradiction},
                          {"patches", one.evidence.sight.patches},
                          {"trust", toString(one.opinion.trust)},
                          {"probability_wrong", one.opinion.probability_wrong},
                          {"reason", one.opinion.reason}});
  }
  const Json json = {{"schema_version", 1},
                     {"scan_a", s.scan_a},
                     {"scan_b", s.scan_b},
                     {"voxel", found.voxel},
                     {"answer", toString(found.result.answer)},
                     {"reason", found.result.reason},
                     {"ambiguity", found.result.ambiguity()},
                     {"candidates", candidates}};
  writeJson(s.output, json, 2);
}
} // namespace

int
runPlace(const std::vector<std::string>& arguments)
{
  PlaceSettings s;
  if (!parse(arguments, s))
    return kDone;
  ProgressBar bar(s.quiet);
  const FoundPlaces found = find(s, bar);
  print(s, found);
  flushOutput();
  if (!s.output.empty())
    write(s, found);
  return found.result.answer == PlaceAnswer::kUnique ? kDone : kDoubtful;
}

} // namespace pcl6d::app
