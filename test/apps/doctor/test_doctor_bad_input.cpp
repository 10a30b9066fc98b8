// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_doctor on what is no pair of scans.
#include "apps/doctor/doctor_test.h"
#include "support/folders.h"
#include "support/points.h"

#include <boost/process.hpp>

#include <chrono>
#include <csignal>
#include <fstream>
#include <limits>
#include <thread>

namespace {
using pcl6d::test::consult;
using pcl6d::test::Consultation;
using pcl6d::test::DoctorRoom;
using pcl6d::test::kDoctorName;
using pcl6d::test::kNan;
using pcl6d::test::pcdOf;
using pcl6d::test::runProgram;
using pcl6d::test::writeText;

void
expectError(const std::vector<std::string>& arguments,
            int code,
            const std::vector<std::string>& words)
{
  pcl6d::test::expectError(
      runProgram(kDoctorName, arguments), kDoctorName, code, words);
}

/** Waits until a process has started another one: the doctor's runs are such, and signals are
 * watched before the first begins. */
void
waitForChildOf(int process)
{
  const std::string id = std::to_string(process);
  for (int wait = 0; wait < 3000; ++wait) {
    std::ifstream children("/proc/" + id + "/task/" + id + "/children");
    int child = 0;
    if (children >> child)
      return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ADD_FAILURE() << "it starts no run";
}

/** Two scans, of which one is spoilt. */
struct DoctorBadInput : testing::Test {
  DoctorRoom room;
  std::vector<std::string> files = room.write();

  std::vector<std::string>
  with(const std::vector<std::string>& more) const
  {
    std::vector<std::string> all = files;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};
} // namespace

TEST_F(DoctorBadInput, ReportsOnAnEmptyCloud)
{
  writeText(files[0], pcdOf({}));
  const Consultation said = consult(files);
  EXPECT_EQ(said.exit_code, 3) << said.err;
  EXPECT_NE(said.measured("SOURCE has no points").find("0 rows"), std::string::npos);
  EXPECT_EQ(said.run("pcl6d::ICP6D", "as it is")["converged"], false);
  EXPECT_FALSE(said.json.contains("best_of_ours"));
}

TEST_F(DoctorBadInput, ReportsOnNanAlone)
{
  writeText(files[1],
            pcdOf(std::vector<Eigen::Vector3d>(50, Eigen::Vector3d::Constant(kNan))));
  const Consultation said = consult(with({"-o", room / "report.html"}));
  EXPECT_EQ(said.exit_code, 3) << said.err;
  EXPECT_NE(said.measured("TARGET has no points").find("50 rows"), std::string::npos);
  EXPECT_NE(said.out.find("\nregistration is impossible"), std::string::npos);
  EXPECT_EQ(said.run("pcl6d::GICP6D", "as it is")["end"], "done");
}

TEST_F(DoctorBadInput, ReportsOnCloudsThatAreFarApart)
{
  for (auto& p : room.source)
    p.x() += 500;
  room.write();
  const Consultation said = consult(files);
  EXPECT_EQ(said.measured("hardly meet at the start").find("0 of "), 0u) << said.out;
  const Consultation three = [&] {
    writeText(files[0], pcdOf({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
    return consult(files);
  }();
  EXPECT_EQ(three.exit_code, 3) << three.err;
}

TEST_F(DoctorBadInput, EndsRunsAtTheTimeLimit)
{
  const Consultation said = consult(with({"--time-limit", "0.001"}));
  EXPECT_EQ(said.exit_code, 3) << said.err;
  EXPECT_NE(said.measured("did not come to an end").find("ended at the time limit"),
            std::string::npos)
      << said.out;
}

TEST_F(DoctorBadInput, EndsWithItsRunsWhenItIsInterrupted)
{
  namespace bp = boost::process;
  const std::filesystem::path html = room / "report.html";
  bp::child doctor(std::string(PCL6D_BIN_DIR "/") + kDoctorName,
                   bp::args = with({"-o", html}),
                   bp::std_out > bp::null,
                   bp::std_err > bp::null);
  waitForChildOf(doctor.id());
  ::kill(doctor.id(), SIGTERM);
  doctor.wait();
  EXPECT_EQ(doctor.exit_code(), 130);
  EXPECT_FALSE(std::filesystem::exists(html));
}

TEST_F(DoctorBadInput, RefusesFilesThatAreNoScans)
{
  writeText(room / "words.pcd", "hello\n");
  expectError({room / "words.pcd", files[1]}, 1, {"words.pcd", "line 1"});
  expectError({files[0], room / "missing.pcd"}, 1, {"missing.pcd", "No such file"});
  expectError({room.path(), files[1]}, 1, {});
}

TEST_F(DoctorBadInput, RefusesIndicesThatAreNone)
{
  const auto refused = [&](const std::string& text,
                           const std::vector<std::string>& words) {
    writeText(room / "numbers", text);
    expectError(with({"--indices", room / "numbers"}), 1, words);
  };
  refused("0 1\n2 x", {"numbers: line 2", "'x'"});
  refused("-1", {"line 1: -1"});
  refused(std::to_string(room.source.size()), {"below the"});
  writeText(room / "text.xyz", "0 0 0\n0 0 1\nnan 0 0\n0 1 1\n");
  writeText(room / "numbers", "2");
  expectError({room / "text.xyz", files[1], "--indices", room / "numbers"},
              1,
              {"text.xyz", "are not unique"});
}

TEST_F(DoctorBadInput, RefusesOptionsThatBreakARule)
{
  expectError({files[0]}, 2, {"TARGET"});
  expectError(with({files[0]}), 2, {});
  expectError(with({"--max-distance", "0"}), 2, {"max-distance"});
  expectError(with({"--max-distance", "nan"}), 2, {"max-distance"});
  expectError(with({"--time-limit", "-1"}), 2, {"time-limit"});
  expectError(with({"--guess", "1 2 3"}), 2, {"--guess", "six"});
  expectError(with({"--source-origin", "1 2"}), 2, {"--source-origin", "three"});
  expectError(with({"-o", room / "report.pdf"}), 2, {"report.pdf", ".html"});
  expectError(with({"--json", room / "report.html"}), 2, {".json"});
  writeText(room / "guess", "1 0 0 0 0 1 0 0 0 0 2 0");
  expectError(with({"--guess", room / "guess"}), 1, {"no rigid motion"});
  expectError(with({"-o", room / "missing/report.html", "--time-limit", "0.01"}),
              1,
              {"missing"});
}
