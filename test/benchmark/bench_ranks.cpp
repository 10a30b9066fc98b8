// SPDX-License-Identifier: BSD-3-Clause
// What sharing a run between processes saves, on cores that other work may share: processor
// time of the slowest process between two exchanges, added up (the critical path).
// usage: mpirun -n 2 bench_ranks FOLDER [SCANS [no-verdict]]; also without mpirun
#include <pcl6d/common/error.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/mpi/mpi_sharing.h>
#include <pcl6d/slam6d/slam6d.h>

#include <algorithm>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {
using namespace pcl6d;

/** \return [s] of this process so far */
double
processorTime()
{
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/** \brief Measures between exchanges, and the bytes that travel. */
class MeasuredSharing final : public MpiSharing {
public:
  /** \brief The work since the last exchange is of a stage; counts on the first process.
   * \param[in] next that of the work after the next exchange; empty: the same */
  void
  mark(const std::string& stage, const std::string& next = "")
  {
    if (numRanks() == 1) // which exchanges nothing between some stages
      add();
    stage_ = stage;
    next_ = next;
  }

  /** \brief The last exchange. */
  void
  print()
  {
    add();
    if (!isFirst())
      return;
    double total = 0;
    for (const auto& [stage, seconds] : seconds_) {
      std::cout << std::left << std::setw(14) << stage << std::right << std::setw(9)
                << std::fixed << std::setprecision(3) << seconds << " s "
                << std::setw(10) << std::setprecision(1)
                << static_cast<double>(bytes_[stage]) / 1e6 << " MB\n";
      total += seconds;
    }
    std::cout << "all           " << std::setw(9) << std::setprecision(3) << total
              << " s\n";
  }

protected:
  std::vector<Message>
  exchange(Message mine, Receivers receivers) override
  {
    bytes_[stage_] += mine.bytes.size();
    mine_ = processorTime() - since_;
    auto all = MpiSharing::exchange(std::move(mine), receivers);
    slowest();
    if (!next_.empty())
      stage_ = std::exchange(next_, "");
    return all;
  }

private:
  void
  add()
  {
    mine_ = processorTime() - since_;
    slowest();
  }

  /** Packing, copying and waiting are not counted as work, but in the next share. */
  void
  slowest()
  {
    Packer packer;
    packer(mine_);
    Message message;
    message.bytes = packer.bytes;
    double most = 0;
    for (const Message& one : MpiSharing::exchange(message, Receivers::kAll)) {
      double seconds = 0;
      Unpacker unpacker(one.bytes);
      unpacker(seconds);
      most = std::max(most, seconds);
    }
    seconds_[stage_] += most;
    since_ = processorTime();
  }

  std::string stage_ = "reading", next_;
  std::map<std::string, double> seconds_;
  std::map<std::string, std::size_t> bytes_;
  double mine_ = 0, since_ = processorTime();
};

/** Each its own ones, all of them for the first process. */
void
readShared(const ScanFolder& folder,
           std::size_t begin,
           std::vector<Points>& points,
           MeasuredSharing& ranks)
{
  WorkSharing::Loop loop;
  loop.count = points.size();
  loop.owner = [&](std::size_t k) { return ranks.ownerOf(begin + k); };
  loop.compute = [&](std::size_t k) { points[k] = folder.read(begin + k).points; };
  loop.give = [&](std::size_t k, Packer& packer) { packer(points[k]); };
  loop.take = [&](std::size_t k, Unpacker& unpacker) { unpacker(points[k]); };
  loop.receivers = WorkSharing::Receivers::kFirst;
  ranks.run(loop, 1);
}

void
run(const ScanFolder& folder, std::size_t scans, bool verify, MeasuredSharing& ranks)
{
  Slam6DOptions options;
  options.num_threads = 1;
  options.verify = verify;
  Slam6D slam(options);
  slam.setSharing(&ranks);
  slam.setObserver([&](std::size_t i, const ScanResult&) {
    if (i == 0)
      ranks.mark("matching", verify ? "links, verdict" : "links");
  });
  const std::size_t at_a_time = 4 * ranks.numRanks(); // as the program does
  for (std::size_t begin = 0; begin < scans; begin += at_a_time) {
    std::vector<Points> points(std::min(at_a_time, scans - begin));
    readShared(folder, begin, points, ranks);
    for (std::size_t k = 0; k < points.size(); ++k)
      slam.addScan(points[k], folder.initialPose(begin + k), folder.name(begin + k));
  }
  ranks.mark("rays");
  slam.optimize();
}
} // namespace

int
main(int argc, char** argv)
{
  if (argc < 2) {
    std::cerr << "usage: [mpirun -n N] bench_ranks FOLDER [SCANS [no-verdict]]\n";
    return 2;
  }
  MeasuredSharing ranks;
  const ScanFolder folder(argv[1]);
  const std::size_t scans = argc > 2 ? std::stoul(argv[2]) : folder.size();
  run(folder, std::min(scans, folder.size()), argc <= 3, ranks);
  ranks.print();
}
