// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io_test.h"
#include "scan/las/las_header.h"
#include "scan/las/laz_writer.h"

#include <pcl6d/common/random.h>

#include <cmath>

/** \file LAS and LAZ files byte by byte after the specification, apart from the writer. */
namespace pcl6d::test {

/** \brief A LAS file in parts, each of which a test may change. */
struct LasSample {
  int minor = 4;
  int format = 0;
  std::vector<std::string> records; ///< of the points, all of one size
  double scale[3] = {0.001, 0.01, 0.0005};
  double offset[3] = {10, -20, 3};
  std::string vlrs; ///< behind the header
  std::uint32_t num_vlrs = 0;
  std::string behind; ///< the points, such as EVLRs

  /** \return the value of a coordinate of a point */
  double
  coordinate(std::size_t i, int axis) const
  {
    std::int32_t steps = 0;
    std::memcpy(&steps, &records[i][static_cast<std::size_t>(4 * axis)], 4);
    return offset[axis] + scale[axis] * steps;
  }
};

template <typename T>
void
put(std::string& bytes, std::size_t place, T value)
{
  bytes.replace(
      place, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
}

/** \return the header with counts of both kinds, where the version knows them */
inline std::string
lasHeaderOf(const LasSample& sample, std::size_t record_size)
{
  const std::size_t size = sample.minor >= 4 ? 375 : sample.minor == 3 ? 235 : 227;
  std::string header(size, '\0');
  header.replace(0, 4, "LASF");
  header[24] = 1;
  header[25] = static_cast<char>(sample.minor);
  put(header, 94, static_cast<std::uint16_t>(size));
  put(header, 96, static_cast<std::uint32_t>(size + sample.vlrs.size()));
  put(header, 100, sample.num_vlrs);
  header[104] = static_cast<char>(sample.format);
  put(header, 105, static_cast<std::uint16_t>(record_size));
  if (sample.format < 6)
    put(header, 107, static_cast<std::uint32_t>(sample.records.size()));
  if (sample.minor >= 4)
    put(header, 247, static_cast<std::uint64_t>(sample.records.size()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(header, 131 + 8 * axis, sample.scale[axis]);
    put(header, 155 + 8 * axis, sample.offset[axis]);
  }
  return header + sample.vlrs;
}

inline std::string
lasBytes(const LasSample& sample)
{
  std::string bytes =
      lasHeaderOf(sample,
                  sample.records.empty() ? io::lasLayoutOf(sample.format).size
                                         : sample.records[0].size());
  for (const auto& record : sample.records)
    bytes += record;
  return bytes + sample.behind;
}

/** \return a record "laszip encoded" or the like */
inline std::string
vlrOf(const std::string& user, std::uint16_t number, const std::string& content)
{
  std::string vlr(54, '\0');
  vlr.replace(2, user.size(), user);
  put(vlr, 18, number);
  put(vlr, 20, static_cast<std::uint16_t>(content.size()));
  return vlr + content;
}

inline io::LazItems
lazItemsOf(int format, std::size_t num_bytes)
{
  const io::LasLayout layout = io::lasLayoutOf(format);
  io::LazItems items;
  items.is_layered = layout.is_new;
  items.has_time = !layout.is_new && layout.time > 0;
  items.has_colours = layout.colours > 0;
  items.has_infrared = layout.infrared > 0;
  items.num_bytes = num_bytes;
  return items;
}

/** \brief Where a LAZ file has its table of chunks. */
enum class ChunkTable { kTold, kAtTheEnd, kMissing };

/** \return the sample compressed */
inline std::string
lazBytes(LasSample sample,
         std::uint32_t chunk_size = 50000,
         ChunkTable table = ChunkTable::kTold,
         bool has_right_channels = false)
{
  const std::size_t size = sample.records.at(0).size();
  io::LazItems items =
      lazItemsOf(sample.format, size - io::lasLayoutOf(sample.format).size);
  items.has_right_channels = has_right_channels;
  io::LazWriter writer(items, chunk_size);
  std::string points;
  for (const auto& record : sample.records)
    writer.add(reinterpret_cast<const std::uint8_t*>(record.data()), points);
  const std::size_t at = writer.finish(points);
  if (table == ChunkTable::kMissing)
    points.resize(at);
  sample.vlrs += vlrOf("laszip encoded", 22204, writer.description());
  ++sample.num_vlrs;
  std::string bytes = lasHeaderOf(sample, size);
  bytes[104] = static_cast<char>(sample.format | 0x80);
  const auto place = static_cast<std::int64_t>(bytes.size() + 8 + at);
  std::string told(8, '\0');
  put(told, 0, table == ChunkTable::kTold ? place : std::int64_t{-1});
  bytes += told + points + sample.behind;
  std::string end(8, '\0');
  put(end, 0, place);
  return table == ChunkTable::kAtTheEnd ? bytes + end : bytes;
}

/** \brief Points as scanners make them: lines of points, several returns, times in steps
 * of several lasers, and now and then a value that has nothing to do with the last one. */
class LasRecords {
public:
  LasRecords(int format,
             std::size_t num_bytes,
             std::uint64_t seed,
             unsigned channels = 1)
  : layout_(io::lasLayoutOf(format))
  , format_(format)
  , num_bytes_(num_bytes)
  , channels_(channels)
  , random_(seed)
  {}

  std::vector<std::string>
  make(std::size_t count)
  {
    std::vector<std::string> records;
    for (std::size_t i = 0; i < count; ++i)
      records.push_back(next());
    return records;
  }

private:
  std::uint32_t
  below(std::uint32_t count)
  {
    return static_cast<std::uint32_t>(random_.uniform() * count);
  }
  bool
  sometimes(int one_of)
  {
    return below(static_cast<std::uint32_t>(one_of)) == 0;
  }

  /** A step of any size, as likely small as large. */
  std::int32_t
  step()
  {
    const std::uint32_t bits = sometimes(50) ? 31 : below(12);
    const auto size = static_cast<std::int32_t>(random_.uniform() * std::pow(2, bits));
    return sometimes(2) ? -size : size;
  }

  void
  changeTime()
  {
    if (sometimes(3)) // same pulse
      return;
    const std::size_t laser = below(3);
    if (sometimes(40))
      times_[laser] += random_.uniform(-1e5, 1e5);
    else if (sometimes(30))
      times_[laser] += 1e-3 * below(20000); // beyond all multiples
    else if (sometimes(30))
      times_[laser] -= 1e-5 * below(15);
    else
      times_[laser] += 1e-5 * (1 + below(4));
    time_ = times_[laser];
    if (sometimes(500))
      time_ = std::nan("");
  }

  std::string
  next()
  {
    for (std::int32_t& value : place_)
      value = static_cast<std::int32_t>(static_cast<std::uint32_t>(value) +
                                        static_cast<std::uint32_t>(step()));
    changeTime();
    if (sometimes(4))
      count_ = 1 + below(layout_.is_new ? 15 : 7);
    number_ = sometimes(100) ? below(layout_.is_new ? 16 : 8)
                             : 1 + number_ % count_; // some make no sense
    if (sometimes(3))
      intensity_ = static_cast<std::uint16_t>(sometimes(9) ? below(65536)
                                                           : intensity_ + below(30));
    if (sometimes(20))
      class_ = static_cast<std::uint8_t>(below(layout_.is_new ? 256 : 32));
    if (sometimes(50))
      user_ = static_cast<std::uint8_t>(below(256));
    if (sometimes(30))
      angle_ = static_cast<std::int16_t>(angle_ + step() % 100);
    if (sometimes(60))
      source_ = static_cast<std::uint16_t>(below(65536));
    if (sometimes(7))
      flags_ = static_cast<std::uint8_t>(below(16));
    if (sometimes(20))
      channel_ = below(channels_);
    return record();
  }

  std::string
  record()
  {
    std::string record(layout_.size + num_bytes_, '\0');
    for (std::size_t axis = 0; axis < 3; ++axis)
      put(record, 4 * axis, place_[axis]);
    put(record, 12, intensity_);
    if (layout_.is_new) {
      record[14] = static_cast<char>(number_ | count_ << 4);
      record[15] =
          static_cast<char>((flags_ & 11) | channel_ << 4 | (flags_ & 12) << 4);
      record[16] = static_cast<char>(class_);
      put(record, 18, angle_);
      put(record, 20, source_);
    }
    else {
      record[14] = static_cast<char>(number_ | count_ << 3 | (flags_ & 3) << 6);
      record[15] = static_cast<char>(class_);
      record[16] = static_cast<char>(angle_);
      put(record, 18, source_);
    }
    record[17] = static_cast<char>(user_);
    if (layout_.time > 0)
      put(record, layout_.time, time_);
    if (layout_.colours > 0)
      putColours(record);
    if (layout_.infrared > 0) {
      if (sometimes(2))
        infrared_ = static_cast<std::uint16_t>(infrared_ + below(700));
      put(record, layout_.infrared, infrared_);
    }
    for (std::size_t i = 0; i < num_bytes_; ++i) // the first one never changes
      record[layout_.size + i] = static_cast<char>(i > 0 ? below(3) : 7);
    return record;
  }

  void
  putColours(std::string& record)
  {
    if (sometimes(2))
      for (std::uint16_t& value : colour_)
        value = static_cast<std::uint16_t>(sometimes(3) ? below(65536)
                                                        : value + below(300));
    if (sometimes(5))
      colour_[1] = colour_[2] = colour_[0]; // grey
    for (std::size_t i = 0; i < 3; ++i)
      put(record, layout_.colours + 2 * i, colour_[i]);
  }

  io::LasLayout layout_;
  int format_;
  std::size_t num_bytes_;
  unsigned channels_;
  Random random_;
  std::int32_t place_[3] = {};
  double times_[3] = {1000, 1000.1, 5e8};
  double time_ = 1000;
  std::uint32_t count_ = 1, number_ = 1, channel_ = 0;
  std::uint16_t intensity_ = 100, source_ = 7, infrared_ = 3;
  std::uint8_t class_ = 2, user_ = 0, flags_ = 0;
  std::int16_t angle_ = 0;
  std::uint16_t colour_[3] = {100, 2000, 30000};
};

/** \return a sample of a format with random points */
inline LasSample
lasSample(int format,
          std::size_t count,
          std::size_t num_bytes = 0,
          unsigned channels = 1)
{
  LasSample sample;
  sample.format = format;
  sample.minor = format >= 6 ? 4 : format >= 4 ? 3 : 2;
  sample.records =
      LasRecords(format, num_bytes, count + static_cast<std::size_t>(format), channels)
          .make(count);
  return sample;
}

} // namespace pcl6d::test
