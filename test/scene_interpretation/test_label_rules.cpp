// SPDX-License-Identifier: BSD-3-Clause
#include "support/box_room.h"
#include "support/constants.h"
#include "support/folders.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/scene_interpretation/interpretation.h>

#include <gtest/gtest.h>

namespace {
using pcl6d::parseLabelRules;
using pcl6d::test::kUp;
using pcl6d::test::kX;
using pcl6d::test::kY;
using pcl6d::test::rectangle;

const std::filesystem::path kRules = PCL6D_SOURCE_DIR "/share/rules";

// Two level labels a and b, one upright label w, and what is to be tried with them.
std::string
withRules(const std::string& more)
{
  return R"({"labels": [{"name": "a", "orientation": "horizontal"},
    {"name": "b", "orientation": "horizontal"},
    {"name": "w", "orientation": "vertical"}], )" +
         more + "}";
}

std::string
messageOf(const std::string& json)
{
  try {
    parseLabelRules(json, "my.json");
  } catch (const pcl6d::IoFailed& error) {
    return error.what();
  }
  return "";
}
} // namespace

TEST(LabelRules, OfTheBookAreTheFileThatIsShipped)
{
  const auto file = pcl6d::readLabelRules(kRules / "book.json");
  const auto& book = pcl6d::bookRules();
  ASSERT_EQ(file.labels.size(), book.labels.size());
  EXPECT_EQ(file.pairs.size(), book.pairs.size());
  EXPECT_EQ(file.needs.size(), book.needs.size());
  const char* const names[] = {"floor", "ceiling", "door", "wall"};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(book.labels[i].name, names[i]);
    EXPECT_EQ(file.labels[i].name, names[i]);
    EXPECT_EQ(file.labels[i].conditions.size(), book.labels[i].conditions.size());
  }
  EXPECT_EQ(toString(book.pairs[1].rule), "parallel and (equalheight or apart)");
}

TEST(LabelRules, NumberTheBooksLabelsAsPointsDoAndOthersAfterThem)
{
  const auto rules = pcl6d::readLabelRules(kRules / "household.json");
  const char* const names[] = {
      "none", "floor", "ceiling", "wall", "door", "table", "stairs", "ramp", "window"};
  for (unsigned int i = 0; i < 9; ++i)
    EXPECT_EQ(labelNumber(rules, names[i]), i) << names[i];
  EXPECT_THROW(labelNumber(rules, "sofa"), pcl6d::BadArgument);
}

TEST(LabelRules, OfAHouseholdFindTableStairsRampAndWindow)
{
  auto planes = pcl6d::test::BoxRoom().planes();
  planes[7].plane.label = "table";
  for (int i = 1; i <= 4; ++i)
    planes.push_back(rectangle(
        "stairs", {-1.5 + 0.28 * i, -1, 0.25 + 0.17 * i}, 0.14 * kX, 0.6 * kY));
  planes.push_back(
      rectangle("ramp", {-1, 1, 0.3}, Eigen::Vector3d(1, 0, 0.2), 0.5 * kY));
  planes.push_back(rectangle("window", {0.5, 2.1, 1.5}, 0.6 * kX, 0.5 * kUp));
  const auto rules = pcl6d::readLabelRules(kRules / "household.json");
  EXPECT_EQ(interpretPlanes(planesOf(planes), sidesOf(planes), rules).labels,
            labelsOf(planes));
}

TEST(LabelRules, NameFileAndPlaceOfWhatIsUnknown)
{
  const struct {
    std::string json, message;
  } cases[] = {
      {"{", "my.json: line 1: not the syntax of JSON"},
      {"[]", "my.json: /: no object {...} of rules"},
      {"{}", "my.json: /: there is no label"},
      {R"({"lables": []})", "my.json: /: unknown key 'lables'"},
      {R"({"schema_version": 2})", "my.json: /schema_version: 2, but must be 1"},
      {R"({"extends": "mine"})", "my.json: /extends: \"mine\", but must be \"book\""},
      {R"({"labels": [{"name": "a", "size": [1, 2]}]})",
       "my.json: /labels/0: unknown condition 'size'"},
      {R"({"labels": [{"name": "a", "area": [2, 1]}]})",
       "my.json: /labels/0/area: the range [2,1] is empty: no plane fits"},
      {R"({"labels": [{"name": "a", "area": [2, "x"]}]})",
       "my.json: /labels/0/area/1: \"x\" is neither a number nor null"},
      {R"({"labels": [{"name": "a", "orientation": "tilted"}]})",
       "my.json: /labels/0/orientation: unknown orientation 'tilted', but must be "
       "horizontal or vertical"},
      {R"({"labels": [{"area": [0, 1]}]})",
       "my.json: /labels/0: key 'name' is missing"},
      {R"({"labels": [{"name": "none"}]})",
       "my.json: /labels/0/name: 'none' is not free to be a label"},
      {R"({"extends": "book", "labels": [{"name": "wall"}]})",
       "my.json: /labels/0/name: label 'wall' is there already"},
      {withRules(R"("constraints": [{"between": ["a", "sky"], "holds": "above"}])"),
       "my.json: /constraints/0/between/1: unknown label 'sky'"},
      {withRules(R"("constraints": [{"between": ["a", "b"], "holds": {"all": ["above",
        "beside"]}}])"),
       "my.json: /constraints/0/holds/all/1: unknown predicate 'beside', but must be "
       "one "
       "of " +
           pcl6d::relationNames()},
      {withRules(R"("constraints": [{"between": ["a", "b"], "holds": {"all": []}}])"),
       "my.json: /constraints/0/holds/all: the list of predicates is empty"},
      {withRules(R"("needs": [{"label": "a", "of": "b"}])"),
       "my.json: /needs/0: key 'holds' is missing"}};
  for (const auto& [json, message] : cases)
    EXPECT_EQ(messageOf(json), message) << json;
}

TEST(LabelRules, ThatContradictEachOtherAreRefused)
{
  const std::string prefix = "my.json: /: rules contradict each other: ";
  const struct {
    std::string json, message;
  } cases[] = {
      {withRules(R"("constraints": [{"between": ["a", "b"], "holds": "above"},
        {"between": ["b", "a"], "holds": "above"}])"),
       "'a' beside 'b' can never be: my.json: /constraints/0 (above); my.json: "
       "/constraints/1 (above)"},
      {withRules(R"("constraints": [{"between": ["a", "w"], "holds": "parallel"}])"),
       "'a' beside 'w' can never be: my.json: /constraints/0 (parallel)"},
      {withRules(R"("constraints": [{"between": ["a", "a"], "holds": "above"}])"),
       "'a' beside 'a' can never be: my.json: /constraints/0 (above)"},
      {withRules(R"("constraints": [{"between": ["a", "b"], "holds": "above"},
        {"between": ["b", "w"], "holds": "above"},
        {"between": ["w", "a"], "holds": "above"}])"),
       "'a' is always above 'b', and that above 'a', by way of further labels"},
      {withRules(R"("constraints": [{"between": ["a", "b"], "holds": "above"}],
        "needs": [{"label": "a", "of": "b", "holds": {"any": ["under", "equalheight"]}}])"),
       "label 'a' can never be assigned: my.json: /needs/0 (under or equalheight) "
       "against "
       "its constraints my.json: /constraints/0 (above)"},
      {R"({"labels": [{"name": "a", "orientation": "vertical", "inclination": [0, 30]}]})",
       "label 'a' can never be assigned: vertical, and inclined by less than 80 deg"},
      {R"({"labels": [{"name": "a", "bottom": [1, null], "top": [null, 0.5]}]})",
       "label 'a' can never be assigned: the bottom is higher than the top"},
      {R"({"labels": [{"name": "a", "area": [null, -1]}]})",
       "label 'a' can never be assigned: area is never below 0"},
      {R"({"extends": "book", "labels": [{"name": "cellar"}],
        "constraints": [{"between": ["cellar", "*"], "holds": "under"}]})",
       "'floor' beside 'cellar' can never be: book: /constraints/8 (under); my.json: "
       "/constraints/0 (under)"}};
  for (const auto& [json, message] : cases)
    EXPECT_EQ(messageOf(json), prefix + message) << json;
}

TEST(LabelRules, AreNotReadDeeperThanAnybodyWritesThem)
{
  for (const int depth : {20000, 500000}) {
    std::string deep = R"({"labels": [{"name": "a"}], "constraints": [{"between": )"
                       R"(["a", "a"], "holds": )";
    for (int i = 0; i < depth; ++i)
      deep += R"({"not": )";
    EXPECT_EQ(messageOf(deep), "my.json: line 1: nested more than 200 deep");
  }
}

TEST(LabelRules, OfAFileThatIsNotThereAreAnError)
{
  const pcl6d::test::TempFolder folder;
  EXPECT_THROW(pcl6d::readLabelRules(folder / "none.json"), pcl6d::IoFailed);
  EXPECT_THROW(pcl6d::readLabelRules(folder.path()), pcl6d::IoFailed);
}
