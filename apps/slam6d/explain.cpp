// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/open_scans.h"
#include "common/printable.h"
#include "common/progress_bar.h"
#include "slam6d/explain.h"
#include "slam6d/input/join.h"
#include "slam6d/input/run_input.h"
#include "slam6d/input/shared_reading.h"

#include <pcl6d/global_registration/scan_joiner.h>
#include <pcl6d/io/text.h>
#include <pcl6d/slam6d/slam6d.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <unistd.h>

namespace pcl6d::app {

namespace {
/** Number of scans registered to measure time and memory: the first has no partner, three have. */
constexpr std::size_t kMeasuredScans = 4;

constexpr double kBytesOfMegabyte = 1e6;

/** \return [bytes] resident memory of this process; 0 if unknown */
double
residentBytes()
{
  std::ifstream file("/proc/self/statm");
  double pages = 0, resident = 0;
  file >> pages >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

std::string
orderOf(const ScanFolder& folder)
{
  constexpr std::size_t kShown = 5;
  std::string names;
  for (std::size_t i = 0; i < std::min(kShown, folder.size()); ++i)
    names += (i > 0 ? ", " : "") + folder.name(i);
  if (folder.size() > kShown)
    names += ", ... " + folder.name(folder.size() - 1);
  return names;
}

/** \return the options for the first scans alone */
Slam6DOptions
optionsOfFirst(const Settings& settings)
{
  Slam6DOptions options = settings.slam;
  options.control = {};
  options.given_links.clear();
  return options;
}

/** \return the parameters without those derived from the poses of all scans */
Slam6DParameters
ofFirst(Slam6DParameters parameters)
{
  for (Parameter* parameter : {&parameters.loop_distance,
                               &parameters.loop_gap,
                               &parameters.loop_pairs,
                               &parameters.link_distance})
    if (!parameter->given)
      *parameter = {};
  return parameters;
}

/** Time of the first scans. */
struct MeasuredTime {
  double total = 0;                     ///< [s]
  double comparing = 0, placing = 0;    ///< [s] parts of it, without initial poses
  std::size_t compared = 0, placed = 0; ///< pairs
};

/** Notes when the comparison of pairs begins and ends. */
class PairClock {
public:
  explicit PairClock(MeasuredTime& time) : time_(time) {}

  void
  operator()(const Progress& now)
  {
    const bool is_comparing = now.stage == "comparing";
    if (!is_comparing && now.stage != "placing")
      return;
    if (now.done == 0)
      begin_ = Clock::now();
    if (now.done == 0 || now.done < now.total)
      return;
    const std::chrono::duration<double> spent = Clock::now() - begin_;
    (is_comparing ? time_.comparing : time_.placing) += spent.count();
    (is_comparing ? time_.compared : time_.placed) += now.total;
  }

private:
  using Clock = std::chrono::steady_clock;
  MeasuredTime& time_;
  Clock::time_point begin_;
};

/** \return [s] time for all scans from the time of `count` of them, if every pair is compared */
double
inAnyOrder(const MeasuredTime& of_first, std::size_t count, std::size_t total)
{
  const auto n = static_cast<double>(total);
  const double rest = of_first.total - of_first.comparing - of_first.placing;
  double seconds = rest * n / static_cast<double>(count);
  if (of_first.compared > 0)
    seconds +=
        of_first.comparing / static_cast<double>(of_first.compared) * n * (n - 1) / 2;
  if (of_first.placed > 0)
    seconds += of_first.placing / static_cast<double>(of_first.placed) * n *
               static_cast<double>(JoinOptions().pairs_per_scan);
  return seconds;
}

/** Registers the first scans of a folder. */
class FirstScans {
public:
  FirstScans(const Settings& settings, const EarlierRuns& earlier, RunScans& scans)
  : settings_(settings)
  , earlier_(earlier)
  , scans_(scans)
  , total_(scans.folder().size())
  , count_(std::min(kMeasuredScans, total_))
  {}

  /** Prints parameters and expectations. */
  void
  explain()
  {
    const double before = residentBytes();
    const MeasuredTime time = registerWith(optionsOfFirst(settings_));
    const double share = static_cast<double>(total_) / static_cast<double>(count_);
    const double memory = before + share * std::max(0.0, residentBytes() - before);
    for (const auto& [name, unit, parameter] : named(ofFirst(parameters_), settings_))
      std::cout << parameterLine(name, parameter, unit) << '\n';
    std::cout << "expected, from the first " << text::counted(count_, "scan") << " ("
              << points_ << " points): about " << timeText(time) << " and "
              << std::lround(memory / kBytesOfMegabyte) << " MB to read and register "
              << text::counted(total_, "scan")
              << "; more where scans have many neighbours or are lost\n";
  }

private:
  MeasuredTime
  registerWith(const Slam6DOptions& options)
  {
    MeasuredTime time;
    const auto start = std::chrono::steady_clock::now();
    Slam6D slam(options);
    slam.setProgressCallback(PairClock(time));
    SharedReading reading(scans_, earlier_, nullptr);
    points_ = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      Scan scan = scans_.read(i);
      points_ += scan.points.size();
      reading.add(i, scan, slam);
    }
    optimize(slam, earlier_);
    parameters_ = slam.result().parameters;
    const std::chrono::duration<double> spent =
        std::chrono::steady_clock::now() - start;
    time.total = spent.count();
    return time;
  }

  /** \return a time; a range where the order of the files decides */
  std::string
  timeText(const MeasuredTime& time)
  {
    const double in_order =
        time.total * static_cast<double>(total_) / static_cast<double>(count_);
    if (settings_.slam.initial_guess != InitialGuess::kGlobal)
      return durationText(in_order);
    if (!settings_.slam.order_first)
      return durationText(inAnyOrder(time, count_, total_));
    Slam6DOptions any_order = optionsOfFirst(settings_);
    any_order.order_first = false;
    const Slam6DParameters parameters = parameters_;
    const double longest =
        in_order + inAnyOrder(registerWith(any_order), count_, total_);
    parameters_ = parameters;
    return durationText(in_order) + " (in the order of the files) to " +
           durationText(longest) + " (if all pairs of scans must be compared)";
  }

  const Settings& settings_;
  const EarlierRuns& earlier_;
  RunScans& scans_;
  std::size_t total_, count_, points_ = 0;
  Slam6DParameters parameters_;
};
} // namespace

int
explainRun(const Settings& given)
{
  if (!given.joined.empty() || !given.continued.empty())
    throw UsageError("--explain is for the scans of a folder or a file, not for joined "
                     "or continued runs");
  const EarlierRuns earlier = openEarlier(given);
  RunInput input = openInput(given, earlier);
  const ScanFolder& folder = input.folder;
  RunScans scans = openScans(input, given, earlier);
  const Settings settings = resolved(given, folder, earlier);
  for (const std::string& line :
       describeInput(settings, scans, earlier, input.drive, 1))
    std::cout << printable(line) << '\n';
  std::cout << "order: " << printable(orderOf(folder)) << '\n';
  if (!settings.slam.control.points.empty())
    std::cout << "control: " << settings.slam.control.points.size() << " points, "
              << settings.slam.control.targets.size() << " targets, "
              << settings.slam.control.checks.size() << " held back\n";
  FirstScans(settings, earlier, scans).explain();
  std::cout << "nothing was written\n";
  flushOutput();
  return kDone;
}

} // namespace pcl6d::app
