// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>

#include <gtest/gtest.h>

namespace pcl6d {
namespace {

enum class Colour { kRed, kGreen, kBlue, kNameless };
constexpr Named<Colour> kColours[] = {{Colour::kRed, "red"},
                                      {Colour::kGreen, "green"},
                                      {Colour::kBlue, "blue"}};

TEST(NameTable, GivesWordsAndValues)
{
  EXPECT_EQ(namesOf(kColours), (std::vector<std::string>{"red", "green", "blue"}));
  for (const auto& colour : kColours) {
    EXPECT_EQ(findNamed(kColours, colour.name), colour.value);
    EXPECT_STREQ(nameOf(kColours, colour.value), colour.name);
  }
  EXPECT_FALSE(findNamed(kColours, "Red"));
  EXPECT_STREQ(nameOf(kColours, Colour::kNameless), "unknown");
  EXPECT_STREQ(nameOf(kColours, Colour::kNameless, "none"), "none");
}

TEST(NameTable, ListsItsWordsWhereOneIsWrong)
{
  EXPECT_EQ(listed(kColours, WordList::kCommas), "red, green, blue");
  const std::pair<WordList, const char*> lists[] = {
      {WordList::kBars, "colour = pink, but must be red|green|blue"},
      {WordList::kOneOf, "colour = pink, but must be one of red, green, blue"},
      {WordList::kOr, "colour = pink, but must be red, green or blue"}};
  for (const auto& [style, message] : lists)
    try {
      fromName(kColours, "colour", "pink", style);
      FAIL() << message;
    } catch (const BadArgument& error) {
      EXPECT_STREQ(error.what(), message);
    }
}

} // namespace
} // namespace pcl6d
