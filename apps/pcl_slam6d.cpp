// SPDX-License-Identifier: BSD-3-Clause
// Registers a folder of scans with rough poses into a map: reads options, runs Slam6D, and writes
// files.
#include "common/app.h"
#include "common/build_id.h"
#include "common/open_scans.h"
#include "common/output/output_folder.h"
#include "common/printable.h"
#include "common/process/interrupt.h"
#include "common/process/memory_budget.h"
#include "common/progress_bar.h"
#include "slam6d/explain.h"
#include "slam6d/input/join.h"
#include "slam6d/input/shared_reading.h"
#include "slam6d/output/live_window.h"
#include "slam6d/output/planes_of_run.h"
#include "slam6d/output/run_drawing.h"
#include "slam6d/output/run_output.h"
#include "slam6d/ranks.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/version.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/text.h>
#include <pcl6d/slam6d/run_journal.h>
#include <pcl6d/slam6d/slam6d.h>

#include <pcl/console/print.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <set>
#include <sstream>

namespace {
using namespace pcl6d;
using app::Settings;

constexpr const char* kName = "pcl_slam6d";

/** The main job: reading, matching, writing. */
class Job {
public:
  /** Tracks the scans of a drive. Several processes track without interruption, because each
   * of them tracks the whole drive.
   * \param[in] ranks the processes that share the work; null: a single process
   * \throws Interrupted a signal came in during tracking */
  Job(const Settings& settings, WorkSharing* ranks)
  : ranks_(ranks)
  , earlier_(app::openEarlier(settings))
  , input_(app::openInput(settings, earlier_, ranks ? nullptr : &interrupt_))
  , folder_(input_.folder)
  , scans_(app::openScans(input_, settings, earlier_))
  , settings_(app::resolved(settings, folder_, earlier_))
  , bar_(settings.quiet)
  , out_(app::runFolderRules(settings, folder_))
  , memory_(settings.memory, out_.staging())
  , clouds_(scans_, memory_.bytes() / 4)
  , window_(settings_.live_view,
            std::string(kName) + ' ' + settings_.inputWords(),
            bar_)
  , slam_(settings_.slam)
  {
    slam_.setSharing(ranks_);
    if (ranks_)
      app::agreeOnInput(*ranks_, kName, settings_, folder_);
  }

  int
  run()
  {
    try {
      return workThrough();
    } catch (const BadArgument&) { // the journal would reject a corrected command
      dropJournal();
      throw;
    } catch (const ComputeFailed&) {
      dropJournal();
      throw;
    }
  }

private:
  int
  workThrough()
  {
    for (const auto& line : app::describeInput(settings_,
                                               scans_,
                                               earlier_,
                                               input_.drive,
                                               ranks_ ? ranks_->numRanks() : 1))
      bar_.say(line);
    if (const auto work =
            app::foreseenWork(settings_, earlier_, scans_.folder().size());
        !work.empty())
      bar_.say(work);
    log_.warnings = earlier_.notes;
    log_.stages = input_.stages;
    if (!readScans()) {
      bar_.say("interrupted while reading; nothing is written");
      return app::kInterrupted;
    }
    if (!earlier_.areJoined())
      openJournal();
    const bool complete = match();
    if (earlier_.areJoined() && !complete)
      return stopJoining();
    app::RunOutput output(settings_, input_, slam_, out_, bar_, interrupt_);
    const RunResult& summary = output.write(complete, log_, clouds_);
    if (earlier_.areJoined() && !summary.complete)
      return stopJoining();
    auto written = publish(summary);
    const app::Drawing drawing =
        app::drawApart(published_, summary, memory_.bytes(), interrupt_);
    written.insert(written.end(), drawing.drawn.begin(), drawing.drawn.end());
    std::sort(written.begin(), written.end());
    for (const auto& warning : summary.warnings)
      bar_.warn(warning);
    if (!settings_.quiet)
      printClosing(summary, written);
    else if (!summary.trusted)
      bar_.warn(summary.verdict); // a silent run would look trusted
    for (const auto& warning : drawing.warnings)
      bar_.warn(warning);
    if (settings_.timing)
      std::cout << app::timingOf(summary, drawing.seconds) << std::flush;
    if (!summary.complete || (drawing.is_missing && interrupt_.requested()))
      return app::kInterrupted;
    window_.linger(summary.verdict, [this] { return interrupt_.requested(); });
    return summary.trusted && !drawing.is_missing ? app::kDone : app::kDoubtful;
  }

  void
  dropJournal()
  {
    if (journal_)
      journal_->remove();
  }

  /** A part of a joined run would have scans in several worlds. */
  int
  stopJoining()
  {
    bar_.say("interrupted; the runs are not joined, nothing is written");
    return app::kInterrupted;
  }

  /** A partial run never replaces a complete run. \return the written files */
  std::vector<std::filesystem::path>
  publish(const RunResult& summary)
  {
    published_ = out_.folder();
    if (summary.complete) {
      auto written = out_.publish(app::Journal::kDrop);
      dropJournal();
      return written;
    }
    bar_.say("the work done is kept: the same command goes on, --fresh starts anew");
    if (!app::holdsCompleteRun(out_))
      return out_.publish(app::Journal::kKeep);
    published_ += ".partial";
    bar_.say(settings_.out + ": keeps the complete run; the unfinished part is in " +
             published_.string());
    return out_.publishBeside(".partial");
  }

  /** \throws IoFailed an interrupted run with other options is in the folder */
  void
  openJournal()
  {
    const auto path = out_.journal();
    if (settings_.fresh)
      std::filesystem::remove(path);
    RunJournal::Conditions conditions{{"the version of the program", PCL6D_VERSION},
                                      {"the build of the program", app::buildId()}};
    for (const auto& word : settings_.conditions)
      conditions.emplace_back("--" + word.name, word.value);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < folder_.size(); ++i)
      names.push_back(folder_.title(i));
    try {
      journal_.emplace(path, conditions, names);
    } catch (const IoFailed& e) {
      throw IoFailed(std::string(e.what()) + " (--fresh drops it)");
    }
    if (journal_->numMatched() > 0)
      bar_.say("going on with an interrupted run: matched " +
               text::counted(journal_->numMatched(), "scan"));
    else if (settings_.resume)
      bar_.warn(settings_.out + ": no interrupted run to go on with");
    slam_.setMemory(&*journal_);
  }

  void
  show(const Progress& progress)
  {
    bar_.show(progress);
    window_.show(progress);
  }

  /** \return false if interrupted */
  bool
  readScans()
  {
    bool is_whole = false;
    {
      const app::StageTimer timer("reading", log_.stages);
      is_whole = readAll();
    }
    if (scans_.estimatesMotion()) { // estimated during reading
      const double seconds = slam_.result().motion_seconds;
      log_.stages.back().seconds -= seconds;
      log_.stages.push_back(
          {"motion within scans", seconds, log_.stages.back().peak_memory_mb});
    }
    return is_whole;
  }

  bool
  readAll()
  {
    app::SharedReading reading(scans_, earlier_, ranks_);
    return reading.readAll([&](std::size_t i, Scan scan) {
      memory_.require(scan.points.size(), folder_.title(i));
      log_.dropped.push_back(reading.add(i, scan, slam_));
      window_.add(scan.points, folder_.initialPose(i));
      clouds_.add(std::move(scan.cloud));
      show({"reading", i + 1, folder_.size()});
      return !interrupt_.requested();
    });
  }

  /** \return false if interrupted */
  bool
  match()
  {
    const app::StageTimer timer("matching", log_.stages);
    slam_.setProgressCallback([&](const Progress& progress) {
      if (progress.stage != "matching")
        printParameters();
      show(progress);
      if (interrupt_.requested())
        slam_.cancel();
    });
    slam_.setObserver([&](std::size_t i, const ScanResult& scan) {
      if (i == folder_.numRegistered()) // matching begins
        printParameters();
      if (settings_.verbose)
        printScan(i, scan);
      window_.update(slam_.result());
      if (interrupt_.requested())
        slam_.cancel();
    });
    const bool complete = app::optimize(slam_, earlier_);
    if (complete && earlier_.areJoined())
      log_.joined = app::joinedWords(earlier_);
    printParameters();
    window_.update(slam_.result());
    return complete;
  }

  static void
  printClosing(const RunResult& summary,
               const std::vector<std::filesystem::path>& written)
  {
    std::cout << app::printableLines(summary.verdict + '\n');
    for (const auto& path : written)
      std::cout << "  " << path.string() << '\n';
    std::cout << std::flush;
  }

  /** Prints parameters derived since the last call; parameters of loops follow from matching. */
  void
  printParameters()
  {
    for (const auto& [name, unit, parameter] :
         app::named(slam_.result().parameters, settings_))
      if (printed_.insert(name).second)
        bar_.say(app::parameterLine(name, parameter, unit));
  }

  void
  printScan(std::size_t i, const ScanResult& scan)
  {
    std::ostringstream line;
    line << folder_.name(i) << ": " << toString(scan.state) << " ("
         << toString(scan.status) << "), " << scan.iterations << " iterations, "
         << scan.pairs << " pairs, rms " << scan.rms << " m, overlap " << scan.overlap
         << ", correction " << scan.correction << " m"
         << (scan.rejections.empty() ? "" : "; rejected: ") << toWords(scan.rejections);
    bar_.say(line.str());
  }

  WorkSharing* ranks_;
  const app::Interrupt interrupt_;
  const app::EarlierRuns earlier_;
  app::RunInput input_;
  const ScanFolder& folder_;
  app::RunScans scans_;
  const Settings settings_;
  app::ProgressBar bar_;
  std::set<std::string> printed_; ///< parameters
  app::OutputFolder out_;
  const app::MemoryBudget memory_;
  app::KeptClouds clouds_; ///< a quarter of the budget; the rest is for the work
  app::LiveWindow window_;
  Slam6D slam_;
  std::optional<RunJournal> journal_;
  app::RunLog log_;
  std::filesystem::path published_; ///< where the files are in the end
};

int
runJob(const Settings& settings, WorkSharing* ranks)
{
  try {
    return Job(settings, ranks).run();
  } catch (const app::Interrupted&) {
    app::ProgressBar(settings.quiet)
        .say("interrupted while tracking; nothing is written");
    return app::kInterrupted;
  }
}
} // namespace

int
main(int argc, char** argv)
{
  std::unique_ptr<WorkSharing> ranks; // until all output is printed
  const auto run = [&](const std::vector<std::string>& arguments) {
    Settings settings;
    if (!app::parseSettings(arguments, settings))
      return static_cast<int>(app::kDone);
    if (settings.verbose)
      pcl::console::setVerbosityLevel(pcl::console::L_INFO);
    if (ranks && settings.deskew == app::Deskew::kEstimate)
      throw app::UsageError("--deskew estimate follows scan after scan and cannot be "
                            "shared by several processes: run without mpirun");
    if (settings.explain && (!ranks || ranks->isFirst()))
      return app::explainRun(settings);
    if (settings.explain)
      return static_cast<int>(app::kDone); // the first process prints the plan
    if (settings.planes)
      app::planesOfRun(); // reports a missing library before the work
    if (!ranks || ranks->isFirst())
      return runJob(settings, ranks.get());
    app::help(*ranks, kName, settings);
    return static_cast<int>(app::kDone);
  };
  return app::runMain(
      kName, argc, argv, [&](const std::vector<std::string>& arguments) {
        if (arguments.size() == 2 && arguments[0] == app::kDrawWord)
          return app::drawRun(arguments[1]);
        ranks = app::joinRanks();
        try {
          const int code = run(arguments);
          if (ranks)
            ranks->gather(""); // waits for all processes
          return code;
        } catch (const std::exception&) {
          if (ranks)
            ranks->fail(app::ofRank(*ranks, app::wordsOfCurrent()));
          throw;
        }
      });
}
