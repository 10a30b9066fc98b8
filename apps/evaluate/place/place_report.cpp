// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "evaluate/place/place_report.h"
#include "evaluate/result_json.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/visualization/convergence_strip.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace pcl6d::app {

namespace {
/** \return x y z [m] roll pitch yaw [deg], the format of --pose and --guess */
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
printTable(const PlaceReport& report)
{
  std::printf("%4s %8s %8s %13s  %-10s  pose %s: x y z [m] roll pitch yaw [deg]\n",
              "",
              "score",
              "overlap",
              "contradicted",
              "verdict",
              report.of_what.c_str());
  for (std::size_t i = 0; i < report.places.size(); ++i) {
    const FoundPlace& one = report.places[i];
    std::printf("%4zu %8.4f %6.1f %% %11.2f %%  %-10s  %s\n",
                i + 1,
                one.score,
                100 * one.overlap,
                100 * one.contradiction,
                one.evaluated.c_str(),
                poseText(one.pose).c_str());
  }
}

/** Prints the links of the scans of a run with the best pose, and its accuracy. */
void
printLinks(const PlaceReport& report)
{
  for (const LinkWords& one : report.places.front().links)
    std::printf("meets %s: %s%s%s (%zu of %zu patches contradicted)\n",
                one.file.c_str(),
                toString(one.link.trust),
                one.link.rejection ? ", " : "",
                toWords(one.link.rejection).c_str(),
                one.link.contradicted,
                one.link.patches);
  if (!report.exactness)
    return;
  const auto sigma = [&](int k) {
    return std::sqrt(std::max(0.0, report.exactness->covariance(k, k)));
  };
  std::printf("standard deviations: %.4f %.4f %.4f m, %.3f %.3f %.3f deg; the position "
              "is known to %.3f m with 95 %%, if the map is right\n",
              sigma(0),
              sigma(1),
              sigma(2),
              degrees(sigma(3)),
              degrees(sigma(4)),
              degrees(sigma(5)),
              report.exactness->bound);
}

Json
rowsOf(const Eigen::Isometry3d& pose)
{
  Json rows = Json::array();
  for (int k = 0; k < 16; ++k)
    rows.push_back(pose.matrix()(k / 4, k % 4));
  return rows;
}

Json
jsonOfPair(const FoundPlace& place)
{
  const PlaceCandidate& one = place.candidate;
  return {{"T_a_b", rowsOf(place.pose)},
          {"score", one.score},
          {"overlap", one.overlap},
          {"violations", one.contradiction},
          {"patches", one.evidence.sight.patches},
          {"result", toString(one.test_result.trust)},
          {"probability_wrong", one.test_result.probability_wrong},
          {"reason", toWords(one.test_result.rejection)}};
}

Json
jsonInRun(const FoundPlace& place)
{
  Json links = Json::array();
  for (const LinkWords& one : place.links)
    links.push_back({{"file", one.file},
                     {"index", one.index},
                     {"result", toString(one.link.trust)},
                     {"probability_wrong", one.link.probability_wrong},
                     {"patches", one.link.patches},
                     {"violated", one.link.contradicted},
                     {"shift", one.link.shift},
                     {"deviation", one.link.deviation},
                     {"reason", toWords(one.link.rejection)}});
  return {{"T_world_scan", rowsOf(place.pose)},
          {"score", place.score},
          {"overlap", place.overlap},
          {"violations", place.contradiction},
          {"result", place.evaluated},
          {"reason", toWords(place.rejection)},
          {"links", links}};
}

Json
exactnessJson(const std::optional<PlaceExactness>& exactness)
{
  if (!exactness)
    return {{"covariance", nullptr}, {"bound", nullptr}};
  Json rows = Json::array();
  for (int k = 0; k < 36; ++k)
    rows.push_back(exactness->covariance(k / 6, k % 6));
  return {{"covariance", rows}, {"bound", exactness->bound}};
}

std::string
captionOf(const FoundPlace& place)
{
  char text[120];
  std::snprintf(text,
                sizeof text,
                "overlap %.0f %%, contradicted %.1f %%, %s",
                100 * place.overlap,
                100 * place.contradiction,
                place.evaluated.c_str());
  return text;
}

/** \return number of poses to draw: three, and further rivals of the best */
std::size_t
panelsOf(const PlaceReport& report)
{
  constexpr std::size_t kAlways = 3, kMost = 9;
  constexpr double kRival = 0.1; // of the best score
  std::size_t count = std::min(report.places.size(), kAlways);
  while (count < std::min(report.places.size(), kMost) &&
         report.places[count].score > kRival * report.places.front().score)
    ++count;
  return count;
}

ConvergenceStripScene
sceneOf(const PlaceSettings& s, const PlaceReport& report)
{
  namespace fs = std::filesystem;
  const auto nameOf = [](const std::string& path) {
    const fs::path normal = fs::absolute(path).lexically_normal();
    return (normal.has_filename() ? normal : normal.parent_path()).filename().string();
  };
  const bool in_run = s.isInRun();
  ConvergenceStripScene scene;
  scene.title = nameOf(in_run ? s.scan_a : s.scan_b) + " (orange) " +
                (in_run ? "in " : "on ") + nameOf(in_run ? s.scan_b : s.scan_a) +
                " (grey): " + toString(report.answer) + (report.rejection ? ", " : "") +
                toWords(report.rejection);
  scene.scan = report.drawn_scan;
  for (std::size_t i = 0; i < panelsOf(report); ++i) {
    char title[40];
    std::snprintf(
        title, sizeof title, "%zu: score %.3f", i + 1, report.places[i].score);
    scene.steps.push_back({title,
                           captionOf(report.places[i]),
                           report.places[i].T_drawn_scan,
                           report.drawn_map});
  }
  return scene;
}
} // namespace

void
printPlaces(const PlaceSettings& s, const PlaceReport& report)
{
  if (!s.quiet && !report.places.empty()) {
    printTable(report);
    printLinks(report);
    std::printf("voxel %g m\n", report.voxel);
  }
  if (report.answer == PlaceAnswer::kUnique)
    std::printf("unique: %s\n", poseText(report.places.front().pose).c_str());
  else
    std::printf("%s: %s\n", toString(report.answer), toWords(report.rejection).c_str());
}

void
writePlaces(const PlaceSettings& s, const PlaceReport& report)
{
  const bool in_run = s.isInRun();
  Json candidates = Json::array();
  for (const FoundPlace& place : report.places)
    candidates.push_back(in_run ? jsonInRun(place) : jsonOfPair(place));
  Json json = {{"schema_version", 2},
               {in_run ? "scan" : "scan_a", s.scan_a},
               {in_run ? "run" : "scan_b", s.scan_b},
               {"voxel", report.voxel},
               {"answer", toString(report.answer)},
               {"reason", toWords(report.rejection)},
               {"ambiguity", report.ambiguity}};
  if (in_run) {
    json.update(exactnessJson(report.exactness));
    json["same_as"] = report.same_as.empty() ? Json() : Json(report.same_as);
    json["scans_compared"] = report.compared;
    json["scans_placed"] = report.placed;
  }
  json["candidates"] = candidates;
  writeJson(s.output, json, 2);
}

bool
drawPlaces(const PlaceSettings& s, const PlaceReport& report, ProgressBar& bar)
{
  if (report.places.empty()) {
    bar.warn("no " + s.picture + ": no candidate to show");
    return true;
  }
  try {
    ConvergenceStripOptions options;
    options.columns = static_cast<int>(std::min<std::size_t>(panelsOf(report), 3));
    writePng(s.picture, ConvergenceStrip(options).draw(sceneOf(s, report)).image);
  } catch (...) {
    bar.warn("no " + s.picture + ": " + wordsOfCurrent());
    return false;
  }
  return true;
}

} // namespace pcl6d::app
