// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_render picture when it is stopped: its X server must not stay.
#include "support/folders.h"
#include "support/temp_folder.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/run/run_summary.h>

#include <boost/process.hpp>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <sys/wait.h>
#include <thread>

namespace {
namespace bp = boost::process;
namespace fs = std::filesystem;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

constexpr int kManyScans = 2000; ///< so that the pictures take a while

/** \return whether something came true within a minute; a busy machine is slow */
bool
happensSoon(const std::function<bool()>& what)
{
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!what() && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return what();
}

/** A run with poses and links but without points, and a process that draws it. */
class DrawnRun : public TempFolder {
public:
  DrawnRun()
  {
    pcl6d::RunResult summary;
    summary.generator = "pcl_slam6d";
    std::string links =
        "from,to,kind,verdict,reason,distance,pairs,rms,overlap,condition,weight\n";
    for (int i = 0; i < kManyScans; ++i) {
      auto& scan = summary.scans.emplace_back();
      scan.file = std::to_string(i) + ".pcd";
      scan.index = i;
      scan.T_world_scan = pcl6d::planarPose(i % 50, 0.1 * i, 0);
      scan.covariance = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
      if (i > 0)
        links += std::to_string(i - 1) + "," + std::to_string(i) +
                 ",sequence,used,\"\",1,9,0.02,0.9,0.5,1\n";
    }
    fs::create_directory(*this / "run");
    pcl6d::writeRunSummary(*this / "run/summary.json", summary);
    writeText(*this / "run/links.csv", links);
    bp::environment marked = boost::this_process::environment();
    marked["PCL6D_TEST"] = path().string();
    process_ = bp::child(PCL6D_BIN_DIR "/pcl_slam6d_render",
                         bp::args({"picture",
                                   (*this / "run").string(),
                                   "--view",
                                   "graph,covariance,top",
                                   "--size",
                                   "4000x4000",
                                   "-o",
                                   (*this / "out").string()}),
                         marked,
                         bp::std_out > bp::null,
                         bp::std_err > bp::null);
  }
  ~DrawnRun()
  {
    std::error_code ignored;
    process_.terminate(ignored);
    for (const int pid : servers())
      ::kill(pid, SIGKILL); // ours, by the mark
  }

  /** \return the X servers whose environment has the mark of this run */
  std::vector<int>
  servers() const
  {
    std::vector<int> pids;
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const int pid = std::atoi(entry.path().filename().c_str());
      if (pid > 0 && readText(entry.path() / "comm") == "Xvfb\n" &&
          readText(entry.path() / "environ").find("PCL6D_TEST=" + path().string()) !=
              std::string::npos)
        pids.push_back(pid);
    }
    return pids;
  }

  /** \return the signal that the process ended by */
  int
  endBy(int signal)
  {
    ::kill(process_.id(), signal);
    process_.wait();
    const int status = process_.native_exit_code();
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

private:
  bp::child process_;
};

class RenderInterrupted : public testing::TestWithParam<int> {};
} // namespace

TEST_P(RenderInterrupted, LeavesNoServerAndNoHalfAPicture)
{
  DrawnRun run;
  ASSERT_TRUE(happensSoon([&] { return !run.servers().empty(); }));
  ASSERT_EQ(run.endBy(GetParam()), GetParam()) << "it was too fast to be stopped";
  EXPECT_TRUE(happensSoon([&] { return run.servers().empty(); }));
  for (const auto& entry : fs::directory_iterator(run / "out"))
    EXPECT_TRUE(entry.path().extension() != ".png" ||
                readText(entry.path()).find("IEND") != std::string::npos)
        << entry.path();
}

INSTANTIATE_TEST_SUITE_P(Signals,
                         RenderInterrupted,
                         testing::Values(SIGINT, SIGTERM, SIGKILL),
                         [](const auto& test) {
                           return std::string(::strsignal(test.param));
                         });
