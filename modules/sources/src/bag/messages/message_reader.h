// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bag/files/byte_reader.h"

#include <pcl6d/sources/bag.h>

#include <Eigen/Geometry>

#include <cstring>
#include <string>

namespace pcl6d::sources {

/** \brief Stamp and frame of a message: std_msgs/Header. */
struct MessageHeader {
  std::int64_t stamp = 0; ///< [ns]
  std::string frame;      ///< of the coordinates, without a leading slash
};

/** \brief Reads the values of a message in sequence, in the order of the definition.
 *
 * ROS 1: little-endian, without padding. CDR: a four-byte header gives the byte order, and each
 * number is aligned to a multiple of its size behind the header (at most four bytes in version
 * 2). */
class MessageReader {
public:
  /** \param[in] what for messages: "topic /points" \throws IoFailed a CDR header is missing, or
   * the encoding is kOther */
  MessageReader(const std::filesystem::path& path,
                const std::string& what,
                BagEncoding encoding,
                Bytes bytes);

  BagEncoding
  encoding() const
  {
    return encoding_;
  }

  /** \return whether numbers have their highest byte first */
  bool
  isBigEndian() const
  {
    return is_big_endian_;
  }

  /** \return a number of type T, integer or floating */
  template <typename T>
  T
  number()
  {
    align(sizeof(T));
    return numberOf<T>(reader_.take(sizeof(T)).data, is_big_endian_);
  }

  /** \return a text, without CDR's terminating zero */
  std::string
  string();

  /** \return the number of elements of an array; each of at least least_size bytes
   * \throws IoFailed the message is too short for the elements */
  std::uint32_t
  count(std::size_t least_size);

  /** \return the next bytes, unchanged */
  Bytes
  bytes(std::uint64_t size)
  {
    return reader_.take(size);
  }

  /** \return [ns] */
  std::int64_t
  time();

  MessageHeader
  header();

  /** \return the quaternion with the norm 1
   * \throws IoFailed a number is not finite, or the norm is not 1 within 1e-2 */
  Eigen::Quaterniond
  rotation(const Eigen::Quaterniond& q) const;

  /** \brief Reads three coordinates and a quaternion.
   * \throws IoFailed a number is not finite, or the quaternion has not the norm 1 within 1e-2 */
  Eigen::Isometry3d
  pose();

  /** \return the number in the given byte order */
  template <typename T>
  static T
  numberOf(const std::uint8_t* bytes, bool is_big_endian)
  {
    std::uint8_t ordered[sizeof(T)]; // in x86-64's order, little-endian
    for (std::size_t i = 0; i < sizeof(T); ++i)
      ordered[i] = bytes[is_big_endian ? sizeof(T) - 1 - i : i];
    T value;
    std::memcpy(&value, ordered, sizeof(T));
    return value;
  }

  /** \throws IoFailed "path: what: message" */
  [[noreturn]] void
  fail(const std::string& message) const;

private:
  void
  align(std::size_t size);

  const std::filesystem::path& path_;
  const std::string& what_;
  BagEncoding encoding_;
  ByteReader reader_;
  bool is_big_endian_ = false;
  std::size_t start_ = 0;        ///< of the message behind the CDR header
  std::size_t largest_step_ = 8; ///< [byte] of the alignment
};

/** \return the frame without a leading slash */
std::string
plainFrame(std::string frame);

} // namespace pcl6d::sources
