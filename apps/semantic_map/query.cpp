// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "semantic_map/verbs.h"

#include <pcl6d/semantic_map/map_query.h>
#include <pcl6d/semantic_map/semantic_map_io.h>

#include <iostream>

namespace pcl6d::app {
namespace {
constexpr const char* kQueryUsage =
    " query MAP \"SUBJECT CONDITION...\" [options]\n"
    "Finds things in a semantic map. MAP: semantic_map.json, or a folder that holds "
    "it.\n"
    "SUBJECT: objects, planes, rooms, storeys, scans, links, relations.\n"
    "CONDITION: [not] KEY OP VALUE[,VALUE...] with OP one of = != < <= > >=.\n"
    "All conditions must hold, of the values one. VALUE: a number, a word, text in\n"
    "quotes, a thing such as plane:12, or * for anything. Keys: share/doc/"
    "semantic_map.md.\n\n"
    "  objects class=chair on=floor room=2\n"
    "  planes label=wall area>4 parallel=12\n"
    "  objects class='waste bin' not next_to=table\n"
    "  scans seen=object:3\n"
    "  rooms has=bed,sofa\n";
} // namespace

int
runMapQuery(const std::vector<std::string>& arguments)
{
  std::string file;
  std::string text;
  bool as_json = false;
  CommandLine line(std::string("usage: ") + kSemanticMap + kQueryUsage);
  line.positional("MAP", &file);
  line.positional("QUERY", &text);
  line.group("Output").add_options()(
      "json",
      boost::program_options::bool_switch(&as_json),
      "print JSON with all properties in place of a table");
  if (!line.parse(arguments))
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
