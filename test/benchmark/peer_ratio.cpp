// SPDX-License-Identifier: BSD-3-Clause
#include "peer_ratio.h"

#include <pcl/pcl_config.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <sstream>

namespace pcl6d::benchmarks {

namespace {
/** The times of a case [s]; entry i of both was measured one right after the other. */
struct Timing {
  PeerCase of;
  std::vector<double> ours{};
  std::vector<double> theirs{};
  bool failed = false;
};

/** A deque, as the benchmarks hold on to their entries. */
std::deque<Timing>&
timings()
{
  static std::deque<Timing> list;
  return list;
}

double
secondsOf(const std::function<void()>& call)
{
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  call();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/** \param[in] share 0.5: the median \return the value below which the share lies */
double
quantile(std::vector<double> values, double share)
{
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(
                                          share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double
ratioOf(const Timing& timing)
{
  return quantile(timing.theirs, 0.5) / quantile(timing.ours, 0.5);
}

void
addCounters(benchmark::State& state, const Timing& timing)
{
  std::vector<double> ratios;
  for (std::size_t i = 0; i < timing.ours.size(); ++i)
    ratios.push_back(timing.theirs[i] / timing.ours[i]);
  state.counters["ours_ms"] = 1e3 * quantile(timing.ours, 0.5);
  state.counters["peer_ms"] = 1e3 * quantile(timing.theirs, 0.5);
  state.counters["ratio"] = ratioOf(timing);
  state.counters["ratio_q1"] = quantile(ratios, 0.25);
  state.counters["ratio_q3"] = quantile(ratios, 0.75);
}

void
measure(benchmark::State& state, Timing& timing)
{
  const PeerJob job = timing.of.make();
  job.ours(); // the first call also warms up caches, pages and threads
  job.theirs();
  job.check(state);
  timing.failed = timing.failed || state.error_occurred();
  if (timing.failed)
    return;
  for (auto _ : state) {
    timing.ours.push_back(secondsOf(job.ours));
    timing.theirs.push_back(secondsOf(job.theirs));
    state.SetIterationTime(timing.ours.back());
  }
  addCounters(state, timing);
}

/** \return the numbers of a list such as "1,2"; empty if it is none */
std::vector<unsigned int>
countsOf(const std::string& list)
{
  std::vector<unsigned int> counts;
  std::istringstream items(list);
  for (std::string item; std::getline(items, item, ',');) {
    const int count = std::atoi(item.c_str());
    if (count < 1 || std::to_string(count) != item)
      return {};
    counts.push_back(static_cast<unsigned int>(count));
  }
  return counts;
}

std::string
cpuName()
{
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown";
}
} // namespace

void
addPeerCase(const PeerCase& peer_case)
{
  Timing& timing = timings().emplace_back(Timing{peer_case});
  const std::string name =
      peer_case.name + "/threads=" + std::to_string(peer_case.threads);
  benchmark::RegisterBenchmark(
      name.c_str(), [&timing](benchmark::State& state) { measure(state, timing); })
      ->Iterations(peer_case.repetitions)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

std::vector<unsigned int>
takeThreadCounts(int& argc, char** argv)
{
  const std::string option = "--threads=";
  std::vector<unsigned int> counts = {1, 2};
  char** const end = std::stable_partition(argv, argv + argc, [&](const char* word) {
    return std::string(word).rfind(option, 0) != 0;
  });
  for (char** word = end; word != argv + argc; ++word) {
    counts = countsOf(std::string(*word).substr(option.size()));
    if (counts.empty()) {
      std::fprintf(
          stderr, "error: %s: give counts from 1, such as --threads=1,2\n", *word);
      std::exit(2);
    }
  }
  argc = static_cast<int>(end - argv);
  return counts;
}

int
runPeerCases(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 2;
  benchmark::AddCustomContext("cpu", cpuName());
  benchmark::AddCustomContext("build type", PCL6D_BUILD_TYPE);
  benchmark::AddCustomContext("compiler", __VERSION__);
  benchmark::AddCustomContext("PCL", PCL_VERSION_PRETTY);
  if (benchmark::RunSpecifiedBenchmarks() == 0)
    return 2;
  benchmark::Shutdown();
  bool failed = false;
  for (const auto& timing : timings()) {
    failed = failed || timing.failed;
    if (!timing.failed && !timing.ours.empty())
      std::printf("ratio %s %s threads=%u %.2f\n",
                  timing.of.name.c_str(),
                  timing.of.peer.c_str(),
                  timing.of.threads,
                  ratioOf(timing));
  }
  return failed ? 1 : 0;
}

} // namespace pcl6d::benchmarks
