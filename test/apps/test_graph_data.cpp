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
