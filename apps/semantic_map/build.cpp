// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/interrupt.h"
#include "common/option_table.h"
#include "common/progress_bar.h"
#include "semantic_map/labelled_clouds.h"
#include "semantic_map/scene_parts.h"
#include "semantic_map/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/semantic_map/find_rooms.h>
#include <pcl6d/semantic_map/map_relations.h>
#include <pcl6d/semantic_map/object_fusion.h>
#include <pcl6d/semantic_map/semantic_map_io.h>

#include <cstdio>

namespace pcl6d::app {
namespace {
namespace fs = std::filesystem;

struct BuildSettings {
  std::string run;
  std::string output;
  std::string cloud;
  std::string planes;
  std::string objects;
  std::vector<std::string> models;
  std::string store;
  std::string rules;
  bool keep_observations = false;
  bool quiet = false;
  unsigned int threads = 0;
};

void
addOptions(OptionTable& table, BuildSettings& s)
{
  table.positional("RUN_DIR", &s.run);
  table.group("Input");
  table.add("planes FILE", &s.planes)
      .help("planes.json; by default that of the run, else planes are found in its "
            "scans");
  table.add("objects FILE", &s.objects)
      .help("objects.json; by default that of the run, else there are no objects");
  table.add("model MODEL", &s.models)
      .composing()
      .multitoken()
      .help("look for objects in the scans: a mesh, a cloud or a folder of the model "
            "store, as of pcl_slam6d_objects locate; several may follow");
  table.add("store DIR", &s.store)
      .help("look for all models of a store, such as share/models");
  table.add("rules FILE", &s.rules)
      .help("rules of labels (share/rules); by default the book's");
  table.group("Output");
  table.add("output,o FILE", &s.output).help("by default semantic_map.json in RUN_DIR");
  table.add("cloud FILE", &s.cloud)
      .help(".pcd or .ply: the points with label, plane_id, object_id; by default "
            "semantic_map.pcd in RUN_DIR");
  table.group("Run");
  table.add("keep-observations", &s.keep_observations)
      .help("do not make one object of what several scans saw at one place");
  table.addAs<int>("threads N", &s.threads)
      .within(0, kNoBound, ">= 0")
      .help("0: one per core; never changes the result");
  table.add("quiet", &s.quiet).help("print errors only");
}

/** \brief Makes sure that no input is overwritten. \throws UsageError */
void
checkOutputs(const BuildSettings& s)
{
  const fs::path folder = s.run;
  std::vector<fs::path> inputs{s.planes, s.objects, s.rules};
  for (const char* const name : {"map.pcd",
                                 "summary.json",
                                 "links.csv",
                                 "graph.g2o",
                                 "planes.json",
                                 "objects.json"})
    inputs.push_back(folder / name);
  std::error_code missing;
  for (const auto& out : {s.output, s.cloud})
    for (const auto& in : inputs)
      if (fs::equivalent(out, in, missing))
        throw UsageError(out + " is an input");
  if (fs::absolute(s.output).lexically_normal() ==
      fs::absolute(s.cloud).lexically_normal())
    throw UsageError("--output and --cloud are both " + s.cloud);
}

bool
parse(const std::vector<std::string>& arguments, BuildSettings& s)
{
  OptionTable table(std::string("usage: ") + kSemanticMap +
                    R"( build RUN_DIR [options]
Makes the semantic map of a finished run of pcl_slam6d: its scans and links, planes
with labels, objects, rooms, how they lie to each other, and what each point is.
)");
  addOptions(table, s);
  if (!table.parse(arguments))
    return false;
  if (!s.objects.empty() && (!s.models.empty() || !s.store.empty()))
    throw UsageError(
        "--objects gives the objects; it does not go with --model or --store");
  const fs::path folder = s.run;
  if (s.output.empty())
    s.output = (folder / kMapFile).string();
  if (s.cloud.empty())
    s.cloud = (folder / "semantic_map.pcd").string();
  const ScanFormat format = scanFormatOfExtension(s.cloud);
  if (format != ScanFormat::kPcd && format != ScanFormat::kPly)
    throw UsageError("--cloud = " + s.cloud + ", but must end in .pcd or .ply");
  checkOutputs(s);
  return true;
}

/** \return the objects of a list, each once */
std::vector<MapObject>
fused(const std::vector<MapObject>& observations)
{
  std::vector<MapObject> objects;
  for (const auto& found : fuseObjects(observations))
    objects.push_back(found.object);
  return objects;
}

/** \throws IoFailed an object was seen by a scan that is not of the run */
void
checkScans(const SemanticMap& map, const std::string& source)
{
  for (std::size_t i = 0; i < map.objects.size(); ++i)
    for (const auto id : map.objects[i].scans)
      if (!map.placeOf({EntityKind::kScan, id}))
        throw IoFailed(source + ": object " + std::to_string(i + 1) + ": scan " +
                       std::to_string(id) + ", but the run has no such scan");
}

/** Finds objects, each once, and planes. \return false if interrupted */
bool
addParts(const FinishedRun& run,
         const BuildSettings& s,
         ProgressBar& bar,
         SemanticMap& map)
{
  const Interrupt interrupt;
  const ScenePartsOptions options{
      s.planes, s.objects, s.models, s.store, s.rules, s.threads};
  const auto objects = findObjects(run, options, bar, interrupt);
  if (!objects)
    return false;
  map.objects = objects->parts;
  checkScans(map, objects->source);
  if (!s.keep_observations)
    map.objects = fused(map.objects);
  const auto planes = findPlanes(run, options, bar, interrupt);
  if (!planes)
    return false;
  map.planes = planes->parts;
  bar.say("planes: " + planes->source);
  bar.say("objects: " + objects->source);
  return true;
}

void
printResult(const SemanticMap& map, const BuildSettings& s)
{
  std::printf("scans %zu planes %zu objects %zu storeys %zu rooms %zu relations %zu\n",
              map.scans.size(),
              map.planes.size(),
              map.objects.size(),
              map.storeys.size(),
              map.rooms.size(),
              map.relations.size());
  std::printf("written: %s %s\n", s.output.c_str(), s.cloud.c_str());
  if (std::fflush(stdout) != 0)
    throw IoFailed("cannot write to the standard output");
}
} // namespace

int
runMapBuild(const std::vector<std::string>& arguments)
{
  BuildSettings s;
  if (!parse(arguments, s))
    return kDone;
  ProgressBar bar(s.quiet);
  const FinishedRun run(s.run);
  SemanticMap map;
  map.scans = run.scans();
  map.links = run.readLinks();
  map.world_offset = run.worldOffset();
  const Scan cloud = run.readMap();
  if (!addParts(run, s, bar, map)) {
    bar.say("interrupted while reading; nothing is written");
    return kInterrupted;
  }

  PointLabelOptions label_options;
  label_options.num_threads = s.threads;
  const PointLabeller labeller(map, label_options);
  findScansOfParts(run, labeller, bar, map);
  Eigen::Isometry3d T_world_map = Eigen::Isometry3d::Identity();
  T_world_map.translation() = map.world_offset;
  const PointLabels labels = labeller.label(cloud.points, T_world_map);
  findRooms(map, floorPoints(cloud.points, labels));
  map.relations = findRelations(map);

  writeLabelledMap(s.cloud, cloud, labels, map.labelNames());
  writeSemanticMap(s.output, map);
  if (!s.quiet)
    printResult(map, s);
  return kDone;
}

} // namespace pcl6d::app
