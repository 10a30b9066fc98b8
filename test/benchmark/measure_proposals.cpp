// SPDX-License-Identifier: BSD-3-Clause
// How many objects of scans with truth the proposals cover (IoU over points above 0.5), and
// how long they take. Usage: measure_proposals [threads=N] [truth=objects_truth.json]
// [dump=FOLDER] SCAN.pcd... Truth is a field `label` (label / 10, 0 and 1: none) or
// `object_id` (0: none); objects_truth.json of pcl_slam6d_simulate tells the classes.
#include "support/proposal_scores.h"

#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace {
using namespace pcl6d;
namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Settings {
  unsigned int threads = 0;
  std::string truth;
  fs::path dump;
  std::vector<fs::path> scans;
};

/** The truth of a scan. */
struct Truth {
  std::vector<std::uint32_t> object_of;
  bool is_table = false; // of a depth camera; else a lidar's
};

struct Tally {
  int objects = 0, covered = 0, by_wholes = 0, by_leaves = 0;

  void
  add(const test::ObjectCover& cover)
  {
    ++objects;
    covered += cover.iou > 0.5;
    by_wholes += cover.whole_iou > 0.5;
    by_leaves += cover.leaf_iou > 0.5;
  }
};

Settings
parse(int argc, char** argv)
{
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::string value = word.substr(word.find('=') + 1);
    if (word.rfind("threads=", 0) == 0)
      settings.threads = static_cast<unsigned int>(std::atoi(value.c_str()));
    else if (word.rfind("truth=", 0) == 0)
      settings.truth = value;
    else if (word.rfind("dump=", 0) == 0)
      settings.dump = value;
    else
      settings.scans.emplace_back(word);
  }
  return settings;
}

Truth
truthOf(const Scan& scan)
{
  Truth truth;
  const auto labels = fieldValues(scan.cloud, "label");
  const auto ids = fieldValues(scan.cloud, "object_id");
  truth.is_table = !ids;
  for (std::size_t i = 0; i < scan.points.size(); ++i)
    truth.object_of.push_back(ids ? static_cast<std::uint32_t>(ids->values[i])
                              : labels
                                  ? static_cast<std::uint32_t>(labels->values[i]) / 10
                                  : 0);
  return truth;
}

/** Of each point the proposal, plus one; of several the last, which is a part. */
void
dump(const fs::path& file,
     const Scan& scan,
     const std::vector<ObjectProposal>& proposals)
{
  std::vector<std::uint32_t> ids(scan.points.size(), 0);
  for (std::size_t k = 0; k < proposals.size(); ++k)
    for (const auto i : proposals[k].points)
      ids[i] = static_cast<std::uint32_t>(k + 1);
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(ids.data()),
            static_cast<std::streamsize>(ids.size() * sizeof(ids[0])));
}

std::vector<std::string>
classesOf(const std::string& file)
{
  std::vector<std::string> classes;
  if (file.empty())
    return classes;
  std::ifstream in(file);
  const auto document = nlohmann::json::parse(in);
  for (const auto& object : document["objects"])
    classes.push_back(object["class"]);
  return classes;
}

void
print(const std::string& name, const Tally& t)
{
  std::printf("| %s | %d | %d | %.3f | %d | %d |\n",
              name.c_str(),
              t.objects,
              t.covered,
              t.objects == 0 ? 0.0 : double(t.covered) / t.objects,
              t.by_wholes,
              t.by_leaves);
}
} // namespace

int
main(int argc, char** argv)
try {
  const Settings settings = parse(argc, argv);
  if (settings.scans.empty())
    return std::puts("usage: measure_proposals [threads=N] [truth=FILE] [dump=FOLDER] "
                     "SCAN.pcd..."),
           2;
  const auto classes = classesOf(settings.truth);
  std::map<std::string, Tally> by_class;
  Tally all;
  for (const auto& file : settings.scans) {
    const Scan scan = readScan(file);
    const Truth truth = truthOf(scan);
    const auto start = Clock::now();
    const PlaneCloud cloud(scan.points, settings.threads);
    const auto planes = segmentPlanes(cloud);
    const auto middle = Clock::now();
    ProposalOptions options;
    options.num_threads = settings.threads;
    const auto proposals = proposeObjects(cloud, planes, options);
    const auto end = Clock::now();
    if (!settings.dump.empty())
      dump(settings.dump / (file.stem().string() + ".ids"), scan, proposals);
    std::printf("%s: %zu points, %zu planes in %.3f s, %zu proposals in %.3f s\n",
                file.filename().c_str(),
                scan.points.size(),
                planes.planes.size(),
                std::chrono::duration<double>(middle - start).count(),
                proposals.size(),
                std::chrono::duration<double>(end - middle).count());
    const double cell = truth.is_table ? 0.015 : 0.2;
    for (const auto& cover :
         test::coverOf(scan.points, truth.object_of, proposals, 50, cell)) {
      all.add(cover);
      const std::string name =
          cover.id <= classes.size() ? classes[cover.id - 1] : "object";
      by_class[name].add(cover);
      std::printf("  %s %u: %zu points, IoU %.2f, of a whole %.2f, of a leaf %.2f\n",
                  name.c_str(),
                  cover.id,
                  cover.points.size(),
                  cover.iou,
                  cover.whole_iou,
                  cover.leaf_iou);
    }
  }
  std::puts("| class | objects | covered | share | by wholes | by leaves |");
  for (const auto& [name, tally] : by_class)
    print(name, tally);
  print("all", all);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "measure_proposals: error: %s\n", e.what());
  return 1;
}
