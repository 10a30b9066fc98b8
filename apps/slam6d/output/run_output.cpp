// SPDX-License-Identifier: BSD-3-Clause
#include "common/output/plane_file_names.h"
#include "common/output/run_files.h"
#include "slam6d/input/sweep_tracking.h"
#include "slam6d/output/planes_of_run.h"
#include "slam6d/output/run_output.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/version.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/run/run_summary.h>
#include <pcl6d/run/run_writer.h>
#include <pcl6d/run/written_files.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

namespace pcl6d::app {

namespace {
constexpr const char* kProgram = "pcl_slam6d";

/** \return the values of the field "intensity" of any type; empty if missing */
std::vector<float>
intensitiesOf(const pcl::PCLPointCloud2& cloud)
{
  const auto field = fieldValues(cloud, "intensity");
  if (!field)
    return {};
  return {field->values.begin(), field->values.end()};
}

std::vector<RunResult::Option>
optionsOf(const Settings& settings, const Slam6DParameters& parameters)
{
  std::vector<RunResult::Option> options;
  for (const auto& word : settings.words)
    options.push_back({word.name, word.value, word.given ? "given" : "default", ""});
  for (const auto& [name, unit, parameter] : named(parameters, settings)) {
    options.push_back({name,
                       text::shortest(parameter.value),
                       parameter.given ? "given" : "derived",
                       parameter.why});
  }
  return options;
}

/** \return the result of a start without poses, in one line */
std::string
textOf(const StartResult& start, std::size_t total)
{
  const std::string of_all = " of " + std::to_string(total) + " scans";
  const std::string way = start.guess == InitialGuess::kOdometry
                              ? "start in the order of the files: "
                          : start.is_continued ? "the other scans in any order: "
                                               : "start in any order: ";
  if (!start.is_complete)
    return way + "given up: too many scans could not be matched with the scan before";
  return way + std::to_string(start.registered) + of_all + " registered, " +
         std::to_string(start.connected) + " connected" +
         (start.is_kept ? ", kept" : ", not kept");
}
/** \return what a bounded recovery left out, in words; empty: nothing */
std::string
textOf(const RecoveryLeftOut& left_out)
{
  std::string text;
  const auto add = [&](bool is_left_out, const std::string& what) {
    if (is_left_out)
      text += (text.empty() ? "" : ", ") + what;
  };
  add(left_out.searches > 0,
      "the search around " + text::counted(left_out.searches, "scan"));
  add(left_out.pairs > 0, text::counted(left_out.pairs, "likely pair") + " of scans");
  add(left_out.scans > 0, "pairs with " + text::counted(left_out.scans, "lost scan"));
  add(left_out.is_second_look,
      "the second registration of what the verdict contradicts");
  return text;
}
} // namespace

std::string
timingOf(const RunResult& run, double drawing)
{
  std::ostringstream lines;
  lines << std::fixed << std::setprecision(2);
  const auto line = [&](const std::string& name, double seconds) -> std::ostream& {
    return lines << "  " << std::left << std::setw(24) << name << std::right
                 << std::setw(9) << seconds << " s";
  };
  double all = 0;
  for (const RunResult::Stage& stage : run.stages) {
    line(stage.name, stage.seconds)
        << std::setw(8) << std::lround(stage.peak_memory_mb) << " MB at most so far\n";
    all += stage.seconds;
    if (stage.name != "matching")
      continue;
    double rest = stage.seconds;
    for (const StageResult& part : run.graph_stages) {
      const bool is_first = part.kind == StageKind::kMatching;
      line(is_first ? "  scan after scan" : std::string("  ") + toString(part.kind),
           part.seconds)
          << (part.reverted ? "  reverted: " + toWords(part.rejection) : "") << '\n';
      rest -= part.seconds;
    }
    line("  loops, verdict", std::max(0.0, rest)) << '\n';
  }
  if (drawing > 0)
    line("pictures", drawing) << '\n';
  line("together", all + drawing) << '\n';
  return lines.str();
}

OutputRules
runFolderRules(const Settings& settings, const ScanFolder& folder)
{
  OutputRules rules;
  rules.folder = settings.out;
  rules.inputs = settings.inputs;
  rules.inputs.insert(rules.inputs.end(),
                      {settings.folder.poses_file,
                       settings.graph_in,
                       settings.control.points,
                       settings.control.targets});
  for (std::size_t i = 0; i < folder.size(); ++i)
    if (std::error_code error; std::filesystem::is_symlink(folder.file(i), error))
      rules.inputs.push_back(folder.file(i)); // its target may be in OUT
  rules.inputs.insert(
      rules.inputs.end(), settings.joined.begin(), settings.joined.end());
  rules.program = kProgram;
  rules.marker = "summary.json";
  rules.files = std::regex(runFilePattern() +
                           "|(objects|semantic_map)\\.json|"
                           "semantic_map\\.(pcd|ply)|"
                           "top_view\\.png|report\\.html|survey(_[a-z]+)?\\.(html|csv|"
                           "xml|pdf)|pictures/[a-z-]+\\.png|" +
                           planeFilePattern());
  rules.force = settings.force;
  rules.journal = ".pcl6d-journal";
  return rules;
}

bool
holdsCompleteRun(const OutputFolder& out)
{
  if (!out.holdsEarlierRun())
    return false;
  try {
    return readRunSummary(out.folder() / "summary.json").complete;
  } catch (const IoFailed&) {
    return true;
  }
}

RunOutput::RunOutput(const Settings& settings,
                     const RunInput& input,
                     const Slam6D& slam,
                     const OutputFolder& out,
                     ProgressBar& bar,
                     const Interrupt& interrupt)
: settings_(settings)
, input_(input)
, folder_(input.folder)
, result_(slam.result())
, moving_(settings.moving, slam)
, out_(out)
, bar_(bar)
, interrupt_(interrupt)
{}

const RunResult&
RunOutput::write(bool complete, const RunLog& log, KeptClouds& clouds)
{
  describe(complete, log);
  const RunWriter writer(out_.staging(), run_);
  writer.writePoses(folder_.stamps());
  const double voxel = result_.parameters.voxel.value;
  MapBuilder map(voxel, run_.world_offset);
  if (complete) {
    if (!result_.stages.empty())
      writer.writeGraph(result_.graph);
    writer.writeVerification();
    writer.writeControl();
    MapBuilder fine_map(planeVoxel(voxel), run_.world_offset);
    run_.complete = writeScans(clouds, map, settings_.planes ? &fine_map : nullptr);
    if (run_.complete && settings_.planes)
      writePlanesOf(fine_map);
    if (run_.complete)
      run_.moving = moving_.result();
    run_.map_points = run_.complete ? map.points().size() : 0;
  }
  run_.trusted =
      run_.complete && result_.trusted() && (!run_.drive || run_.drive->lost.empty());
  run_.verdict = verdictOf(run_) + (log.joined.empty() ? "" : '\n' + log.joined);
  run_.files = writtenFiles(out_.staging());
  writer.writeSummary();
  requireAllFiles();
  return run_;
}

/** A cleaning job may have removed hidden folders during the run. */
void
RunOutput::requireAllFiles() const
{
  if (!run_.complete)
    return;
  const auto missing = RunFolder(out_.staging(), run_).missing();
  if (!missing.empty())
    throw IoFailed((out_.staging() / missing.front()).string() +
                   ": was removed while the run was written");
}

void
RunOutput::describe(bool complete, const RunLog& log)
{
  std::vector<std::string> files;
  std::vector<int> indices;
  for (std::size_t i = 0; i < folder_.size(); ++i) {
    files.push_back(folder_.name(i));
    indices.push_back(folder_.index(i));
  }
  run_ = runResultOf(result_, files, indices);
  run_.generator = kProgram;
  run_.version = PCL6D_VERSION;
  run_.pose_source = folder_.poseSource();
  run_.moved = folder_.moved();
  if (run_.moved)
    run_.warnings.push_back(folder_.coordinates());
  run_.warnings.insert(run_.warnings.end(), log.warnings.begin(), log.warnings.end());
  run_.options = optionsOf(settings_, result_.parameters);
  run_.stages = log.stages;
  for (std::size_t i = 0; i < folder_.size(); ++i)
    run_.scans[i].dropped = log.dropped[i];
  run_.complete = complete;
  describeDrive();
  warnOfMissingPoses();
  for (const StartResult& start : result_.starts)
    run_.warnings.push_back(textOf(start, run_.scans.size()));
  if (!settings_.without_effect.empty())
    run_.warnings.push_back(settings_.without_effect);
  if (settings_.slam.initial_guess == InitialGuess::kOverlap)
    warnOfOdometry();
  warnOfBoundedRecovery();
}

/** Warns about initial poses that are missing, or all equal. */
void
RunOutput::warnOfMissingPoses()
{
  if (folder_.posesDiffer() || folder_.size() == 1)
    return;
  if (folder_.hasPoses()) {
    if (settings_.auto_guess)
      run_.warnings.push_back("the initial poses (" + folder_.poseSource() +
                              ") are all equal, and count as missing");
    return;
  }
  const bool is_followed =
      settings_.slam.motion.gives_poses &&
      std::any_of(run_.scans.begin(), run_.scans.end(), [](const ScanResult& scan) {
        return scan.motion && scan.motion->deskewed;
      });
  // An interrupted run may have no pose that was found.
  const bool is_tried =
      !result_.starts.empty() ||
      (!run_.complete && isWithoutPrior(settings_.slam.initial_guess));
  run_.warnings.push_back(
      is_followed ? "no initial poses were found: each scan starts from the scan "
                    "before, by the motion found"
      : is_tried  ? "no initial poses were found"
      : isWithoutPrior(settings_.slam.initial_guess)
          ? "no initial poses were found: place recognition found the poses"
          : "no initial poses were found: each scan starts at the pose of the scan "
            "before, suited only to scans taken close together; give poses with "
            "--poses or odometry.txt");
}

/** Moves the sweeps between the scans of the map together with these scans. */
void
RunOutput::describeDrive()
{
  if (!input_.drive)
    return;
  run_.drive = input_.drive;
  followKeyframes(run_.scans, *run_.drive);
}

/** Warns of lost scans that a longer search may find. */
void
RunOutput::warnOfBoundedRecovery()
{
  if (settings_.slam.recovery != RecoveryEffort::kBounded)
    return;
  const std::size_t lost = result_.count(ScanState::kPredicted);
  if (lost > 0 && !isWithoutPrior(settings_.slam.initial_guess))
    run_.warnings.push_back(
        text::counted(lost, "scan") + (lost == 1 ? " was" : " were") +
        " searched only at the likeliest places; --recovery " +
        toString(RecoveryEffort::kThorough) + " searches everywhere, and takes longer");
  const std::string left_out = textOf(result_.left_out);
  if (!left_out.empty())
    run_.warnings.push_back("recovery of lost scans left out: " + left_out);
}

/** Warns of scans for which the overlap search found no unambiguous pose. */
void
RunOutput::warnOfOdometry()
{
  std::string names;
  std::size_t count = 0;
  for (std::size_t i = 1; i < run_.scans.size(); ++i) {
    const ScanResult& scan = run_.scans[i];
    if (scan.start != InitialGuess::kOdometry || scan.state == ScanState::kPending ||
        scan.state == ScanState::kPredicted || scan.recovered != RecoveredBy::kNone)
      continue;
    if (++count <= 5)
      names += (names.empty() ? "" : ", ") + scan.file;
  }
  if (count > 0)
    run_.warnings.push_back(
        "the overlap search was not sure of " + text::counted(count, "scan") +
        ", started from the odometry: " + names + (count > 5 ? ", ..." : ""));
}

/** Writes scans/ and map.pcd, and gives the clouds up. \return false if interrupted */
bool
RunOutput::writeScans(KeptClouds& clouds, MapBuilder& map, MapBuilder* fine_map)
{
  MapBuilder moving_map(planeVoxel(result_.parameters.voxel.value), run_.world_offset);
  const StageTimer timer("writing", run_.stages);
  const RunWriter writer(out_.staging(), run_);
  // A few scans at a time: written in parallel, joined in their order.
  constexpr std::size_t kBatch = 8;
  for (std::size_t begin = 0; begin < clouds.size(); begin += kBatch) {
    if (interrupt_.requested()) {
      out_.discard("scans");
      return false;
    }
    const std::size_t end = std::min(begin + kBatch, clouds.size());
    std::vector<pcl::PCLPointCloud2> batch;
    std::vector<Points> standing;
    for (std::size_t i = begin; i < end; ++i) {
      batch.push_back(clouds.take(i, run_.scans[i].motion));
      const auto moved = moving_.apply(i, batch.back());
      standing.push_back(moved.standing);
      moving_map.addScan(moved.moving,
                         {},
                         run_.scans[i].T_world_scan,
                         static_cast<std::uint32_t>(run_.scans[i].index));
    }
    parallelFor(batch.size(), settings_.slam.num_threads, [&](std::size_t k) {
      writer.writeScan(begin + k, batch[k]);
    });
    for (std::size_t i = begin; i < end; ++i) {
      const pcl::PCLPointCloud2 cloud = std::exchange(batch[i - begin], {});
      Points points = std::move(standing[i - begin]);
      maskOutOfRange(result_.parameters.min_range.value,
                     result_.parameters.max_range.value,
                     points);
      const ScanResult& scan = run_.scans[i];
      map.addScan(points,
                  intensitiesOf(cloud),
                  scan.T_world_scan,
                  static_cast<std::uint32_t>(scan.index));
      if (fine_map)
        fine_map->addScan(points, {}, scan.T_world_scan, static_cast<std::uint32_t>(i));
    }
    bar_.show({"writing", end, clouds.size()});
  }
  writer.writeMap(map.cloud());
  if (!moving_map.points().empty())
    writer.writeMoving(moving_map.cloud());
  return true;
}

void
RunOutput::writePlanesOf(const MapBuilder& map)
{
  const StageTimer timer("planes", run_.stages);
  std::vector<Eigen::Isometry3d> poses;
  for (const ScanResult& scan : run_.scans)
    poses.push_back(scan.T_world_scan);
  planesOfRun()({map,
                 poses,
                 run_.world_offset,
                 settings_.slam.num_threads,
                 out_.staging(),
                 run_.generator});
}

} // namespace pcl6d::app
