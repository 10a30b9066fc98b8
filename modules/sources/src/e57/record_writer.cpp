// SPDX-License-Identifier: BSD-3-Clause
#include "e57/record_writer.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace pcl6d::sources {

namespace {

constexpr std::size_t kRecordHeader = 32; // bytes of the section's header
constexpr std::size_t kLargestPacket =
    65536; // [byte] the packet header has 16 bits for the length - 1

std::size_t
paddedToFour(std::size_t size)
{
  return (size + 3) / 4 * 4;
}

/** \return the number of points that fit into a packet, with each field ending on a whole byte */
std::size_t
pointsOfPacket(const std::vector<unsigned>& bits)
{
  const std::size_t room = kLargestPacket - 6 - 2 * bits.size();
  // The number of bits of a point equals the number of bytes of eight points.
  const std::size_t eight = std::max<std::size_t>(
      std::accumulate(bits.begin(), bits.end(), std::size_t{0}), 1);
  return std::max<std::size_t>(room / eight, 1) * 8;
}

} // namespace

RecordWriter::RecordWriter(PageWriter& file,
                           const std::vector<E57Field>& fields,
                           std::uint64_t count,
                           std::size_t packet_points)
: file_(file), encoders_(fields.begin(), fields.end()), count_(count)
{
  for (const auto& field : fields)
    bits_.push_back(field.bits());
  packet_points_ = packet_points > 0 ? packet_points : pointsOfPacket(bits_);
  file_.align();
  offset_ = file_.physical();
  std::array<std::uint8_t, kRecordHeader> header{};
  header[0] = 1;
  const std::uint64_t data = file_.logical() + kRecordHeader;
  storeLittleEndian(kRecordHeader + packetsLength(), 8, &header[8]);
  storeLittleEndian(
      data / kPageContent * kPageSize + data % kPageContent, 8, &header[16]);
  file_.write(header.data(), header.size());
  if (count_ == 0)
    writePacket(true);
}

/** The header, ahead of the packets, contains the length of the section. */
std::uint64_t
RecordWriter::packetsLength() const
{
  std::uint64_t length = 0, done = 0;
  do {
    const std::uint64_t next = std::min<std::uint64_t>(count_, done + packet_points_);
    std::size_t packet = 6 + 2 * bits_.size();
    for (const unsigned bits : bits_) {
      const std::uint64_t end =
          next == count_ ? (bits * next + 7) / 8 : bits * next / 8;
      packet += end - bits * done / 8;
    }
    length += paddedToFour(packet);
    done = next;
  } while (done < count_);
  return length;
}

void
RecordWriter::endPoint()
{
  ++added_;
  if (added_ == count_ || added_ % packet_points_ == 0)
    writePacket(added_ == count_);
}

void
RecordWriter::writePacket(bool is_last)
{
  std::vector<std::uint8_t> packet(6 + 2 * encoders_.size());
  for (std::size_t i = 0; i < encoders_.size(); ++i) {
    const std::size_t size = encoders_[i].waiting(is_last);
    storeLittleEndian(size, 2, &packet[6 + 2 * i]);
    encoders_[i].take(size, packet);
  }
  packet.resize(paddedToFour(packet.size()));
  packet[0] = 1; // data
  storeLittleEndian(packet.size() - 1, 2, &packet[2]);
  storeLittleEndian(encoders_.size(), 2, &packet[4]);
  file_.write(packet.data(), packet.size());
}

} // namespace pcl6d::sources
