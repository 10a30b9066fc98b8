// SPDX-License-Identifier: BSD-3-Clause
#include "scan/las/las_header.h"

#include <cmath>

namespace pcl6d::io {

namespace {

constexpr std::size_t kShortHeader = 227; // [byte] up to LAS 1.2
constexpr std::size_t kLongHeader = 375;  // [byte] of LAS 1.4
constexpr std::size_t kVlrHeader = 54;    // [byte]

/** \brief Items of LAZ by their numbers. */
enum LazItemType : std::uint16_t {
  kByte = 0,
  kPoint10 = 6,
  kTime11 = 7,
  kRgb12 = 8,
  kWaveform13 = 9,
  kPoint14 = 10,
  kRgb14 = 11,
  kRgbNir14 = 12,
  kWaveform14 = 13,
  kByte14 = 14
};

/** \brief Parses the bytes of a file up to the points. */
class LasHeaderReader {
public:
  explicit LasHeaderReader(FileInput& input) : input_(input) {}

  LasHeader
  read()
  {
    readFixed();
    readFormat();
    readCount();
    readTransform();
    readVlrs();
    if (is_compressed_ && !header_.laz)
      fail("the points are compressed, but the record 'laszip encoded' with the layout "
           "is missing");
    return std::move(header_);
  }

private:
  [[noreturn]] void
  fail(const std::string& message) const
  {
    text::fail(input_.path(), message);
  }

  template <typename T>
  T
  at(std::size_t place) const
  {
    return lasNumber<T>(&bytes_[place]);
  }

  /** Reads on until the buffer has `size` bytes. */
  bool
  reach(std::size_t size)
  {
    return bytes_.size() >= size || input_.append(size - bytes_.size(), bytes_);
  }

  void
  readFixed()
  {
    if (!reach(kShortHeader))
      fail(bytes_.empty() ? "is empty, but must begin with the header of a LAS file"
                          : "ends within the header, after " +
                                text::counted(bytes_.size(), "byte"));
    if (std::memcmp(bytes_.data(), "LASF", 4) != 0)
      fail("is no LAS file: does not begin with LASF");
    const int major = bytes_[24];
    header_.minor = bytes_[25];
    if (major != 1 || header_.minor > 4)
      fail("has LAS version " + std::to_string(major) + '.' +
           std::to_string(header_.minor) + ", but must have 1.0 to 1.4");
    header_size_ = at<std::uint16_t>(94);
    header_.points_begin = at<std::uint32_t>(96);
    if (header_size_ < kShortHeader)
      fail("has a header of " + std::to_string(header_size_) +
           " bytes, but must have " + std::to_string(kShortHeader) + " at least");
    if (header_.points_begin < header_size_)
      fail("the points begin at byte " + std::to_string(header_.points_begin) +
           ", within its header of " + std::to_string(header_size_));
    if (!reach(header_.points_begin))
      fail("the points begin at byte " + std::to_string(header_.points_begin) +
           ", but it ends at " + std::to_string(bytes_.size()));
  }

  void
  readFormat()
  {
    const unsigned number = bytes_[104];
    is_compressed_ = (number & 0xc0) != 0;
    header_.format = static_cast<int>(number & 0x3f);
    if (header_.format > 10)
      fail("has point format " + std::to_string(header_.format) +
           ", but must have 0 to 10");
    header_.layout = lasLayoutOf(header_.format);
    header_.record_size = at<std::uint16_t>(105);
    if (header_.record_size < header_.layout.size)
      fail("has points of " + text::counted(header_.record_size, "byte") +
           ", but those of format " + std::to_string(header_.format) + " have " +
           std::to_string(header_.layout.size) + " at least");
    if (header_.layout.has_waveform)
      header_.left_out.emplace_back("the waveforms of the points");
    if (header_.record_size > header_.layout.size)
      header_.left_out.push_back(
          text::counted(header_.record_size - header_.layout.size, "further byte") +
          " of each point");
  }

  void
  readCount()
  {
    header_.count = at<std::uint32_t>(107);
    if (header_.minor >= 4 && header_size_ >= kLongHeader &&
        at<std::uint64_t>(247) > 0) // else only the legacy field is filled in
      header_.count = at<std::uint64_t>(247);
  }

  void
  readTransform()
  {
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t place = 131 + 8 * static_cast<std::size_t>(axis);
      header_.scale[axis] = at<double>(place);
      header_.offset[axis] = at<double>(place + 24);
      const std::string name(1, "xyz"[axis]);
      // Coordinates stay below 1e9 m, like poses; the scale must not be zero.
      if (!(std::abs(header_.scale[axis]) > 0 && std::abs(header_.scale[axis]) <= 1e9))
        fail("scale of " + name + " = " + text::shortest(header_.scale[axis]) +
             ", but must be neither 0 nor beyond 1e9");
      if (!(std::abs(header_.offset[axis]) <= 1e12))
        fail("offset of " + name + " = " + text::shortest(header_.offset[axis]) +
             ", but must be finite and within 1e12");
    }
  }

  /** Old writers put arbitrary bytes behind the header: invalid content is not treated as a
   * record. */
  void
  readVlrs()
  {
    const std::size_t count = at<std::uint32_t>(100);
    std::size_t place = header_size_;
    for (std::size_t i = 0; i < count; ++i) {
      if (place + kVlrHeader > header_.points_begin)
        return leaveOutRecords(count - i);
      const std::size_t size = at<std::uint16_t>(place + 20);
      if (place + kVlrHeader + size > header_.points_begin)
        return leaveOutRecords(count - i);
      readVlr(place, size);
      place += kVlrHeader + size;
    }
  }

  void
  leaveOutRecords(std::size_t count)
  {
    header_.left_out.push_back(text::counted(count, "record") +
                               " of the header: too many to fit before the points");
  }

  void
  readVlr(std::size_t place, std::size_t size)
  {
    const std::string user(
        reinterpret_cast<const char*>(&bytes_[place + 2]),
        strnlen(reinterpret_cast<const char*>(&bytes_[place + 2]), 16));
    const unsigned record = at<std::uint16_t>(place + 18);
    if (user == "laszip encoded" && record == 22204 && is_compressed_)
      readLaz(place + kVlrHeader, size);
    else if (user == "LASF_Projection")
      readProjection(record, place + kVlrHeader, size);
  }

  void
  readProjection(unsigned record, std::size_t place, std::size_t size)
  {
    constexpr unsigned kWkt = 2112;
    const char* const text = reinterpret_cast<const char*>(bytes_.data()) + place;
    if (record == kWkt)
      header_.coordinate_system.assign(text, strnlen(text, size));
    if (!has_projection_)
      header_.left_out.emplace_back("its coordinate reference system");
    has_projection_ = true;
  }

  void
  readLaz(std::size_t place, std::size_t size)
  {
    constexpr std::size_t kFixed = 34, kItem = 6; // [byte]
    if (size < kFixed || size < kFixed + kItem * at<std::uint16_t>(place + kFixed - 2))
      fail("the record 'laszip encoded' has only " + text::counted(size, "byte"));
    const unsigned compressor = at<std::uint16_t>(place);
    const unsigned coder = at<std::uint16_t>(place + 2);
    if (compressor < 1 || compressor > 3 || coder != 0)
      fail("is compressed by method " + std::to_string(compressor) + '.' +
           std::to_string(coder) + " of LAZ: unknown (known: 1.0 to 3.0)");
    LazRecord laz;
    laz.is_chunked = compressor != 1;
    laz.items.is_layered = compressor == 3;
    laz.chunk_size = at<std::uint32_t>(place + 12);
    if (laz.is_chunked && laz.chunk_size == 0)
      fail("its chunks hold 0 points");
    const std::size_t count = at<std::uint16_t>(place + kFixed - 2);
    for (std::size_t i = 0; i < count; ++i)
      readItem(place + kFixed + kItem * i, i, laz.items);
    if (laz.items.size() != header_.record_size)
      fail("its compressed parts have " + text::counted(laz.items.size(), "byte") +
           " a point, but the points have " + std::to_string(header_.record_size));
    header_.laz = laz;
  }

  void
  readItem(std::size_t place, std::size_t i, LazItems& items)
  {
    const unsigned type = at<std::uint16_t>(place);
    const std::size_t size = at<std::uint16_t>(place + 2);
    const unsigned version = at<std::uint16_t>(place + 4);
    const bool is_new = type >= kPoint14;
    if (type == kWaveform13 || type == kWaveform14)
      fail("is a LAZ file with waveforms (point format " +
           std::to_string(header_.format) +
           "): cannot be read; decompress the file to LAS");
    // POINT10 or POINT14 is always the first part of a point, and appears only once.
    const bool is_point = type == kPoint10 || type == kPoint14;
    if (is_new != items.is_layered || is_point != (i == 0) ||
        is_new != header_.layout.is_new)
      failAtItem(type, version);
    if (is_new ? version != 3 && version != 4 : version != 2)
      failAtItem(type, version);
    items.has_right_channels = version == 4;
    const bool has_no_more = items.num_bytes == 0 && !items.has_colours;
    if (type == kTime11 && size == 8 && !items.has_time && has_no_more)
      items.has_time = true;
    else if ((type == kRgb12 || type == kRgb14) && size == 6 && has_no_more)
      items.has_colours = true;
    else if (type == kRgbNir14 && size == 8 && has_no_more)
      items.has_colours = items.has_infrared = true;
    else if ((type == kByte || type == kByte14) && items.num_bytes == 0)
      items.num_bytes = size;
    else if (!is_point)
      failAtItem(type, version);
  }

  [[noreturn]] void
  failAtItem(unsigned type, unsigned version) const
  {
    fail("has a part of type " + std::to_string(type) + ", version " +
         std::to_string(version) + " in points of format " +
         std::to_string(header_.format) +
         ": cannot be read (LAZ: formats 0 to 3 and 6 to 8); decompress the file to "
         "LAS");
  }

  FileInput& input_;
  std::vector<std::uint8_t> bytes_;
  std::size_t header_size_ = 0;
  bool is_compressed_ = false;
  bool has_projection_ = false;
  LasHeader header_;
};

} // namespace

LasLayout
lasLayoutOf(int format)
{
  switch (format) {
  case 0:
    return {20};
  case 1:
    return {28, 20};
  case 2:
    return {26, 0, 20};
  case 3:
    return {34, 20, 28};
  case 4:
    return {57, 20, 0, 0, true};
  case 5:
    return {63, 20, 28, 0, true};
  case 6:
    return {30, 22, 0, 0, false, true};
  case 7:
    return {36, 22, 30, 0, false, true};
  case 8:
    return {38, 22, 30, 36, false, true};
  case 9:
    return {59, 22, 0, 0, true, true};
  default:
    return {67, 22, 30, 36, true, true};
  }
}

LasHeader
readLasHeader(FileInput& input)
{
  return LasHeaderReader(input).read();
}

} // namespace pcl6d::io
