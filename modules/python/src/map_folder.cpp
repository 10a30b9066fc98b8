// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.h"
#include "long_call.h"
#include "scans.h"
#include "slam_results.h"

#include <pcl6d/common/version.h>
#include <pcl6d/filters/map_builder.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/run/run_writer.h>
#include <pcl6d/run/written_files.h>
#include <pcl6d/slam6d/slam6d.h>
#include <pcl6d/sources/open_source.h>

#include <memory>
#include <unistd.h>
#include <utility>

namespace pcl6d::python {

namespace {
namespace fs = std::filesystem;

/** Inputs and options of a run. */
struct Job {
  std::vector<fs::path> inputs;
  fs::path output;
  ScanFolderOptions folder;
  Slam6DOptions slam;
  bool is_guess_given = false;
  OptionWords words;
};

/** A folder beside the output, renamed to the output at the end, or removed. */
class Staging {
public:
  explicit Staging(const fs::path& output)
  : output_(output), path_(output.string() + ".part-" + std::to_string(getpid()))
  {
    std::error_code error;
    if (fs::exists(output_, error) &&
        !(fs::is_directory(output_, error) && fs::is_empty(output_, error)))
      throw IoFailed(
          output_.string() +
          ": exists and is not empty; choose another folder, or remove this folder");
    if (!fs::create_directories(path_, error))
      throw IoFailed(path_.string() + ": cannot be made: " +
                     (error ? error.message() : "already exists; remove the file"));
  }
  ~Staging()
  {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  Staging(const Staging&) = delete;
  Staging&
  operator=(const Staging&) = delete;

  const fs::path&
  path() const
  {
    return path_;
  }
  void
  publish() const
  {
    fs::rename(path_, output_); // takes the place of an empty folder
  }

private:
  fs::path output_, path_;
};

void
registerScans(const ScanFolder& folder, Slam6D& slam, CallWatch& watch)
{
  for (std::size_t i = 0; i < folder.size(); ++i) {
    slam.addScan(folder.read(i).points, folder.initialPose(i), folder.title(i));
    watch.report({"reading", i + 1, folder.size()});
  }
  slam.setProgressCallback(watch.callback());
  slam.optimize();
}

RunResult
describeRun(const ScanFolder& folder, const Slam6DResult& result)
{
  std::vector<std::string> files;
  std::vector<int> indices;
  for (std::size_t i = 0; i < folder.size(); ++i) {
    files.push_back(folder.name(i));
    indices.push_back(folder.index(i));
  }
  RunResult run = runResultOf(result, files, indices);
  run.generator = "pcl_slam6d"; // the owner of the folder format
  run.version = PCL6D_VERSION;
  run.pose_source = folder.poseSource();
  run.moved = folder.moved();
  if (run.moved)
    run.warnings.push_back(folder.coordinates());
  return run;
}

/** Writes scans/ and map.pcd, with one scan in memory at a time. */
void
writeScans(const ScanFolder& folder,
           const Slam6DParameters& used,
           const RunWriter& writer,
           RunResult& run,
           CallWatch& watch)
{
  MapBuilder map(used.voxel.value, run.world_offset);
  for (std::size_t i = 0; i < folder.size(); ++i) {
    Scan scan = folder.read(i);
    writer.writeScan(i, scan.cloud);
    maskOutOfRange(used.min_range.value, used.max_range.value, scan.points);
    std::vector<float> intensities;
    if (const auto field = fieldValues(scan.cloud, "intensity"))
      intensities.assign(field->values.begin(), field->values.end());
    map.addScan(scan.points,
                intensities,
                run.scans[i].T_world_scan,
                static_cast<std::uint32_t>(run.scans[i].index));
    run.scans[i].dropped = scan.dropped;
    watch.report({"writing", i + 1, folder.size()});
  }
  writer.writeMap(map.cloud());
  run.map_points = map.points().size();
}

void
makeRun(Job job, CallWatch& watch)
{
  const ScanFolder folder = openScanFiles(job.inputs, job.folder);
  if (!job.is_guess_given && !folder.posesDiffer()) { // like --initial-guess auto
    job.slam.initial_guess = InitialGuess::kGlobal;
    job.slam.order_first = true;
  }
  const Staging staging(job.output);
  Slam6D slam(job.slam);
  registerScans(folder, slam, watch);
  const Slam6DResult& result = slam.result();
  RunResult run = describeRun(folder, result);
  run.options = usedOptions(job.words, result.parameters);
  const RunWriter writer(staging.path(), run);
  writer.writePoses(folder.stamps());
  if (!result.stages.empty())
    writer.writeGraph(result.graph);
  writer.writeVerification();
  writeScans(folder, result.parameters, writer, run, watch);
  run.trusted = result.trusted();
  run.verdict = verdictOf(run);
  run.files = writtenFiles(staging.path());
  writer.writeSummary();
  staging.publish();
}

void
mapFolder(const py::object& folder,
          const py::object& output,
          const py::dict& reading,
          const py::dict& values,
          const py::object& progress)
{
  const auto job = std::make_shared<Job>();
  Options options(reading);
  job->folder = folderOptions(options);
  options.requireKnown();
  job->inputs = {pathOf(folder, "folder")};
  job->output = pathOf(output, "output");
  job->slam = slamOptions(values);
  job->is_guess_given = values.contains("initial_guess");
  job->words = wordsOf(values);
  runLong(progress, [job](CallWatch& watch) { makeRun(std::move(*job), watch); });
}
} // namespace

void
bindFolderMapping(py::module_& module)
{
  module.def("map_folder", &mapFolder);
}

} // namespace pcl6d::python
