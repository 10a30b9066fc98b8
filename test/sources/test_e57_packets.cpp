// SPDX-License-Identifier: BSD-3-Clause
// Packets as other programs write them: indices, empty ones, streams that run ahead.
#include "e57/record_reader.h"
#include "sources/made_e57.h"

#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl6d::test;
using namespace pcl6d::sources;
using Bytes = std::vector<std::uint8_t>;

Bytes
packetOf(std::uint8_t type, Bytes body)
{
  while (body.size() % 4 != 0)
    body.push_back(0);
  Bytes packet = {type, 0, 0, 0};
  storeLittleEndian(body.size() + 3, 2, &packet[2]);
  packet.insert(packet.end(), body.begin(), body.end());
  return packet;
}

/** \return a data packet of streams of bytes */
Bytes
dataPacket(const std::vector<Bytes>& streams)
{
  Bytes body(2 + 2 * streams.size());
  storeLittleEndian(streams.size(), 2, body.data());
  for (std::size_t i = 0; i < streams.size(); ++i) {
    storeLittleEndian(streams[i].size(), 2, &body[2 + 2 * i]);
    body.insert(body.end(), streams[i].begin(), streams[i].end());
  }
  return packetOf(1, body);
}

/** \brief A file with a section of two fields of a byte, a and b, packet by packet. */
class E57Packets : public testing::Test {
protected:
  void
  write(const std::vector<Bytes>& packets, std::size_t count)
  {
    Bytes section(32);
    section[0] = 1;
    for (const auto& packet : packets)
      section.insert(section.end(), packet.begin(), packet.end());
    storeLittleEndian(section.size(), 8, &section[8]);
    storeLittleEndian(kE57HeaderSize + 32, 8, &section[16]);
    PageWriter pages(folder_ / "a.e57");
    pages.write(section.data(), section.size());
    finishWith(
        dataText("<vectorChild type=\"Structure\"><points type=\"CompressedVector\" "
                 "fileOffset=\"48\" recordCount=\"" +
                 std::to_string(count) +
                 "\"><prototype type=\"Structure\"><a type=\"Integer\" minimum=\"0\" "
                 "maximum=\"255\"/><b type=\"Integer\" minimum=\"0\" "
                 "maximum=\"255\"/></prototype></points></vectorChild>"),
        pages);
  }

  /** \return a and b of all points, one behind the other */
  std::vector<std::int64_t>
  read() const
  {
    PageReader file(folder_ / "a.e57");
    const auto scans = readE57Layout(file);
    std::vector<std::int64_t> values;
    readRecords(file,
                scans.at(0),
                "scan 0",
                {0, 1},
                [&](const auto& columns, std::size_t count) {
                  for (std::size_t i = 0; i < count; ++i) {
                    values.push_back(columns[0]->integer(i));
                    values.push_back(columns[1]->integer(i));
                  }
                });
    return values;
  }

  std::string
  refusal() const
  {
    try {
      read();
    } catch (const pcl6d::IoFailed& e) {
      const std::string message = e.what();
      return message.substr(message.find("scan 0"));
    }
    return "none";
  }

  TempFolder folder_;
};

TEST_F(E57Packets, IndexAndEmptyPacketsAreSkipped)
{
  write({packetOf(0, Bytes(28, 9)),
         dataPacket({{1, 2}, {3, 4}}),
         packetOf(2, Bytes(4, 9)),
         packetOf(0, Bytes(12, 9)),
         dataPacket({{5}, {6}})},
        3);
  EXPECT_EQ(read(), (std::vector<std::int64_t>{1, 3, 2, 4, 5, 6}));
}

TEST_F(E57Packets, AStreamMayRunAheadOfTheOther)
{
  write({dataPacket({{1, 2, 3}, {}}), dataPacket({{}, {4}}), dataPacket({{}, {5, 6}})},
        3);
  EXPECT_EQ(read(), (std::vector<std::int64_t>{1, 4, 2, 5, 3, 6}));
}

TEST_F(E57Packets, BytesBehindTheLastPointDoNotCount)
{
  write({dataPacket({{1, 2, 3}, {4, 5, 6}})}, 2);
  EXPECT_EQ(read(), (std::vector<std::int64_t>{1, 4, 2, 5}));
}

TEST_F(E57Packets, WhatIsBrokenIsNamed)
{
  write({dataPacket({{1, 2}, {3}})}, 2);
  EXPECT_EQ(refusal(), "scan 0: holds 1 value of 'b', but 2 points");
  write({packetOf(7, Bytes(4))}, 1);
  EXPECT_EQ(refusal(), "scan 0: a packet has the unknown type 7");
  write({dataPacket({{1}, {2}, {3}})}, 1);
  EXPECT_EQ(refusal(),
            "scan 0: a packet has 3 streams of bytes, but the scan 2 fields");
  Bytes longer = dataPacket({{1}, {2}});
  longer[8] = 200; // of the second stream
  write({longer}, 1);
  EXPECT_EQ(refusal(), "scan 0: the streams of a packet are longer than the packet");
  Bytes beyond = dataPacket({{1}, {2}});
  beyond[3] = 1; // its length
  write({beyond}, 1);
  EXPECT_EQ(refusal(), "scan 0: a packet of 268 bytes goes on behind the section");
  write({{1, 0}}, 1);
  EXPECT_EQ(refusal(), "scan 0: the last packet is cut off");
  write({dataPacket({{1}, {2}})}, 1000000);
  EXPECT_EQ(refusal(),
            "scan 0: has 1000000 points, but its section of 44 bytes has no room for "
            "the streams");
}

} // namespace
