// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/build_id.h"
#include "common/process/memory_budget.h"
#include "slam6d/input/shared_reading.h"
#include "slam6d/ranks.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/fingerprint.h>
#include <pcl6d/slam6d/slam6d.h>

#ifdef PCL6D_WITH_MPI
#include <pcl6d/mpi/mpi_sharing.h>
#endif

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <poll.h>
#include <unistd.h>
#include <utility>

namespace pcl6d::app {

namespace {
/** \return the value of the first variable that is set; null if none */
const char*
firstSet(std::initializer_list<const char*> names)
{
  for (const char* name : names)
    if (const char* value = std::getenv(name))
      return value;
  return nullptr;
}

/** \return the number of processes started together by a launcher: Open MPI, MPICH and its
 * variants, and Slurm with MPI; 1: no launcher */
int
launchedRanks()
{
  const char* size = firstSet({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"});
  if (!size && firstSet({"PMIX_RANK", "PMI_RANK"}))
    size = firstSet({"SLURM_STEP_NUM_TASKS", "SLURM_NTASKS"});
  return size ? std::atoi(size) : 1;
}

/** Whatever was to be printed is dropped. */
void
silence()
{
  std::cout.rdbuf(nullptr);
  std::cerr.rdbuf(nullptr);
}

std::string
hostName()
{
  std::array<char, 256> host{};
  return ::gethostname(host.data(), host.size() - 1) == 0 ? host.data() : "unknown";
}

/** Program, input and options of a process. */
struct View {
  std::string host;
  int pid = 0;
  std::string build;
  std::vector<std::pair<std::string, std::string>> options;
  std::vector<std::pair<std::string, std::uintmax_t>>
      scans; ///< names and sizes [bytes]
  std::string pose_source;
  std::uint64_t poses = 0; ///< fingerprint; of the given links, too
};

template <typename Archive>
void
packFields(Archive& archive, View& view)
{
  archive(view.host, view.pid, view.build, view.options, view.scans);
  archive(view.pose_source, view.poses);
}

View
viewOf(const Settings& settings, const ScanFolder& folder)
{
  View view;
  view.host = hostName();
  view.pid = ::getpid();
  view.build = buildId();
  for (const auto& word : settings.conditions)
    view.options.emplace_back(word.name, word.value);
  Fingerprint poses;
  for (std::size_t i = 0; i < folder.size(); ++i) {
    view.scans.emplace_back(folder.name(i), std::filesystem::file_size(folder.file(i)));
    poses.add(folder.initialPose(i));
  }
  for (const auto& [from, to] : settings.slam.given_links) {
    poses.add(static_cast<std::uint64_t>(from));
    poses.add(static_cast<std::uint64_t>(to));
  }
  view.poses = poses.value();
  view.pose_source = folder.poseSource();
  return view;
}

/** \return the difference of the lists of scans, in words; empty: equal */
std::string
differenceOfScans(const View& first, const View& other)
{
  for (std::size_t i = 0; i < std::min(first.scans.size(), other.scans.size()); ++i) {
    const auto& [name, size] = first.scans[i];
    const auto& [name_there, size_there] = other.scans[i];
    if (name != name_there)
      return "scan " + std::to_string(i) + " is " + name_there + ", and " + name +
             " for rank 0";
    if (size != size_there)
      return name + " has " + std::to_string(size_there) + " bytes, and " +
             std::to_string(size) + " for rank 0";
  }
  if (first.scans.size() != other.scans.size())
    return std::to_string(other.scans.size()) + " scans, and " +
           std::to_string(first.scans.size()) + " for rank 0";
  return "";
}

/** \return the first difference, in words; empty: none */
std::string
differenceOf(const View& first, const View& other)
{
  if (first.build != other.build)
    return "runs another build of the program than rank 0 on " + first.host +
           ": install one version on every machine";
  for (std::size_t k = 0; k < first.options.size(); ++k)
    if (k >= other.options.size() || first.options[k] != other.options[k])
      return "has another value of --" + first.options[k].first + " than rank 0";
  if (const auto scans = differenceOfScans(first, other); !scans.empty())
    return "sees another folder of scans: " + scans;
  if (first.pose_source != other.pose_source || first.poses != other.poses)
    return "has different initial poses or links than rank 0 (" + other.pose_source +
           ")";
  return "";
}

/** Data for the signal handler. */
struct Ending {
  std::array<char, 512> line{};
  std::size_t size = 0;
  std::size_t rank = 0;
  std::array<int, 2> speakers{}; ///< processes of ranks 0 and 1; 0: on another machine
};
Ending g_ending;

bool
isGone(int pid)
{
  return pid > 0 && ::kill(pid, 0) != 0 && errno == ESRCH;
}

/** Rank 1 reports the loss of rank 0. */
bool
speaks()
{
  return g_ending.rank == 0 || (g_ending.rank == 1 && isGone(g_ending.speakers[0]));
}

/** mpirun sends SIGTERM to all processes, and kills the rest when one has ended or after a second.
 * A process that ends too early may prevent another's message. Only calls functions allowed in
 * signal handlers. */
void
letOthersSpeak()
{
  constexpr int kMostTimes = 100, kMilliseconds = 10;
  int times = 0;
  for (std::size_t r = 0; r < std::min(g_ending.rank, g_ending.speakers.size()); ++r)
    while (g_ending.speakers[r] > 0 && !isGone(g_ending.speakers[r]) &&
           times++ < kMostTimes)
      ::poll(nullptr, 0, kMilliseconds);
}

extern "C" void
endAtOnce(int)
{
  if (speaks()) [[maybe_unused]]
    const auto written = ::write(STDERR_FILENO, g_ending.line.data(), g_ending.size);
  letOthersSpeak();
  ::_exit(kInterrupted);
}

void
endOnSignals(const WorkSharing& ranks,
             const std::string& name,
             const std::vector<View>& views)
{
  const std::string line =
      name + ": error: another process of the run has ended, or the run was stopped; "
             "the work done is kept: the same command goes on (--resume)\n";
  g_ending.size = std::min(line.size(), g_ending.line.size());
  std::copy_n(line.begin(), g_ending.size, g_ending.line.begin());
  g_ending.rank = ranks.rank();
  for (std::size_t r = 0; r < std::min(views.size(), g_ending.speakers.size()); ++r)
    if (views[r].host == views[g_ending.rank].host)
      g_ending.speakers[r] = views[r].pid;
  struct sigaction action {};
  action.sa_handler = endAtOnce;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    ::sigaction(signal, &action, nullptr);
}
} // namespace

std::unique_ptr<WorkSharing>
joinRanks()
{
  const int launched = launchedRanks();
  if (launched <= 1)
    return nullptr;
  const char* rank = firstSet({"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"});
  if (rank && std::string(rank) != "0")
    silence();
#ifdef PCL6D_WITH_MPI
  auto ranks = std::make_unique<MpiSharing>();
  if (ranks->numRanks() != static_cast<std::size_t>(launched))
    throw IoFailed("started as one of " + std::to_string(launched) +
                   " processes, but MPI finds " + std::to_string(ranks->numRanks()) +
                   ": start the program with the launcher of its MPI library");
  return ranks;
#else
  throw IoFailed("started as one of " + std::to_string(launched) +
                 " processes, but built without MPI: install libopenmpi-dev and build "
                 "again, or start without mpirun");
#endif
}

std::string
ofRank(const WorkSharing& ranks, const std::string& error)
{
  return "rank " + std::to_string(ranks.rank()) + " on " + hostName() + ": " + error;
}

void
agreeOnInput(WorkSharing& ranks,
             const std::string& name,
             const Settings& settings,
             const ScanFolder& folder)
{
  Packer packer;
  packer(viewOf(settings, folder));
  const std::vector<std::string> all = ranks.gather(std::move(packer.bytes));
  std::vector<View> views(all.size());
  for (std::size_t r = 0; r < all.size(); ++r) {
    Unpacker unpacker(all[r]);
    unpacker(views[r]);
    if (const auto difference = differenceOf(views.front(), views[r]);
        !difference.empty())
      throw IoFailed("rank " + std::to_string(r) + " on " + views[r].host + " " +
                     difference);
  }
  endOnSignals(ranks, name, views);
}

void
help(WorkSharing& ranks, const std::string& name, const Settings& settings)
{
  const EarlierRuns earlier = openEarlier(settings);
  RunInput input = openInput(settings, earlier);
  const ScanFolder& folder = input.folder;
  RunScans scans = openScans(input, settings, earlier);
  const Settings all = resolved(settings, folder, earlier);
  const MemoryBudget memory(all.memory, all.out);
  Slam6D slam(all.slam);
  slam.setSharing(&ranks);
  agreeOnInput(ranks, name, all, folder);
  SharedReading reading(scans, earlier, &ranks);
  reading.readAll([&](std::size_t i, const Scan& scan) {
    memory.require(scan.points.size(), folder.title(i));
    reading.add(i, scan, slam);
    return true;
  });
  slam.optimize();
}

} // namespace pcl6d::app
