// SPDX-License-Identifier: BSD-3-Clause
#include "semantic_map/small_map.h"

#include <pcl6d/semantic_map/find_rooms.h>
#include <pcl6d/semantic_map/map_query.h>
#include <pcl6d/semantic_map/map_relations.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>

using namespace pcl6d;

namespace {
const SemanticMap&
map()
{
  static const SemanticMap made = [] {
    SemanticMap scene = test::twoRooms();
    findRooms(scene);
    scene.relations = findRelations(scene);
    scene.links = {{0, 2, "sequence", 120, 0.012, {}}, {2, 4, "loop", 80, 0.02, {}}};
    return scene;
  }();
  return made;
}

/** \return the ids of the answer, or the names of links and relations */
std::string
ask(const std::string& query)
{
  const QueryResult result = answerQuery(map(), parseQuery(query));
  std::string ids;
  for (const auto& row : result.rows) {
    ids += ids.empty() ? "" : " ";
    if (const auto* id = std::get_if<double>(&row.front().value))
      ids += std::to_string(static_cast<int>(*id));
    else
      ids += toString(std::get<std::vector<Entity>>(row.front().value).front());
  }
  return ids;
}

/** The message for a query that is wrong. */
std::string
fault(const std::string& query)
{
  try {
    const std::string answer = ask(query);
    return "no error, but: " + answer;
  } catch (const QueryError& error) {
    return error.what();
  }
}

std::size_t
roomAt(double x, double y)
{
  return isInPlan(map().rooms[0], map().up, {x, y, 0}) ? 1 : 2;
}
} // namespace

TEST(MapQuery, FindsThingsByClassLabelAndNumber)
{
  EXPECT_EQ(ask("objects"), "1 2 3 4");
  EXPECT_EQ(ask("object class=chair"), "2");
  EXPECT_EQ(ask("objects class='waste bin'"), "4");
  EXPECT_EQ(ask("objects class=\"waste bin\""), "4");
  EXPECT_EQ(ask("objects class=table,chair"), "1 2");
  EXPECT_EQ(ask("objects class!=table,chair"), "3 4");
  EXPECT_EQ(ask("objects not class=table,chair"), "3 4");
  EXPECT_EQ(ask("planes label=door"), "9");
  EXPECT_EQ(ask("planes area>4 label=wall"), "3 4 5 6 7 8");
  EXPECT_EQ(ask("planes area >= 7.5 label = wall"), "3 4 5 6 7 8");
  EXPECT_EQ(ask("planes area>7.5 label=wall"), "3 4");
  EXPECT_EQ(ask("planes area<7.5"), "9 10");
  EXPECT_EQ(ask("planes area<=7.5 label=wall"), "5 6 7 8");
  EXPECT_EQ(ask("planes id=3,7"), "3 7");
  EXPECT_EQ(ask("planes id!=1 id<4"), "2 3");
  EXPECT_EQ(ask("objects z>-0.5 z<1e-3"), "1 2 4");
  EXPECT_EQ(ask("objects class=sofa"), "");
}

TEST(MapQuery, FollowsRelationsByIdByNameAndToAnything)
{
  EXPECT_EQ(ask("objects on=floor"), "1 2 4");
  EXPECT_EQ(ask("objects on=plane:1"), "1 2 4");
  EXPECT_EQ(ask("objects on=1"), "1 2 4");
  EXPECT_EQ(ask("objects on=table"), "3");
  EXPECT_EQ(ask("objects on=object:1"), "3");
  EXPECT_EQ(ask("objects on!=floor"), "3");
  EXPECT_EQ(ask("objects carries=*"), "1");
  EXPECT_EQ(ask("objects not carries=*"), "2 3 4");
  EXPECT_EQ(ask("objects next_to=wall"), "4") << "all others stand farther off";
  EXPECT_EQ(ask("objects next_to=chair"), "1 3");
  EXPECT_EQ(ask("planes parallel=3 label=wall"), "4");
  EXPECT_EQ(ask("planes orthogonal=floor label=door"), "9");
  EXPECT_EQ(ask("planes under=ceiling label=floor"), "1");
  EXPECT_EQ(ask("planes above=floor label=ceiling"), "2");
  EXPECT_EQ(ask("planes carries='waste bin'"), "1");
  EXPECT_EQ(ask("planes in=table"), "10");
}

TEST(MapQuery, FindsRoomsScansLinksAndRelations)
{
  const std::string left = std::to_string(roomAt(1, 1));
  const std::string right = std::to_string(roomAt(7, 1));
  EXPECT_EQ(ask("objects room=" + left), "1 2 3");
  EXPECT_EQ(ask("objects class=chair on=floor room=" + left), "2");
  EXPECT_EQ(ask("objects class=chair on=floor room=" + right), "");
  EXPECT_EQ(ask("rooms has=chair"), left);
  EXPECT_EQ(ask("rooms has=object:4"), right);
  EXPECT_EQ(ask("rooms has=plane:5"), left);
  EXPECT_EQ(ask("rooms next_to=" + left), right);
  EXPECT_EQ(ask("rooms area>10 height=2.5"), "1 2");
  EXPECT_EQ(ask("storeys has=room:1"), "1");
  EXPECT_EQ(ask("objects storey=1"), "1 2 3 4");
  EXPECT_EQ(ask("scans"), "0 2 4");
  EXPECT_EQ(ask("scans seen=object:1"), "0 2");
  EXPECT_EQ(ask("scans seen=1"), "0 2") << "an object by default";
  EXPECT_EQ(ask("scans seen='waste bin'"), "4");
  EXPECT_EQ(ask("scans not seen=plane:1"), "");
  EXPECT_EQ(ask("scans linked=2"), "0 4");
  EXPECT_EQ(ask("scans room=" + right), "2 4"); // at x = 4.2 and 7.4
  EXPECT_EQ(ask("scans file=scan4.pcd"), "4");
  EXPECT_EQ(ask("objects seen=scan:4"), "4");
  EXPECT_EQ(ask("objects seen=0"), "1") << "scans are counted from 0";
  EXPECT_EQ(ask("links kind=loop"), "scan:2");
  EXPECT_EQ(ask("links pairs>100 rms<0.015"), "scan:0");
  EXPECT_EQ(ask("relations predicate=on first=cup"), "object:3 object:3");
  EXPECT_EQ(ask("relations predicate=on second=plane:10"), "object:3");
}

TEST(MapQuery, MarksWhereTheSyntaxBreaksAndSaysWhatItExpected)
{
  struct Case {
    const char* query;
    const char* column;
    const char* words;
  };
  for (const Case& wrong : {Case{"", "column 1:", "objects, planes"},
                            Case{"chairs", "column 1:", "'chairs'"},
                            Case{"objects class", "column 14:", "the end"},
                            Case{"objects class chair", "column 15:", "'chair'"},
                            Case{"objects class=", "column 15:", "a value"},
                            Case{"objects class= ,x", "column 16:", "a value"},
                            Case{"objects class==x", "column 15:", "a value"},
                            Case{"objects class=a,", "column 17:", "a value"},
                            Case{"objects =chair", "column 9:", "a condition"},
                            Case{"objects not", "column 12:", "a condition"},
                            Case{"objects class='a b", "column 15:", "a closing '"},
                            Case{"objects claas=chair", "column 9:", "class, score"},
                            Case{"objects class>a", "column 9:", "only = and !="},
                            Case{"planes area>big", "column 13:", "is a number"},
                            Case{"planes area='4'", "column 13:", "is a number"},
                            Case{"objects on=plane:99", "column 12:", "no plane:99"},
                            Case{"objects on=1.5", "column 12:", "an id"},
                            Case{"scans linked=1", "column 14:", "no scan:1"},
                            Case{"objects class='ä' on", "column 21:", "the end"}}) {
    const std::string message = fault(wrong.query);
    EXPECT_NE(message.find(wrong.column), std::string::npos)
        << wrong.query << ": " << message;
    EXPECT_NE(message.find(wrong.words), std::string::npos)
        << wrong.query << ": " << message;
  }
  try {
    parseQuery("objects class chair");
    FAIL();
  } catch (const QueryError& error) {
    EXPECT_EQ(error.marked(), "objects class chair\n              ^");
  }
}

TEST(MapQuery, ChecksQueriesOfAnEmptyMapToo)
{
  const SemanticMap empty;
  EXPECT_TRUE(answerQuery(empty, parseQuery("objects class=chair")).rows.empty());
  EXPECT_THROW(answerQuery(empty, parseQuery("objects colour=red")), QueryError);
  EXPECT_THROW(answerQuery(empty, parseQuery("rooms has=object:1")), QueryError);
}

TEST(MapQuery, TakesOddNamesInQuotes)
{
  SemanticMap odd;
  const std::vector<std::string> names = {"a,b",
                                          "it's",
                                          "say \"hi\"",
                                          "x = y",
                                          "plane:1",
                                          "3",
                                          "back\\slash",
                                          "Stühle",
                                          "*"};
  for (const auto& name : names)
    odd.objects.push_back(test::object(name, {0, 0, 0}, {1, 1, 1}));
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string quoted = "'";
    for (const char c : names[i])
      quoted += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    const auto result = answerQuery(odd, parseQuery("objects class=" + quoted + "'"));
    ASSERT_EQ(result.rows.size(), 1u) << names[i];
    EXPECT_EQ(std::get<double>(result.rows[0].front().value),
              static_cast<double>(i + 1));
  }
}

TEST(MapQuery, PrintsATableAndJson)
{
  const auto result = answerQuery(map(), parseQuery("objects class=chair,cup"));
  std::ostringstream table, json;
  writeTable(table, result);
  std::istringstream lines(table.str());
  std::string header, first, second, more;
  std::getline(lines, header);
  std::getline(lines, first);
  std::getline(lines, second);
  EXPECT_FALSE(std::getline(lines, more));
  EXPECT_EQ(header.rfind("id  class  score", 0), 0u) << header;
  EXPECT_EQ(first.rfind(" 2  chair  0.900  1.800  1.500", 0), 0u) << first;
  EXPECT_NE(second.find("plane:10,object:1"), std::string::npos) << second;

  writeJson(json, result);
  const auto read = nlohmann::json::parse(json.str());
  EXPECT_EQ(read["count"], 2);
  EXPECT_EQ(read["subject"], "objects");
  EXPECT_EQ(read["results"][1]["class"], "cup");
  EXPECT_EQ(read["results"][1]["id"], 3);
  EXPECT_EQ(read["results"][1]["on"][1], "object:1");
  EXPECT_EQ(read["results"][0]["x"], 1.8);

  std::ostringstream nothing;
  writeTable(nothing, answerQuery(map(), parseQuery("objects class=sofa")));
  EXPECT_EQ(nothing.str(), "");
}

TEST(MapQuery, ComparesAnUnknownHeightWithNoNumber)
{
  SemanticMap open = map(); // without ceilings
  open.rooms[0].height.reset();
  open.storeys[0].ceiling.reset();
  const auto answer = [&](const std::string& query) {
    return answerQuery(open, parseQuery(query));
  };
  EXPECT_EQ(answer("rooms height<100").rows.size(), 1u);
  EXPECT_EQ(answer("rooms height>=0").rows.size(), 1u);
  EXPECT_EQ(answer("storeys height<100").rows.size(), 0u);
  std::ostringstream json, table;
  writeJson(json, answer("rooms id=1"));
  EXPECT_TRUE(nlohmann::json::parse(json.str())["results"][0]["height"].is_null());
  writeTable(table, answer("storeys"));
  EXPECT_EQ(table.str().find("nan"), std::string::npos) << table.str();
}
