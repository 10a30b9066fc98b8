// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

/** \file Messages of robots written for tests, value by value as their definitions say. */
namespace pcl6d::test {

/** \brief How the bytes of a message are laid out. */
enum class MadeEncoding { kRos1, kCdr, kCdrBigEndian };

/** \brief Writes values one after the other. */
class MessageWriter {
public:
  explicit MessageWriter(MadeEncoding encoding) : encoding_(encoding)
  {
    if (encoding != MadeEncoding::kRos1)
      bytes_ = {0, static_cast<char>(encoding == MadeEncoding::kCdr), 0, 0};
  }

  template <typename T>
  MessageWriter&
  number(T value)
  {
    if (encoding_ != MadeEncoding::kRos1)
      while ((bytes_.size() - 4) % sizeof(T) != 0)
        bytes_ += '\x7f'; // nobody may read it
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (encoding_ == MadeEncoding::kCdrBigEndian)
      std::reverse(raw, raw + sizeof(T));
    bytes_.append(raw, sizeof(T));
    return *this;
  }

  MessageWriter&
  text(const std::string& value)
  {
    const bool has_end = encoding_ != MadeEncoding::kRos1;
    number(static_cast<std::uint32_t>(value.size() + (has_end ? 1 : 0)));
    bytes_ += value;
    if (has_end)
      bytes_ += '\0';
    return *this;
  }

  MessageWriter&
  header(std::int64_t stamp, const std::string& frame)
  {
    if (encoding_ == MadeEncoding::kRos1)
      number(std::uint32_t{77});
    number(static_cast<std::uint32_t>(stamp / 1000000000));
    number(static_cast<std::uint32_t>(stamp % 1000000000));
    return text(frame);
  }

  MessageWriter&
  pose(const Eigen::Isometry3d& pose)
  {
    const Eigen::Quaterniond q(pose.linear());
    for (int i = 0; i < 3; ++i)
      number(pose.translation()[i]);
    for (int i = 0; i < 4; ++i)
      number(q.coeffs()[i]);
    return *this;
  }

  MessageWriter&
  raw(const std::string& bytes)
  {
    bytes_ += bytes;
    return *this;
  }

  const std::string&
  bytes() const
  {
    return bytes_;
  }

private:
  MadeEncoding encoding_;
  std::string bytes_;
};

/** \brief A field of a PointCloud2. */
struct MadeField {
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = 7; ///< 7: float32, 8: float64
};

/** \brief A PointCloud2 with its data as bytes. */
struct MadeCloud {
  std::int64_t stamp = 0; ///< [ns]
  std::string frame = "lidar";
  std::uint32_t height = 1, width = 0;
  std::vector<MadeField> fields = {{"x", 0}, {"y", 4}, {"z", 8}};
  std::uint32_t point_step = 12, row_step = 0;
  bool is_big_endian = false;
  std::string data;
};

inline std::string
cloudMessage(MadeEncoding encoding, const MadeCloud& cloud)
{
  MessageWriter out(encoding);
  out.header(cloud.stamp, cloud.frame).number(cloud.height).number(cloud.width);
  out.number(static_cast<std::uint32_t>(cloud.fields.size()));
  for (const MadeField& field : cloud.fields)
    out.text(field.name)
        .number(field.offset)
        .number(field.datatype)
        .number(std::uint32_t{1});
  out.number(static_cast<std::uint8_t>(cloud.is_big_endian))
      .number(cloud.point_step)
      .number(cloud.row_step > 0 ? cloud.row_step : cloud.width * cloud.point_step)
      .number(static_cast<std::uint32_t>(cloud.data.size()))
      .raw(cloud.data)
      .number(std::uint8_t{1});
  return out.bytes();
}

/** \return a cloud of float32 x y z */
inline MadeCloud
plainCloud(std::int64_t stamp, const std::vector<Eigen::Vector3f>& points)
{
  MadeCloud cloud;
  cloud.stamp = stamp;
  cloud.width = static_cast<std::uint32_t>(points.size());
  for (const auto& p : points)
    cloud.data.append(reinterpret_cast<const char*>(p.data()), 12);
  return cloud;
}

inline std::string
odometryMessage(MadeEncoding encoding,
                std::int64_t stamp,
                const Eigen::Isometry3d& pose,
                const std::string& base = "base")
{
  MessageWriter out(encoding);
  out.header(stamp, "odom").text(base).pose(pose);
  for (int i = 0; i < 36 + 6 + 36; ++i)
    out.number(0.0);
  return out.bytes();
}

/** \brief A transform between two frames. */
struct MadeTransform {
  std::int64_t stamp = 0; ///< [ns]
  std::string parent, child;
  Eigen::Isometry3d T_parent_child = Eigen::Isometry3d::Identity();
};

inline std::string
transformMessage(MadeEncoding encoding, const std::vector<MadeTransform>& transforms)
{
  MessageWriter out(encoding);
  out.number(static_cast<std::uint32_t>(transforms.size()));
  for (const auto& one : transforms)
    out.header(one.stamp, one.parent).text(one.child).pose(one.T_parent_child);
  return out.bytes();
}

} // namespace pcl6d::test
