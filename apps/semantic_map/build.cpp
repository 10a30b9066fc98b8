// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/open_scans.h"
#include "common/options/option_table.h"
#include "common/process/interrupt.h"
#include "common/progress_bar.h"
#include "semantic_map/finished_run.h"
#include "semantic_map/verbs.h"

#include <pcl6d/common/require.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/plane_io.h>
#include <pcl6d/io/scan_writer.h>
#include <pcl6d/io/text.h>
#include <pcl6d/semantic_map/object_observations.h>
#include <pcl6d/semantic_map/semantic_map_builder.h>
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
      .help("planes.json; by default the file of the run, else planes are found in the "
            "scans");
  table.add("objects FILE", &s.objects)
      .help(
          "objects.json; by default the file of the run, else the map has no objects");
  table.add("model MODEL", &s.models)
      .composing()
      .multitoken()
      .help("look for objects in the scans: a mesh, a cloud or a folder of the model "
            "store, like in pcl_slam6d_objects locate; several may follow");
  table.add("store DIR", &s.store)
      .help("look for the models of a store, for example share/models");
  table.add("rules FILE", &s.rules)
      .help("rules of labels (share/rules); by default the book's");
  table.group("Output");
  table.add("output,o FILE", &s.output).help("by default semantic_map.json in RUN_DIR");
  table.add("cloud FILE", &s.cloud)
      .help(".pcd or .ply: the points with label, plane_id, object_id; by default "
            "semantic_map.pcd in RUN_DIR");
  table.group("Run");
  table.add("keep-observations", &s.keep_observations)
      .help("do not merge objects seen by several scans at one place");
  table.addAs<int>("threads N", &s.threads)
      .within(0, kNoBound, ">= 0")
      .help("0: a thread per core; never changes the result");
  table.add("quiet", &s.quiet).help("print errors only");
}

/** \brief Checks that no input is overwritten. \throws UsageError */
void
checkOutputs(const BuildSettings& s)
{
  const fs::path folder = s.run;
  std::vector<std::string> inputs{s.run, s.planes, s.objects, s.rules};
  for (const char* const name :
       {"planes.json", "objects.json"}) // also of other programs
    inputs.push_back((folder / name).string());
  refuseInputs(s.output, inputs);
  refuseInputs(s.cloud, inputs, "an input", "--cloud");
  refuseSameOutput("--output", s.output, "--cloud", s.cloud);
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
    throw UsageError("--objects gives the objects and excludes --model and --store");
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

/** The file named by an option, or else the run's file; empty without either. */
fs::path
fileOf(const std::string& option, const fs::path& of_run)
{
  return option.empty() && text::isThere(of_run) ? of_run : fs::path(option);
}

/** Adds the objects of the given file, of models found in the scans (see
 * pcl_slam6d_objects), or of objects.json in the run's folder.
 * \return their source, for messages \throws Interrupted */
std::string
addObjects(const BuildSettings& s,
           ProgressBar& bar,
           const Interrupt& interrupt,
           SemanticMapBuilder& builder)
{
  if (!s.models.empty() || !s.store.empty()) {
    ObjectFinderOptions options;
    options.localizer.num_threads = s.threads;
    const ObjectFinder finder(readModels(s.models, s.store), options);
    const auto found = observeObjects(
        finder, openScans(s.run, {}, bar), {0, 0}, watched(bar, interrupt));
    builder.setObjects(found.observations);
    return "found in the scans";
  }
  const fs::path file = fileOf(s.objects, fs::path(s.run) / "objects.json");
  if (file.empty())
    return "none given";
  builder.setObjects(readMapObjects(file), file.string());
  return file.string();
}

/** Adds the planes of the given file, of planes.json in the run's folder, or found in
 * its scans, labelled and refined (book 7.1; see pcl_slam6d_planes).
 * \return their source, for messages \throws Interrupted */
std::string
addPlanes(const BuildSettings& s,
          ProgressBar& bar,
          const Interrupt& interrupt,
          SemanticMapBuilder& builder)
{
  const auto rules = [&s] {
    return s.rules.empty() ? bookRules() : readLabelRules(s.rules);
  };
  const fs::path file = fileOf(s.planes, fs::path(s.run) / "planes.json");
  if (!file.empty()) {
    builder.setPlanes(readPlanes(file), rules);
    return file.string();
  }
  PlaneFinderOptions options;
  options.rules = rules();
  options.refine = true;
  options.num_threads = s.threads;
  const RegisteredScans scans = openScans(s.run, {}, bar);
  const ScanParameters parameters = sceneParameters(scans, {}, watched(interrupt));
  bar.say(parameterLine("voxel", parameters.voxel));
  const SceneCloud cloud = joinScans(scans, parameters, watched(bar, interrupt));
  builder.setPlanes(PlaneFinder(options).find(cloud), cloud.world_offset);
  return "found in the scans";
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
  flushOutput();
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
  for (const auto& output : {s.output, s.cloud})
    requireWritable(output);
  SemanticMap scans;
  scans.scans = run.scans();
  scans.links = run.readLinks();
  scans.world_offset = run.worldOffset();
  Scan cloud = run.readMap();
  SemanticMapBuilderOptions options;
  options.fuse = !s.keep_observations;
  options.num_threads = s.threads;
  SemanticMapBuilder builder(std::move(scans), options);
  try {
    const Interrupt interrupt;
    const std::string objects = addObjects(s, bar, interrupt, builder);
    bar.say("planes: " + addPlanes(s, bar, interrupt, builder));
    bar.say("objects: " + objects);
  } catch (const Interrupted&) {
    bar.say("interrupted while reading; nothing is written");
    return kInterrupted;
  }
  builder.build(
      cloud.points,
      [&run](std::size_t i) { return run.readScan(i).points; },
      [&bar](const Progress& progress) { bar.show(progress); });
  const SemanticMap& map = builder.map();
  addLabelFields(builder.labels(), map.labelNames(), cloud.cloud);
  writeScan(s.cloud, cloud.cloud);
  writeSemanticMap(s.output, map);
  if (!s.quiet)
    printResult(map, s);
  return kDone;
}

} // namespace pcl6d::app
