// SPDX-License-Identifier: BSD-3-Clause
#include "e57/record_reader.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <array>

namespace pcl6d::sources {

namespace {

constexpr std::size_t kSectionHeader = 32; // bytes
constexpr std::size_t kRecordBlock =
    65536; // points handed over at once, where no packet says
constexpr std::uint8_t kIndexPacket = 0, kDataPacket = 1, kEmptyPacket = 2;

/** \brief Reading of the points of a scan, with the decoders of the fields. */
class RecordReading {
public:
  RecordReading(PageReader& file,
                const E57Scan& scan,
                const std::string& title,
                const std::vector<std::size_t>& wanted)
  : file_(file), scan_(scan), title_(title), decoder_of_(scan.fields.size(), kNone)
  {
    openSection();
    requireRoom();
    for (const std::size_t field : wanted) {
      decoder_of_[field] = decoders_.size();
      decoders_.emplace_back(scan.fields[field], scan.count);
    }
  }

  void
  run(const RecordSink& sink)
  {
    while (given_ < scan_.count && place_ < end_) {
      readPacket();
      giveOut(sink);
    }
    for (std::size_t i = 0; i < scan_.fields.size(); ++i)
      if (decoder_of_[i] != kNone && decoders_[decoder_of_[i]].missing() > 0 &&
          !decoders_[decoder_of_[i]].isConstant())
        fail("holds " +
             text::counted(scan_.count - decoders_[decoder_of_[i]].missing(), "value") +
             " of " + text::quoted(scan_.fields[i].name) + ", but " +
             text::counted(scan_.count, "point"));
    giveOut(sink); // if no field takes bits, the section may have no packet
  }

private:
  static constexpr std::size_t kNone = ~std::size_t{0};

  [[noreturn]] void
  fail(const std::string& message) const
  {
    text::fail(file_.path(), title_ + ": " + message);
  }

  void
  openSection()
  {
    const std::uint64_t begin = file_.logicalOf(scan_.offset, title_);
    std::array<std::uint8_t, kSectionHeader> header{};
    file_.read(begin, header.data(), header.size());
    if (header[0] != 1)
      fail("the points begin with the section type " + std::to_string(header[0]) +
           ", but must with 1");
    const std::uint64_t length = littleEndian(&header[8], 8);
    if (length < kSectionHeader || length > file_.size() - begin)
      fail("its section of " + std::to_string(length) +
           " bytes does not fit into the file");
    end_ = begin + length;
    place_ = end_;
    if (scan_.count == 0)
      return;
    place_ = file_.logicalOf(littleEndian(&header[16], 8), title_ + ": its data");
    if (place_ < begin || place_ > end_)
      fail("the data begin outside of the section");
    length_ = length;
  }

  /** Memory is limited to the number of points that the bits of the section can hold. */
  void
  requireRoom() const
  {
    for (const auto& field : scan_.fields) {
      const std::uint64_t bits = std::max(field.bits(), 1U);
      if (scan_.count > length_ * 8 / bits)
        fail("has " + text::counted(scan_.count, "point") + ", but its section of " +
             std::to_string(length_) + " bytes has no room for the streams");
    }
  }

  void
  readPacket()
  {
    std::array<std::uint8_t, 6> head{};
    if (end_ - place_ < head.size())
      fail("the last packet is cut off");
    file_.read(place_, head.data(), head.size());
    const std::size_t length = littleEndian(&head[2], 2) + 1;
    if (length > end_ - place_)
      fail("a packet of " + std::to_string(length) +
           " bytes goes on behind the section");
    if (head[0] == kDataPacket)
      readData(littleEndian(&head[4], 2), length);
    else if (head[0] != kIndexPacket && head[0] != kEmptyPacket)
      fail("a packet has the unknown type " + std::to_string(head[0]));
    place_ += length;
  }

  void
  readData(std::size_t streams, std::size_t length)
  {
    if (streams != scan_.fields.size())
      fail("a packet has " + text::counted(streams, "stream") +
           " of bytes, but the scan " + text::counted(scan_.fields.size(), "field"));
    std::size_t begin = 6 + 2 * streams;
    if (begin > length)
      fail("a packet is too short for the lengths of the streams");
    packet_.resize(length);
    file_.read(place_, packet_.data(), length);
    for (std::size_t i = 0; i < streams; ++i) {
      const std::size_t size = littleEndian(&packet_[6 + 2 * i], 2);
      if (size > length - begin)
        fail("the streams of a packet are longer than the packet");
      if (decoder_of_[i] != kNone)
        decoders_[decoder_of_[i]].append(packet_.data() + begin, size);
      begin += size;
    }
  }

  /** Hands over the complete points, with values in each field. */
  void
  giveOut(const RecordSink& sink)
  {
    for (;;) {
      std::size_t count = kRecordBlock;
      bool is_constant = true;
      for (auto& decoder : decoders_)
        if (!decoder.isConstant()) {
          count = is_constant ? decoder.column().size()
                              : std::min(count, decoder.column().size());
          is_constant = false;
        }
      count = static_cast<std::size_t>(
          std::min<std::uint64_t>(count, scan_.count - given_));
      if (count == 0)
        return;
      hand(count, sink);
    }
  }

  void
  hand(std::size_t count, const RecordSink& sink)
  {
    std::vector<const E57Column*> columns;
    for (auto& decoder : decoders_) {
      if (decoder.isConstant())
        decoder.appendConstants(count);
      columns.push_back(&decoder.column());
    }
    sink(columns, count);
    for (auto& decoder : decoders_)
      decoder.column().drop(count);
    given_ += count;
  }

  PageReader& file_;
  const E57Scan& scan_;
  const std::string& title_;
  std::vector<std::size_t> decoder_of_; ///< of each field
  std::vector<BitDecoder> decoders_;
  std::vector<std::uint8_t> packet_;
  std::uint64_t place_ = 0;  ///< logical, of the next packet
  std::uint64_t end_ = 0;    ///< of the section
  std::uint64_t length_ = 0; ///< of the section
  std::uint64_t given_ = 0;  ///< points
};

} // namespace

void
readRecords(PageReader& file,
            const E57Scan& scan,
            const std::string& title,
            const std::vector<std::size_t>& wanted,
            const RecordSink& sink)
{
  if (scan.count == 0 && scan.offset == 0)
    return; // some writers omit the section of an empty scan
  RecordReading(file, scan, title, wanted).run(sink);
}

} // namespace pcl6d::sources
