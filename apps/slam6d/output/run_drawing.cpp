// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/process/child_process.h"
#include "slam6d/options/settings.h"
#include "slam6d/output/run_drawing.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/text.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/visualization/private_display.h>
#include <pcl6d/visualization/report.h>
#include <pcl6d/visualization/run_scenes.h>
#include <pcl6d/visualization/survey_report.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <future>
#include <iostream>
#include <optional>
#include <sys/mman.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

constexpr const char* kSlam6d = "pcl_slam6d";
/** [s] Far more than a picture takes: 2 s for 2 million points on an old core. A longer run may
 * have larger pictures. */
constexpr double kLeastTime = 120;
/** [bytes] VTK, Mesa and the largest picture take a quarter of this. */
constexpr std::size_t kLeastMemory = std::size_t{2} << 30;

/** \return whether an option of a run with the values "yes" and "no" is "yes" */
bool
isOn(const RunResult& run, const std::string& name)
{
  return std::any_of(run.options.begin(), run.options.end(), [&](const auto& option) {
    return option.name == name && option.value == "yes";
  });
}

/** \return the names of the files to be drawn */
std::vector<std::string>
wantedOf(const RunResult& run)
{
  std::vector<std::string> names;
  const bool has_map = run.complete && run.map_points > 0;
  if (has_map && !isOn(run, kNoPictureOption))
    names.push_back("top_view.png");
  if (has_map && isOn(run, kPlanesOption))
    names.push_back("planes.png");
  if (isOn(run, kReportOption)) {
    names.push_back("report.html");
    if (run.complete)
      names.push_back("survey.html");
  }
  return names;
}

/** \return the given value of an option of a run; empty: not given */
std::string
valueOf(const RunResult& run, const std::string& name)
{
  for (const auto& option : run.options)
    if (option.name == name && option.source == "given")
      return option.value;
  return {};
}

void
writeSurvey(const RunFolder& run)
{
  const SurveyReport report =
      surveyOf(run,
               surveyOptionsFrom({valueOf(run.summary(), kProjectOption)},
                                 valueOf(run.summary(), kToleranceOption)));
  writeSurveyReport(run.path() / "survey.html", report);
  writeSurveyTables(run.path() / "survey", report);
}

void
draw(const RunFolder& run, const std::string& name)
{
  const fs::path file = run.path() / name;
  if (name == "top_view.png")
    TopView().write(file, topSceneOf(run));
  else if (name == "planes.png")
    PlaneView().write(file, planeSceneOf(run));
  else if (name == "survey.html")
    writeSurvey(run);
  else
    writeReport(file, gatherReport(run));
}

/** \brief An anonymous file for the messages of another process. */
class Listener {
public:
  Listener() : file_(::memfd_create("pcl6d", MFD_CLOEXEC)) {}
  ~Listener()
  {
    if (file_ >= 0)
      ::close(file_);
  }
  Listener(const Listener&) = delete;
  Listener&
  operator=(const Listener&) = delete;

  fs::path
  path() const
  {
    return file_ < 0 ? fs::path("/dev/null")
                     : fs::path("/proc/self/fd/" + std::to_string(file_));
  }

  /** \return the last line of the messages; empty: none */
  std::string
  lastLine() const
  {
    if (file_ < 0)
      return {};
    std::string text(4096, '\0');
    const off_t size = ::lseek(file_, 0, SEEK_END);
    const off_t begin = std::max<off_t>(0, size - static_cast<off_t>(text.size()));
    const ssize_t count = ::pread(file_, text.data(), text.size(), begin);
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    text.erase(text.find_last_not_of('\n') + 1);
    return text.substr(text.rfind('\n') + 1);
  }

private:
  int file_;
};

/** \return how the child ended; nothing if interrupted */
std::optional<ProcessEnd>
waitFor(ChildProcess& child, const Interrupt& interrupt)
{
  constexpr std::chrono::milliseconds kLook(5);
  while (true) {
    if (const auto end = child.poll())
      return end;
    if (interrupt.requested())
      return {};
    std::this_thread::sleep_for(kLook);
  }
}

/** \return why a file is missing, in words */
std::string
reasonOf(const std::optional<ProcessEnd>& end, const std::string& said)
{
  if (!end)
    return "interrupted";
  if (end->timed_out)
    return "it took longer than " + std::to_string(std::lround(end->seconds)) + " s";
  if (end->signal != 0)
    return std::string("ended by a signal: ") + ::strsignal(end->signal);
  return said.empty() ? "exit code " + std::to_string(end->exit_code) : said;
}

/** Starts the display for pictures while files are read. A failure, or the lack of a thread, is
 * ignored here: the start is repeated, and its error reported, when a picture is drawn. */
std::future<void>
startDisplay()
{
  return std::async(std::launch::async | std::launch::deferred, [] {
    try {
      PrivateDisplay::instance();
    } catch (const pcl::PCLException&) {}
  });
}
} // namespace

int
drawRun(const fs::path& folder)
{
  const RunFolder run(folder);
  const auto wanted = wantedOf(run.summary());
  const bool has_pictures =
      std::any_of(wanted.begin(), wanted.end(), [](const std::string& name) {
        return fs::path(name).extension() == ".png";
      });
  const auto display = has_pictures ? startDisplay() : std::future<void>();
  bool is_missing = false;
  for (const std::string& name : wanted) {
    try {
      draw(run, name);
    } catch (const std::exception&) {
      std::cerr << name << ": " << wordsOfCurrent() << std::endl;
      is_missing = true;
    }
  }
  return is_missing ? kDoubtful : kDone;
}

Drawing
drawApart(const fs::path& folder,
          const RunResult& run,
          std::size_t memory,
          const Interrupt& interrupt)
{
  const auto begin = std::chrono::steady_clock::now();
  Drawing drawing;
  const auto wanted = wantedOf(run);
  if (wanted.empty())
    return drawing;
  double seconds = 0;
  for (const auto& stage : run.stages)
    seconds += stage.seconds;
  std::string reason;
  try {
    const Listener listener;
    ProcessStart start;
    start.program = "/proc/self/exe";
    start.arguments = {kDrawWord, folder.string()};
    start.log = listener.path();
    start.time_limit = std::max(kLeastTime, seconds);
    start.memory_limit = std::max(kLeastMemory, memory);
    ChildProcess child(start);
    const auto end = waitFor(child, interrupt);
    reason = reasonOf(end, listener.lastLine());
  } catch (const IoFailed& e) {
    reason = e.what();
  }
  std::string missing;
  for (const auto& name : wanted) {
    std::error_code error;
    if (fs::exists(folder / name, error))
      drawing.drawn.push_back(folder / name);
    else
      missing += (missing.empty() ? "" : ", ") + name;
  }
  drawing.is_missing = !missing.empty();
  if (drawing.is_missing)
    drawing.warnings.push_back("not drawn: " + missing + " (" + reason +
                               "); the remaining results are written. To try again: " +
                               kSlam6d + ' ' + kDrawWord + ' ' + folder.string());
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  drawing.seconds = spent.count();
  return drawing;
}

} // namespace pcl6d::app
