// SPDX-License-Identifier: BSD-3-Clause
// Definitions: std_msgs, geometry_msgs, nav_msgs and tf2_msgs of ROS 2.
#include "bag/files/mcap_writer.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/sources/trajectory_bag.h>

#include <cmath>
#include <initializer_list>

namespace pcl6d {

using namespace sources;

namespace {
/** The definition of a nested type. */
struct Definition {
  const char* name;
  const char* fields;
};
constexpr Definition kTime = {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"};
constexpr Definition kHeader = {"std_msgs/Header",
                                "builtin_interfaces/Time stamp\nstring frame_id\n"};
constexpr Definition kPoint = {"geometry_msgs/Point",
                               "float64 x\nfloat64 y\nfloat64 z\n"};
constexpr Definition kVector = {"geometry_msgs/Vector3",
                                "float64 x\nfloat64 y\nfloat64 z\n"};
constexpr Definition kQuaternion = {
    "geometry_msgs/Quaternion",
    "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"};
constexpr Definition kPose = {"geometry_msgs/Pose",
                              "Point position\nQuaternion orientation\n"};
constexpr Definition kPoseWithCovariance = {"geometry_msgs/PoseWithCovariance",
                                            "Pose pose\nfloat64[36] covariance\n"};
constexpr Definition kTwist = {"geometry_msgs/Twist",
                               "Vector3 linear\nVector3 angular\n"};
constexpr Definition kTwistWithCovariance = {"geometry_msgs/TwistWithCovariance",
                                             "Twist twist\nfloat64[36] covariance\n"};
constexpr Definition kTransform = {"geometry_msgs/Transform",
                                   "Vector3 translation\nQuaternion rotation\n"};
constexpr Definition kTransformStamped = {
    "geometry_msgs/TransformStamped",
    "std_msgs/Header header\nstring child_frame_id\nTransform transform\n"};

constexpr const char* kOdometryFields =
    "std_msgs/Header header\nstring child_frame_id\n"
    "geometry_msgs/PoseWithCovariance pose\ngeometry_msgs/TwistWithCovariance twist\n";
constexpr const char* kTransformsFields =
    "geometry_msgs/TransformStamped[] transforms\n";

/** \return the fields of a type, followed by nested types after lines of equals signs, in
 * rosbag2's format */
std::string
definitionOf(const std::string& fields, std::initializer_list<Definition> used)
{
  std::string text = fields;
  for (const Definition& one : used)
    text += std::string(80, '=') + "\nMSG: " + one.name + "\n" + one.fields;
  return text;
}

void
writeValues(CdrWriter& out, const Eigen::Isometry3d& pose)
{
  for (int i = 0; i < 3; ++i)
    out.number(pose.translation()[i]);
  const Eigen::Quaterniond rotation(pose.linear());
  for (int i = 0; i < 4; ++i)
    out.number(rotation.coeffs()[i]); // x y z w
}

std::string
odometryOf(const TrajectoryBag& bag, std::size_t place, std::int64_t stamp)
{
  constexpr int kTwistValues = 6 + 36;
  CdrWriter out;
  out.header(stamp, bag.map_frame).text(bag.sensor_frame);
  writeValues(out, bag.trajectory.poses[place]);
  const bool is_known = !bag.covariances.empty() && bag.covariances[place];
  for (int i = 0; i < 36; ++i)
    out.number(is_known ? (*bag.covariances[place])(i / 6, i % 6) : 0.0);
  for (int i = 0; i < kTwistValues; ++i)
    out.number(0.0);
  return out.bytes();
}

std::string
transformOf(const TrajectoryBag& bag, std::size_t place, std::int64_t stamp)
{
  CdrWriter out;
  out.number(std::uint32_t{1}).header(stamp, bag.map_frame).text(bag.sensor_frame);
  writeValues(out, bag.trajectory.poses[place]);
  return out.bytes();
}

void
checkBag(const TrajectoryBag& bag)
{
  constexpr double kEnd = 2147483648.0; // [s] of the 32 bits of a stamp
  const std::size_t count = bag.trajectory.poses.size();
  if (count == 0)
    throw BadArgument("the trajectory has no poses");
  require(bag.trajectory.stamps.size() == count,
          "number of stamps",
          bag.trajectory.stamps.size(),
          "one for each of the " + std::to_string(count) + " poses");
  require(bag.covariances.empty() || bag.covariances.size() == count,
          "number of covariances",
          bag.covariances.size(),
          "one for each of the " + std::to_string(count) + " poses, or 0");
  for (const double stamp : bag.trajectory.stamps)
    require(stamp >= 0 && stamp < kEnd,
            "stamp",
            stamp,
            "in [0, 2147483648) s, the range of a ROS 2 message");
}
} // namespace

void
writeTrajectoryBag(const std::filesystem::path& path, const TrajectoryBag& bag)
{
  checkBag(bag);
  writeFileAtomically(path, [&](std::ostream& stream) {
    McapWriter writer(stream);
    const std::uint16_t odometry = writer.addTopic("/odom",
                                                   "nav_msgs/msg/Odometry",
                                                   definitionOf(kOdometryFields,
                                                                {kHeader,
                                                                 kTime,
                                                                 kPoseWithCovariance,
                                                                 kPose,
                                                                 kPoint,
                                                                 kQuaternion,
                                                                 kTwistWithCovariance,
                                                                 kTwist,
                                                                 kVector}));
    const std::uint16_t transforms = writer.addTopic(
        "/tf",
        "tf2_msgs/msg/TFMessage",
        definitionOf(
            kTransformsFields,
            {kTransformStamped, kHeader, kTime, kTransform, kVector, kQuaternion}));
    for (std::size_t i = 0; i < bag.trajectory.poses.size(); ++i) {
      const double seconds = std::floor(bag.trajectory.stamps[i]);
      const auto stamp = static_cast<std::int64_t>(seconds) * 1000000000 +
                         std::llround((bag.trajectory.stamps[i] - seconds) * 1e9);
      const auto time = static_cast<std::uint64_t>(stamp);
      writer.addMessage(odometry, time, odometryOf(bag, i, stamp));
      writer.addMessage(transforms, time, transformOf(bag, i, stamp));
    }
    writer.finish();
  });
}

} // namespace pcl6d
