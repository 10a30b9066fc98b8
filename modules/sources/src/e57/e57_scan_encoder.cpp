// SPDX-License-Identifier: BSD-3-Clause
#include "e57/e57_columns.h"
#include "e57/e57_scan_encoder.h"

#include <pcl6d/common/fingerprint.h>

#include <cstdio>

namespace pcl6d::sources {

namespace {

/** \return an identifier of a scan derived from the content: equal input gives an equal file
 * \param[in] points fingerprint of all values */
std::string
guidOf(const WrittenScan& scan, const Fingerprint& points)
{
  Fingerprint halves[2] = {points, points};
  halves[1].add(scan.count);
  for (Fingerprint& half : halves) {
    for (const char c : scan.name)
      half.add(static_cast<std::uint32_t>(static_cast<unsigned char>(c)));
    half.add(scan.offset);
  }
  const std::uint64_t a = halves[0].value(), b = halves[1].value();
  char text[48];
  std::snprintf(text,
                sizeof text,
                "{%08x-%04x-%04x-%04x-%012llx}",
                static_cast<unsigned>(a >> 32),
                static_cast<unsigned>(a >> 16) & 0xFFFF,
                static_cast<unsigned>(a) & 0xFFFF,
                static_cast<unsigned>(b >> 48),
                static_cast<unsigned long long>(b & 0xFFFFFFFFFFFF));
  return text;
}

} // namespace

WrittenScan
encodeStation(const E57Station& station, PageWriter& file)
{
  WrittenScan written;
  written.name = station.name;
  written.pose = station.pose;
  written.stamp = station.stamp;
  written.count = std::size_t{station.scan.cloud.width} * station.scan.cloud.height;
  const std::vector<ValueColumn> columns = columnsOf(station, written);
  for (const auto& column : columns)
    written.fields.push_back(column.field);
  RecordWriter records(file, written.fields, written.count);
  Fingerprint points;
  for (std::size_t i = 0; i < written.count; ++i) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double value = columns[c].at(i);
      points.add(value);
      if (written.fields[c].isInteger())
        records.field(c).addInteger(static_cast<std::int64_t>(value));
      else
        records.field(c).addReal(value);
    }
    records.endPoint();
  }
  written.offset = records.offset();
  written.guid = guidOf(written, points);
  return written;
}

} // namespace pcl6d::sources
