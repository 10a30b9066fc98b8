// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "common/options/reduction_options.h"
#include "common/progress_bar.h"
#include "evaluate/pair_pose.h"
#include "evaluate/pair_scan.h"
#include "evaluate/place/place_report.h"
#include "evaluate/result_file.h"
#include "evaluate/verbs.h"

#include <pcl6d/verification/prepared_scans.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace pcl6d::app {

namespace {
bool
parse(const std::vector<std::string>& arguments, PlaceSettings& s)
{
  OptionTable table(std::string("usage: ") + kEvaluate +
                    " place SCAN_A SCAN_B [options]\n       " + kEvaluate +
                    R"( place SCAN RUN [options]
Place recognition: the pose of scan B relative to scan A, or of a scan in the map of a
run of pcl_slam6d, without an initial pose. Every turn and shift is tried, and the best
places are verified by points and rays. A place is unique only among the given scans:
two rooms equal to the last chair cannot be told apart if the map holds only one.
Exit code 0: one place, without a second place nearly as good; 3: several places or none.
)");
  table.positional("SCAN_A", &s.scan_a);
  table.positional("SCAN_B", &s.scan_b);
  table.group("Input");
  table.add("format", &s.format, scanFormatFromName)
      .help("auto|pcd|ply|uos|kitti|xyz|las|laz");
  table.group("Range gate and reduction; auto: values of pcl_slam6d, or of the run");
  addReductionOptions(table, s.parameters);
  table.group("Search");
  table.addAs<int>("candidates", &s.search.candidates)
      .within(1, 30, "in [1, 30]")
      .help("number of places listed");
  table.add("max-ambiguity", &s.search.max_ambiguity)
      .help("largest second score / score of a unique place; in [0, 1]");
  table.group("Run");
  table.add("output,o FILE", &s.output).help("write the candidates (.json)");
  table.add("picture FILE", &s.picture)
      .help("draw the best candidates side by side, from above (.png)");
  table.addAs<int>("threads", &s.search.num_threads)
      .within(0, 1024, "in [0, 1024]")
      .help("0: a thread per core; never changes the result");
  table.add("quiet", &s.quiet).help("print the answer, warnings and errors only");
  if (!table.parse(arguments))
    return false;
  requireResultFile("--output", s.output, {".json"});
  requireResultFile("--picture", s.picture, {".png"});
  refuseInputs(s.output, {s.scan_a, s.scan_b});
  refuseInputs(s.picture, {s.scan_a, s.scan_b}, "an input", "--picture");
  table.check([&] {
    s.parameters.validate();
    s.search.validate();
  });
  return true;
}

/** Points for the picture: both scans, with A turned upright. */
void
takeDrawn(const PlaceableScan& a, const PlaceableScan& b, PlaceReport& report)
{
  Eigen::Isometry3d T_drawn_a = Eigen::Isometry3d::Identity();
  T_drawn_a.linear() = uprightRotation(a.vertical().up);
  report.drawn_map = transformed(uprightPoints(a.scan(), a.vertical().up), T_drawn_a);
  report.drawn_scan = uprightPoints(b.scan(), b.vertical().up);
  for (FoundPlace& place : report.places)
    place.T_drawn_scan = T_drawn_a * place.candidate.T_first_second;
}
} // namespace

bool
PlaceSettings::isInRun() const
{
  std::error_code error;
  return std::filesystem::is_directory(scan_b, error);
}

Points
uprightPoints(const VerifiedScan& scan, const Eigen::Vector3d& up)
{
  // Halfway from a wall to a floor; flatter surfaces hide the walls from above.
  constexpr double kUpright = 0.7071;
  constexpr std::size_t kFew = 100;
  const Points& all = scan.surfaces().points();
  const Normals& normals = scan.surfaces().normals();
  Points points;
  for (std::size_t i = 0; i < all.size() && i < normals.size(); ++i)
    if (std::abs(normals[i].cast<double>().dot(up)) < kUpright)
      points.push_back(all[i]);
  return points.size() < kFew ? all : points;
}

PlaceReport
placeOfPair(const PlaceSettings& s, ProgressBar& bar)
{
  const NearScan a = readNear(s.scan_a, s.format, bar);
  const NearScan b = readNear(s.scan_b, s.format, bar);
  PreparedScans scans(2,
                      deriveScanParameters(s.parameters, {a.points, b.points}),
                      s.search.num_threads);
  scans.set(0, a.points, s.scan_a);
  scans.set(1, b.points, s.scan_b);
  const PlaceableScan first(scans.scans()[0]), second(scans.scans()[1]);
  const PlaceResult found = placeScan(first, second, s.search);
  PlaceReport report;
  report.of_what = "of B from A";
  report.answer = found.answer;
  report.rejection = found.rejection;
  report.ambiguity = found.ambiguity();
  report.voxel = scans.parameters().voxel.value;
  for (const PlaceCandidate& one : found.candidates) {
    FoundPlace& place = report.places.emplace_back();
    place.pose = farPose(one.T_first_second, a, b);
    place.score = one.score;
    place.overlap = one.overlap;
    place.contradiction = one.contradiction;
    place.evaluated = toString(one.test_result.trust);
    place.candidate = one;
  }
  if (scans.firstLike(1) == 0 && report.answer == PlaceAnswer::kUnique) {
    report.answer = PlaceAnswer::kNone;
    report.rejection = RejectReason::kSamePoints;
  }
  takeDrawn(first, second, report);
  return report;
}

int
runPlace(const std::vector<std::string>& arguments)
{
  PlaceSettings s;
  if (!parse(arguments, s))
    return kDone;
  ProgressBar bar(s.quiet);
  const auto report = s.isInRun() ? placeInRun(s, bar) : placeOfPair(s, bar);
  if (!report) {
    bar.warn("interrupted; nothing is written");
    return kInterrupted;
  }
  for (const std::string& note : report->notes)
    bar.warn(note);
  printPlaces(s, *report);
  flushOutput();
  if (!s.output.empty())
    writePlaces(s, *report);
  const bool is_drawn = s.picture.empty() || drawPlaces(s, *report, bar);
  return report->answer == PlaceAnswer::kUnique && is_drawn ? kDone : kDoubtful;
}

} // namespace pcl6d::app
