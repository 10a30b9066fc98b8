// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/suite/suite_data.h"
#include "evaluate/suite/suite_runs.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <deque>
#include <map>
#include <memory>
#include <thread>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string
lineOn(const std::string& what, const RunRecord& record)
{
  char numbers[80];
  std::snprintf(numbers,
                sizeof numbers,
                "%.1f s, %.0f MB",
                record.end.seconds,
                record.end.peak_memory_mb);
  return what + ": " + record.verdict() + ", " + numbers +
         (record.message.empty() ? "" : ": ") + record.message;
}

/** Runs the missing parts; its methods follow one another. */
class Runner {
public:
  Runner(const Suite& suite,
         const SuiteFolder& folder,
         const SuiteRunOptions& options,
         const Interrupt& interrupt,
         ProgressBar& bar)
  : suite_(suite)
  , folder_(folder)
  , options_(options)
  , interrupt_(interrupt)
  , bar_(bar)
  , programs_(describePrograms())
  , time_limit_(options.limit.value_or(suite.time_limit))
  {}

  std::optional<std::vector<SuiteRun>>
  run()
  {
    plan();
    if (!prepareAll() || !runAll())
      return std::nullopt;
    return runs_;
  }

private:
  bool
  asked(const std::string& name) const
  {
    return options_.only.count(name) > 0;
  }

  bool
  asksFor(const SuiteData& data) const
  {
    return asked(data.name) || asked(data.base) || asked(data.entry);
  }

  template <typename Items, typename Is>
  static bool
  any(const Items& items, const Is& is)
  {
    return std::any_of(items.begin(), items.end(), is);
  }

  /** Selects the runs: data sets, damages and methods by the names asked for, or
   * everything of a kind without such a name. */
  void
  plan()
  {
    const auto byName = [&](const auto& item) { return asked(item.name); };
    const bool some_data =
        any(suite_.data, [&](const SuiteData& data) { return asksFor(data); });
    const bool some_damages = any(suite_.damages, byName);
    const bool some_methods = any(suite_.methods, byName);
    for (std::size_t d = 0; d < suite_.data.size(); ++d) {
      const SuiteData& data = suite_.data[d];
      if ((some_data && !asksFor(data)) || (some_damages && !asked(data.damage.name)))
        continue;
      for (std::size_t m = 0; m < suite_.methods.size(); ++m)
        if (!some_methods || asked(suite_.methods[m].name))
          for (int r = 1; r <= suite_.repetitions; ++r)
            runs_.push_back({d, m, r, std::nullopt, ""});
    }
  }

  /** \return the data without damage; empty if interrupted */
  std::optional<PreparedData>
  prepareSource(const SuiteData& data)
  {
    const auto before = sources_.find(data.base);
    if (before != sources_.end())
      return before->second;
    const SuiteData source = data.undamaged();
    const auto prepared = prepareData(
        source, folder_.dataOf(source), programs_, time_limit_, interrupt_, bar_);
    if (prepared)
      sources_.emplace(data.base, *prepared);
    return prepared;
  }

  /** \return nothing if interrupted */
  std::optional<PreparedData>
  prepare(const SuiteData& data)
  {
    const auto source = prepareSource(data);
    if (!source || data.damage.name.empty())
      return source;
    std::optional<PreparedData> foreign;
    if (data.damage.foreign) {
      const auto other = std::find_if(
          suite_.data.begin(), suite_.data.end(), [&](const SuiteData& candidate) {
            return candidate.base == data.foreign;
          });
      foreign = prepareSource(*other);
      if (!foreign)
        return std::nullopt;
    }
    return prepareDamaged(data,
                          *source,
                          foreign ? &*foreign : nullptr,
                          folder_.truthOf(data.undamaged()),
                          folder_.dataOf(data));
  }

  /** \return false if interrupted */
  bool
  prepareAll()
  {
    data_.resize(suite_.data.size());
    for (std::size_t d = 0; d < suite_.data.size(); ++d) {
      if (!any(runs_, [&](const SuiteRun& run) { return run.data == d; }))
        continue;
      const auto prepared = prepare(suite_.data[d]);
      if (!prepared || interrupt_.requested())
        return false;
      data_[d] = *prepared;
      for (SuiteRun& run : runs_)
        if (run.data == d)
          run.no_data = prepared->fault;
    }
    return true;
  }

  static void
  rest()
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }

  fs::path
  folderOf(const SuiteRun& run) const
  {
    return folder_.runOf(
        suite_.data[run.data], suite_.methods[run.method], run.repetition);
  }

  SuiteOptions
  optionsOf(const SuiteRun& run) const
  {
    const SuiteData& data = suite_.data[run.data];
    return overlaid(
        overlaid(overlaid(suite_.defaults, data.options), data.damage.options),
        suite_.methods[run.method].options);
  }

  Json
  inputsOf(const SuiteRun& run) const
  {
    return {{"programs", programs_},
            {"data", data_[run.data].inputs},
            {"options", wordsOf(optionsOf(run))}};
  }

  std::string
  nameOf(const SuiteRun& run) const
  {
    return suite_.data[run.data].name + ": " + suite_.methods[run.method].name +
           (suite_.repetitions > 1 ? " #" + std::to_string(run.repetition) : "");
  }

  /** \return whether the run has ended in an earlier call and still counts */
  bool
  takeEarlier(SuiteRun& run) const
  {
    const fs::path folder = folderOf(run);
    const auto record = readRunRecord(folder / "run.json");
    if (!record || !record->countsFor(inputsOf(run), time_limit_) ||
        (record->hasResult() && !fs::exists(folder / "result" / "summary.json")))
      return false;
    run.record = record;
    return true;
  }

  std::unique_ptr<ChildProcess>
  start(const SuiteRun& run) const
  {
    const fs::path folder = folderOf(run);
    makeAnew(folder);
    ProcessStart start{
        programBeside("pcl_slam6d"),
        {data_[run.data].scans.string(), "-o", (folder / "result").string()},
        folder / "log.txt",
        time_limit_};
    for (const auto& word : wordsOf(optionsOf(run)))
      start.arguments.push_back(word);
    if (!suite_.data[run.data].damage.links.empty())
      start.arguments.push_back("--graph-in=" +
                                linksOf(data_[run.data].scans).string());
    return std::make_unique<ChildProcess>(start);
  }

  void
  finish(SuiteRun& run, const ProcessEnd& end)
  {
    const fs::path folder = folderOf(run);
    RunRecord record{inputsOf(run), end, time_limit_, ""};
    if (!record.hasResult() && !end.timed_out)
      record.message = errorIn(folder / "log.txt");
    if (!suite_.keep_scans) { // the poses suffice, in a thousandth of the space
      fs::remove_all(folder / "result" / "scans");
      fs::remove(folder / "result" / "map.pcd");
    }
    writeRunRecord(folder / "run.json", record);
    bar_.say(lineOn(nameOf(run), record));
    run.record = record;
  }

  /** \return false if interrupted */
  bool
  runAll()
  {
    for (SuiteRun& run : runs_)
      if (run.no_data.empty() && !takeEarlier(run))
        waiting_.push_back(&run);
    // Repetitions come last: every method then gets a result early.
    std::stable_sort(
        waiting_.begin(), waiting_.end(), [](const auto* a, const auto* b) {
          return a->repetition < b->repetition;
        });
    if (waiting_.size() < runs_.size())
      bar_.say(std::to_string(runs_.size() - waiting_.size()) + " of " +
               std::to_string(runs_.size()) + " runs are there already");
    while (!waiting_.empty() || !active_.empty()) {
      if (interrupt_.requested()) {
        stopped_ = stopped_ || !waiting_.empty();
        waiting_.clear();
      }
      startWaiting();
      collectEnded();
      rest();
    }
    return !stopped_;
  }

  void
  startWaiting()
  {
    while (!waiting_.empty() &&
           active_.size() < static_cast<std::size_t>(options_.jobs)) {
      active_.push_back({waiting_.front(), start(*waiting_.front())});
      waiting_.pop_front();
    }
  }

  void
  collectEnded()
  {
    for (auto entry = active_.begin(); entry != active_.end();) {
      if (interrupt_.requested()) {
        entry->process->stop();
        stopped_ = true;
      }
      const auto end = entry->process->poll();
      if (end && !stopped_) {
        finish(*entry->run, *end);
        bar_.show({"runs",
                   runs_.size() - waiting_.size() - active_.size() + 1,
                   runs_.size()});
      }
      entry = end ? active_.erase(entry) : entry + 1;
    }
  }

  struct Active {
    SuiteRun* run;
    std::unique_ptr<ChildProcess> process;
  };

  const Suite& suite_;
  const SuiteFolder& folder_;
  const SuiteRunOptions& options_;
  const Interrupt& interrupt_;
  ProgressBar& bar_;
  const Json programs_;
  const double time_limit_;
  std::vector<SuiteRun> runs_;
  std::map<std::string, PreparedData> sources_; ///< without damage, by their names
  std::vector<PreparedData> data_;
  std::deque<SuiteRun*> waiting_;
  std::vector<Active> active_;
  bool stopped_ = false; ///< runs were ended by an interruption
};
} // namespace

std::optional<std::vector<SuiteRun>>
runSuite(const Suite& suite,
         const SuiteFolder& folder,
         const SuiteRunOptions& options,
         const Interrupt& interrupt,
         ProgressBar& bar)
{
  return Runner(suite, folder, options, interrupt, bar).run();
}

} // namespace pcl6d::app
