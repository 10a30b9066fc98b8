// SPDX-License-Identifier: BSD-3-Clause
#include "io_test.h"

#include <pcl6d/io/link_list_io.h>

#include <gtest/gtest.h>

using namespace pcl6d::test;
using pcl6d::readLinkList;

namespace {
using Links = std::vector<std::pair<std::size_t, std::size_t>>;

Links
readText(const TempFolder& folder, const std::string& name, const std::string& content)
{
  replaceText(folder / name, content);
  return readLinkList(folder / name);
}
} // namespace

TEST(LinkListIo, ReadsPairsOfIndices)
{
  const TempFolder folder;
  EXPECT_EQ(readText(folder, "links", "# a b\n\n0 5\n\t7   3 again\r\n5 0"),
            (Links{{0, 5}, {7, 3}, {5, 0}}));
  EXPECT_TRUE(readText(folder, "links", "").empty());
}

TEST(LinkListIo, KnowsAPoseGraphByItsFirstWord)
{
  const TempFolder folder;
  const std::string toro = "EDGE3 10 30 1 0 0 0 0 0" + kUnitInformation;
  const std::string g2o = "# run\nVERTEX_SE3:QUAT 4 0 0 0 0 0 0 1\n"
                          "VERTEX_SE3:QUAT 2 0 0 0 0 0 0 1\n"
                          "EDGE_SE3:QUAT 4 2 0 0 0 0 0 0 1" +
                          kUnitInformation;
  for (const std::string name : {"graph.g2o", "graph.graph", "graph.txt"}) {
    EXPECT_EQ(readText(folder, name, toro), (Links{{10, 30}})) << name;
    EXPECT_EQ(readText(folder, name, g2o), (Links{{4, 2}})) << name;
  }
  EXPECT_EQ(readText(folder, "list.g2o", "1 2\n"), (Links{{1, 2}}));
}

TEST(LinkListIo, TakesNoPartOfANumber)
{
  const TempFolder folder;
  for (const std::string line : {"0 1.9",
                                 "0 1abc",
                                 "0 1e3",
                                 "0x10 3",
                                 "0",
                                 "-1 3",
                                 "0 99999999999999999999",
                                 "nan 1",
                                 "0 # 1"}) {
    replaceText(folder / "links", "3 4\n" + line + "\n");
    expectIoFailed(folder / "links",
                   "line 2: expected the indices of two scans, got '" + line + "'",
                   [&] { readLinkList(folder / "links"); });
  }
  replaceText(folder / "links", "3 3\n");
  expectIoFailed(folder / "links", "line 1: scan 3 is linked to itself", [&] {
    readLinkList(folder / "links");
  });
}
