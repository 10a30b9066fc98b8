// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "evaluate/result_json.h"
#include "evaluate/suite/suite_check.h"
#include "evaluate/suite/suite_report.h"
#include "evaluate/verbs.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/json_object.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <set>
#include <sys/file.h>
#include <unistd.h>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

constexpr const char* kMarker = "suite.json";      // exists only in folders of ours
constexpr const char* kParts[] = {"runs", "data"}; ///< folders with removable content

struct SuiteSettings {
  std::string file;
  std::string out;
  std::string document; ///< Markdown file, or empty
  std::vector<std::string> only;
  std::optional<double> time_limit; ///< [s] empty: limit of the suite
  int jobs = 1;
  bool fresh = false;
  bool force = false;
  bool quiet = false;
  std::string command; ///< as typed
};

void
addOptions(OptionTable& table, SuiteSettings& s)
{
  table.positional("SUITE.json", &s.file);
  table.group("Suite");
  table.add("output,o OUT_DIR", &s.out)
      .help("folder to write (default: the name of the suite and _results)");
  table.add("only NAME...", &s.only)
      .composing()
      .multitoken()
      .help("only the methods, data sets or damages with the given names");
  table.add("jobs", &s.jobs)
      .within(1, 1024, "in [1, 1024]")
      .help("runs at once; more than 1 spoils the times");
  table.add("time-limit S", &s.time_limit)
      .above(0, "> 0")
      .help("[s] for a run, instead of the suite's");
  table.add("document FILE.md", &s.document)
      .help("also write table, machine and commands into FILE.md, over the previous "
            "text");
  table.add("fresh", &s.fresh).help("run all again");
  table.add("force", &s.force).help("write into a folder that is not empty");
  table.add("quiet", &s.quiet).help("print the table, warnings and errors only");
}

bool
parse(const std::vector<std::string>& arguments, SuiteSettings& s)
{
  OptionTable table(std::string("usage: ") + kEvaluate +
                    R"( suite SUITE.json [-o OUT_DIR] [options]
Runs pcl_slam6d with several sets of options over several data sets, each in a
process of its own, and compares the results: table.md, table.csv, table.json and
plots. Goes on where it was interrupted: a run that has ended is not repeated
unless programs, options or data have changed. Suite files: share/doc/benchmark.md.
)");
  addOptions(table, s);
  if (!table.parse(arguments))
    return false;
  s.command = std::string(kEvaluate) + " suite";
  for (const auto& argument : arguments)
    s.command += ' ' + argument;
  return true;
}

/** Paths of the command line are relative to the current folder, paths of the suite to
 * the suite's folder, which becomes the working folder. */
void
settlePaths(SuiteSettings& s)
{
  const fs::path file = s.file;
  if (s.out.empty())
    s.out = file.stem().string() + "_results";
  s.out = fs::absolute(s.out).lexically_normal().string();
  if (!s.document.empty())
    s.document = fs::absolute(s.document).string();
}

void
checkNames(const Suite& suite, const std::vector<std::string>& only)
{
  std::set<std::string> names;
  for (const auto& data : suite.data)
    names.insert({data.name, data.base, data.entry, data.damage.name});
  for (const auto& method : suite.methods)
    names.insert(method.name);
  for (const auto& name : only)
    if (name.empty() || names.count(name) == 0)
      throw UsageError("--only " + name + ": " + suite.file.string() +
                       " has no method, data set or damage of this name");
}

/** The folder of the results, locked by one call at a time. */
class HeldFolder {
public:
  HeldFolder(const SuiteSettings& s, const Suite& suite) : folder_(s.out)
  {
    refuseInputs(suite);
    if (!s.document.empty())
      requireDocument(s.document, suite);
    std::error_code error;
    if (fs::exists(folder_) && !fs::is_directory(folder_))
      throw IoFailed(s.out + ": output is a file, not a folder");
    if (!s.force && fs::exists(folder_) && !fs::is_empty(folder_) && !isOurs())
      throw IoFailed(s.out +
                     ": folder is not empty and holds no results of a suite (no " +
                     kMarker + "); use another folder or --force");
    if (!isOurs())
      for (const char* part : kParts)
        if (fs::exists(folder_ / part))
          throw IoFailed(
              (folder_ / part).string() +
              ": is not of a suite, and would be replaced; use another folder");
    fs::create_directories(folder_, error);
    lock_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ < 0)
      throw IoFailed(s.out + ": cannot write into the output folder: " +
                     (error ? error.message() : std::strerror(errno)));
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0)
      throw IoFailed(s.out + ": another call is writing here");
    writeMarker(suite);
    if (s.fresh)
      for (const char* part : kParts)
        fs::remove_all(folder_ / part);
  }
  ~HeldFolder() { ::close(lock_); }
  HeldFolder(const HeldFolder&) = delete;
  HeldFolder&
  operator=(const HeldFolder&) = delete;

private:
  /** The suite file and its input files; a name of a scene that is not a file is left out. */
  static std::vector<fs::path>
  inputsOf(const Suite& suite)
  {
    std::vector<fs::path> inputs = {suite.file};
    std::error_code missing;
    for (const SuiteData& data : suite.data)
      for (const auto& input : {data.folder, data.reference, data.scene})
        if (fs::exists(input, missing))
          inputs.push_back(fs::absolute(input));
    return inputs;
  }

  /** Files in our parts of the folder may be removed. */
  void
  refuseInputs(const Suite& suite) const
  {
    const std::vector<fs::path> inputs = inputsOf(suite);
    std::error_code none;
    for (const char* part : kParts) {
      const fs::path ours = fs::weakly_canonical(folder_ / part, none);
      for (const auto& input : inputs) {
        const fs::path path = fs::weakly_canonical(input, none);
        if (std::mismatch(ours.begin(), ours.end(), path.begin(), path.end()).first ==
            ours.end())
          throw IoFailed(folder_.string() + ": the input " + input.string() +
                         " lies where results are written");
      }
    }
  }

  /** Checked before the runs, not after. */
  static void
  requireDocument(const fs::path& document, const Suite& suite)
  {
    std::error_code missing;
    for (const auto& input : inputsOf(suite))
      if (fs::equivalent(document, input, missing))
        throw IoFailed(document.string() + ": is an input of the suite");
    requireWritable(document);
  }

  bool
  isOurs() const
  {
    try {
      std::string generator;
      readJson(folder_ / kMarker).read("generator", generator);
      return generator == kEvaluate;
    } catch (const IoFailed&) {
      return false;
    }
  }

  void
  writeMarker(const Suite& suite) const
  {
    writeJson(folder_ / kMarker,
              {{"schema_version", 1},
               {"generator", kEvaluate},
               {"suite", suite.file.string()}},
              2);
  }

  fs::path folder_;
  int lock_ = -1;
};

void
writeText(const fs::path& file, const std::string& text)
{
  writeFileAtomically(file, [&](std::ostream& stream) { stream << text; });
}

/** The three table files, the printed table, and the table in a document. */
void
writeTables(const SuiteSettings& s,
            const Suite& suite,
            const std::string& markdown,
            const std::string& csv,
            const std::string& json)
{
  const fs::path out = s.out;
  const char* sentence = suite.evaluates_trust
                             ? "Upper bounds after Clopper and Pearson, 95 %."
                             : "Errors without alignment.";
  const std::string document = documentOf(suite, markdown, sentence, s.command);
  writeText(out / "table.md", document);
  writeText(out / "table.csv", csv);
  writeText(out / "table.json", json);
  if (!s.document.empty())
    putIntoDocument(s.document, suite.name, document);
  std::fputs(markdown.c_str(), stdout);
  flushOutput();
}

void
writeErrors(const SuiteSettings& s,
            const Suite& suite,
            const std::vector<DataResults>& results,
            ProgressBar& bar)
{
  const auto rows = rowsOf(results);
  writeTables(s, suite, suiteMarkdown(rows), suiteCsv(rows), suiteJson(rows));
  try {
    drawSuite(s.out, results);
  } catch (const pcl::PCLException& e) {
    bar.warn(e.what()); // the numbers are there
  }
}

/** \return whether no wrong map is called good */
bool
writeTrust(const SuiteSettings& s,
           const Suite& suite,
           const std::vector<TrustRun>& runs)
{
  writeTables(s, suite, trustMarkdown(runs), trustCsv(runs), trustJson(runs));
  return trustTable(runs).all.false_goods.count == 0;
}

bool
allHaveResults(const std::vector<SuiteRun>& runs)
{
  return std::all_of(runs.begin(), runs.end(), [](const SuiteRun& run) {
    return run.record && run.record->hasResult();
  });
}
} // namespace

int
runSuite(const std::vector<std::string>& arguments)
{
  SuiteSettings s;
  if (!parse(arguments, s))
    return kDone;
  const Suite suite = readSuite(s.file);
  settlePaths(s);
  fs::current_path(suite.file.parent_path());
  checkNames(suite, s.only);
  checkSuite(suite);
  const HeldFolder held(s, suite);
  const SuiteFolder folder{s.out};
  SuiteRunOptions options;
  options.jobs = s.jobs;
  options.only = {s.only.begin(), s.only.end()};
  if (s.time_limit)
    options.limit = *s.time_limit;
  ProgressBar bar(s.quiet);
  const Interrupt interrupt;
  const auto runs = runSuite(suite, folder, options, interrupt, bar);
  if (!runs) {
    bar.say("interrupted; the same call goes on from here");
    return kInterrupted;
  }
  bool holds = true;
  if (suite.evaluates_trust)
    holds = writeTrust(s, suite, evaluateSuite(suite, folder, *runs));
  else
    writeErrors(s, suite, measureSuite(suite, folder, *runs), bar);
  return holds && allHaveResults(*runs) ? kDone : kDoubtful;
}

} // namespace pcl6d::app
