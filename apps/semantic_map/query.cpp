// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "semantic_map/verbs.h"

#include <pcl6d/semantic_map/map_query.h>
#include <pcl6d/semantic_map/semantic_map_io.h>

#include <iostream>

namespace pcl6d::app {
namespace {
constexpr const char* kQueryUsage =
    R"( query MAP "SUBJECT CONDITION..." [options]
Finds entities in a semantic map. MAP: semantic_map.json, or the folder of this file.
SUBJECT: objects, planes, rooms, storeys, scans, links, relations.
CONDITION: [not] KEY OP VALUE[,VALUE...] with OP one of = != < <= > >=.
Every condition must be true, for at least one of its values. VALUE: a number, a
word, text in quotes, an entity like plane:12, or * for any value. Keys: share/doc/semantic_map.md.

  objects class=chair on=floor room=2
  planes label=wall area>4 parallel=12
  objects class='waste bin' not next_to=table
  scans seen=object:3
  rooms has=bed,sofa
)";
} // namespace

int
runMapQuery(const std::vector<std::string>& arguments)
{
  std::string file;
  std::string text;
  bool as_json = false;
  OptionTable table(std::string("usage: ") + kSemanticMap + kQueryUsage);
  table.positional("MAP", &file);
  table.positional("QUERY", &text);
  table.group("Output");
  table.add("json", &as_json)
      .help("print JSON with every property in place of a table");
  if (!table.parse(arguments))
    return kDone;
  const SemanticMap map = readSemanticMap(mapFile(file));
  QueryResult result;
  try {
    result = answerQuery(map, parseQuery(text));
  } catch (const QueryError& error) {
    std::cerr << error.marked() << '\n';
    throw UsageError(error.what());
  }
  if (as_json)
    writeJson(std::cout, result);
  else {
    writeTable(std::cout, result);
    std::cout << result.rows.size() << (result.rows.size() == 1 ? " row\n" : " rows\n");
  }
  flushOutput();
  return kDone;
}

} // namespace pcl6d::app
