// SPDX-License-Identifier: BSD-3-Clause
#include "scan/pcd/pcd_header.h"
#include "scan/point_field.h"
#include "text/text_row.h"

#include <cstring>

namespace pcl6d::io {

std::vector<Column>
columnsOf(const std::vector<pcl::PCLPointField>& fields)
{
  std::vector<Column> columns;
  for (const auto& field : fields)
    for (std::size_t i = 0; i < field.count; ++i)
      columns.push_back(
          {field.datatype, field.offset + i * sizeOfType(field.datatype)});
  return columns;
}

bool
takeRow(std::string_view line, const std::vector<Column>& columns, std::uint8_t* point)
{
  const char* place = line.data();
  const char* const end = place + line.size();
  for (const auto& column : columns) {
    const bool taken = withTypeOf(column.datatype, [&](auto value) {
      if (!takeNumber(place, end, value, Blank()))
        return false;
      std::memcpy(point + column.offset, &value, sizeof value);
      return true;
    });
    if (!taken)
      return false;
  }
  while (place != end && Blank()(*place))
    ++place;
  return place == end;
}

} // namespace pcl6d::io
