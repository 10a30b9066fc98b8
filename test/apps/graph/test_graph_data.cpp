// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_graph on the recorded graphs.
#include "support/data_folder.h"
#include "support/run_program.h"

namespace {
pcl6d::test::Outcome
optimize(const std::filesystem::path& graph)
{
  const pcl6d::test::TempFolder folder;
  return pcl6d::test::runProgram("pcl_slam6d_graph",
                                 {"optimize", graph, "-o", folder / "out.g2o"});
}
} // namespace

TEST(GraphData, TheGarageStartsAndEndsAtItsChi2)
{
  PCL6D_DATA_OR_SKIP(folder, "graphs");
  const auto outcome = optimize(folder / "parking-garage.g2o");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("poses 1661 edges 6275\nchi2 16720.01817 1.238690"),
            std::string::npos)
      << outcome.out;
}

TEST(GraphData, TheSphereStartsAndEndsAtItsChi2)
{
  PCL6D_DATA_OR_SKIP(folder, "graphs");
  const auto outcome = optimize(folder / "sphere2500.txt");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("poses 2500 edges 4949\nchi2 2547812.218 728.853"),
            std::string::npos)
      << outcome.out;
}

TEST(GraphData, TheSphereKeepsItsChi2AsToroAndAsG2o)
{
  PCL6D_DATA_OR_SKIP(folder, "graphs");
  const pcl6d::test::TempFolder out;
  const auto run = [](const std::vector<std::string>& words) {
    const auto outcome = pcl6d::test::runProgram("pcl_slam6d_graph", words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  run({"convert", folder / "sphere2500.txt", "-o", out / "a.graph"});
  run({"convert", out / "a.graph", "-o", out / "b.g2o"});
  run({"convert", out / "b.g2o", "-o", out / "c.txt", "--format", "toro"});
  for (const char* const name : {"a.graph", "b.g2o", "c.txt"}) {
    const std::string info = run({"info", out / name});
    EXPECT_NE(info.find("poses 2500 edges 4949"), std::string::npos) << info;
    EXPECT_NE(info.find("chi2 2547812.218"), std::string::npos) << name << info;
  }
}
