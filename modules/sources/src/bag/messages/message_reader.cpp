// SPDX-License-Identifier: BSD-3-Clause
#include "bag/messages/message_reader.h"

#include <pcl6d/common/number_range.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::sources {

namespace {
constexpr double kNormTolerance = 1e-2; // of a quaternion, equal to trajectory files
} // namespace

MessageReader::MessageReader(const std::filesystem::path& path,
                             const std::string& what,
                             BagEncoding encoding,
                             Bytes bytes)
: path_(path), what_(what), encoding_(encoding), reader_(path, what, bytes)
{
  if (encoding == BagEncoding::kOther)
    fail("the messages are neither in the encoding of ROS 1 nor in CDR");
  if (encoding != BagEncoding::kCdr)
    return;
  // Encapsulation (DDS-XTypes 1.3, 7.6.2.1.2): 0 and 1 plain, 6 and 7 plain of version 2; odd
  // kinds are little-endian.
  const Bytes head = reader_.take(4);
  const unsigned kind = head.data[0] * 256u + head.data[1];
  if (kind != 0 && kind != 1 && kind != 6 && kind != 7)
    fail("CDR of kind " + std::to_string(kind) + ", but 0, 1, 6 or 7 are known");
  is_big_endian_ = kind % 2 == 0;
  largest_step_ = kind >= 6 ? 4 : 8;
  start_ = reader_.position();
}

void
MessageReader::align(std::size_t size)
{
  if (encoding_ != BagEncoding::kCdr)
    return;
  const std::size_t step = std::min(size, largest_step_);
  const std::size_t beyond = (reader_.position() - start_) % step;
  if (beyond > 0)
    reader_.take(step - beyond);
}

std::string
MessageReader::string()
{
  const auto size = number<std::uint32_t>();
  const Bytes taken = reader_.take(size);
  std::string text(reinterpret_cast<const char*>(taken.data), taken.size);
  if (encoding_ == BagEncoding::kCdr && !text.empty() && text.back() == '\0')
    text.pop_back();
  return text;
}

std::uint32_t
MessageReader::count(std::size_t least_size)
{
  const auto elements = number<std::uint32_t>();
  if (std::uint64_t{elements} * least_size > reader_.left())
    fail(std::to_string(elements) + " elements are announced, but only " +
         std::to_string(reader_.left()) + " bytes follow");
  return elements;
}

std::int64_t
MessageReader::time()
{
  const std::int64_t seconds = encoding_ == BagEncoding::kCdr
                                   ? std::int64_t{number<std::int32_t>()}
                                   : std::int64_t{number<std::uint32_t>()};
  return seconds * 1000000000 + number<std::uint32_t>();
}

MessageHeader
MessageReader::header()
{
  if (encoding_ == BagEncoding::kRos1)
    number<std::uint32_t>(); // sequence number
  MessageHeader header;
  header.stamp = time();
  header.frame = plainFrame(string());
  return header;
}

Eigen::Quaterniond
MessageReader::rotation(const Eigen::Quaterniond& q) const
{
  if (!q.coeffs().allFinite())
    fail("a pose is not finite");
  if (std::abs(q.norm() - 1) > kNormTolerance)
    fail("a quaternion has the norm " + text::shortest(q.norm()) +
         ", but a rotation has 1");
  return q.normalized();
}

Eigen::Isometry3d
MessageReader::pose()
{
  Eigen::Vector3d t;
  Eigen::Quaterniond q;
  for (int axis = 0; axis < 3; ++axis)
    t[axis] = number<double>();
  for (int i = 0; i < 4; ++i)
    q.coeffs()[i] = number<double>(); // x, y, z, w
  if (!t.allFinite())
    fail("a pose is not finite");
  const Eigen::Quaterniond unit = rotation(q);
  if (!isPlace(t))
    fail("a position is 1e9 m or farther from the origin");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = unit.toRotationMatrix();
  pose.translation() = t;
  return pose;
}

void
MessageReader::fail(const std::string& message) const
{
  text::fail(path_, what_ + ": " + message);
}

std::string
plainFrame(std::string frame)
{
  return plainName(!frame.empty() && frame.front() == '/' ? frame.substr(1) : frame);
}

} // namespace pcl6d::sources
