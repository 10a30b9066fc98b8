// SPDX-License-Identifier: BSD-3-Clause
#include "bag/bag_drive.h"
#include "bag/bag_topics.h"
#include "bag/messages/gnss_track.h"

#include <pcl6d/common/error.h>

#include <algorithm>

namespace pcl6d::sources {

namespace {
/** \brief A recorded pose, before the choice of the time. */
struct RecordedPose {
  FramePose pose;
  std::int64_t recorded = 0; ///< [ns]
  bool is_transform = false, is_static = false;
};

/** \brief Reads a drive in steps. */
class DriveReading {
public:
  DriveReading(const Bag& bag, const BagOptions& options)
  : bag_(bag), options_(options), tree_(bag.path())
  {
    drive_.topic = cloudTopicOf(bag, options.topic);
    pose_topic_ = poseTopicOf(bag, options.odometry);
    imu_topic_ = inertialTopicOf(bag, options.imu, pose_topic_);
    if (!bag.damage().empty())
      drive_.notes.push_back(bag.damage());
  }

  BagDrive
  finish()
  {
    readMessages();
    decideTimes();
    sortPoses();
    placeClouds();
    return std::move(drive_);
  }

private:
  void
  readMessages()
  {
    std::size_t damaged = 0;
    std::string reason;
    for (const BagMessage& message : bag_.messages()) {
      const std::string& type = bag_.topics()[message.topic].type;
      if (message.topic != drive_.topic && message.topic != pose_topic_ &&
          message.topic != imu_topic_ &&
          (options_.odometry == "none" || !isTransformType(type)))
        continue;
      try {
        readMessage(message);
      } catch (const IoFailed& e) {
        reason = damaged++ == 0 ? e.what() : reason;
      }
    }
    if (drive_.clouds.empty())
      text::fail(bag_.path(),
                 topicTitle(bag_.topics()[drive_.topic]) + " has no cloud with points" +
                     (damaged > 0 ? " (" + reason + ")" : "") +
                     "; choose another topic by --topic");
    if (num_empty_ > 0)
      drive_.notes.push_back(text::counted(num_empty_, "cloud") +
                             " without points left out");
    if (damaged > 0)
      drive_.notes.push_back(text::counted(damaged, "damaged message") +
                             " left out: " + reason);
  }

  /** Reads the header of a cloud, or all poses of a message. */
  void
  readMessage(const BagMessage& message)
  {
    const BagTopic& topic = bag_.topics()[message.topic];
    const auto bytes = bag_.read(message);
    const std::string what = topicTitle(topic);
    MessageReader reader(
        bag_.path(), what, topic.encoding, {bytes.data(), bytes.size()});
    if (isFixType(topic.type)) {
      gnss_.add(readFix(reader), message.time);
      return;
    }
    if (isInertialType(topic.type)) {
      gnss_.add(readOrientation(reader), message.time);
      return;
    }
    if (message.topic != drive_.topic) {
      for (const FramePose& pose : readPoseMessage(topic.type, reader))
        poses_.push_back({pose,
                          message.time,
                          isTransformType(topic.type),
                          isStaticTopic(topic.name)});
      return;
    }
    CloudHead head = readCloudHead(topic.type, reader);
    if (head.num_points > 0)
      drive_.clouds.push_back({message, std::move(head), 0, {}});
    else
      ++num_empty_;
  }

  static bool
  isStaticTopic(const std::string& name)
  {
    const std::string end = "tf_static";
    return name.size() >= end.size() &&
           name.compare(name.size() - end.size(), end.size(), end) == 0;
  }

  /** \return why the times of the headers are unusable; empty if increasing */
  std::string
  faultOfHeaderTimes() const
  {
    const auto& clouds = drive_.clouds;
    for (std::size_t i = 0; i < clouds.size(); ++i) {
      if (clouds[i].head.header.stamp <= 0)
        return "cloud " + std::to_string(i) + " has the stamp 0";
      if (i > 0 && clouds[i].head.header.stamp <= clouds[i - 1].head.header.stamp)
        return "the stamp of cloud " + std::to_string(i) +
               " is not after the previous stamp";
    }
    return "";
  }

  void
  decideTimes()
  {
    const std::string fault = faultOfHeaderTimes();
    if (options_.time == BagTime::kHeader && !fault.empty())
      text::fail(bag_.path(),
                 topicTitle(bag_.topics()[drive_.topic]) + ": " + fault +
                     "; --time record takes the times of recording");
    uses_record_ = options_.time == BagTime::kRecord ||
                   (options_.time == BagTime::kAuto && !fault.empty());
    if (options_.time == BagTime::kAuto && uses_record_)
      drive_.notes.push_back("times of recording are used: " + fault);
    drive_.has_stamps = true;
    for (std::size_t i = 0; i < drive_.clouds.size(); ++i) {
      BagCloud& cloud = drive_.clouds[i];
      cloud.time = uses_record_ ? cloud.message.time : cloud.head.header.stamp;
      if (i > 0 && cloud.time <= drive_.clouds[i - 1].time)
        drive_.has_stamps = false;
    }
    if (!drive_.has_stamps)
      drive_.notes.push_back(
          "times of recording do not increase: scans have no stamps");
  }

  void
  sortPoses()
  {
    for (const RecordedPose& recorded : poses_) {
      const std::int64_t time = uses_record_ ? recorded.recorded : recorded.pose.stamp;
      if (recorded.is_transform)
        tree_.add(recorded.pose, time, recorded.is_static);
      else {
        odometry_.add(time, recorded.pose.T_parent_child);
        base_ = recorded.pose.child;
      }
    }
    poses_.clear();
    odometry_.finish();
    tree_.finish();
    if (hasFixes()) {
      odometry_ = gnss_.poses(uses_record_,
                              tree_,
                              bag_.path(),
                              topicTitle(bag_.topics()[*pose_topic_]),
                              imu_topic_ ? topicTitle(bag_.topics()[*imu_topic_]) : "",
                              drive_.notes);
      base_ = gnss_.frame();
    }
  }

  void
  placeClouds()
  {
    if (options_.odometry == "none")
      return;
    if (pose_topic_)
      placeByOdometry();
    else
      placeByTransforms();
    if (!drive_.pose_source.empty())
      leaveOutUnplaced();
  }

  void
  placeByOdometry()
  {
    const BagTopic& topic = bag_.topics()[*pose_topic_];
    drive_.pose_source = topic.name + " (" + topic.type + ")";
    if (hasFixes())
      drive_.pose_source += (imu_topic_ ? " and " + bag_.topics()[*imu_topic_].name
                                        : std::string(", heading of the motion")) +
                            ", east-north-up about " + gnss_.originText();
    bool is_linked = true;
    for (BagCloud& cloud : drive_.clouds) {
      const std::string& sensor = cloud.head.header.frame;
      cloud.pose = odometry_.at(cloud.time);
      if (!cloud.pose || base_.empty() || sensor.empty() || base_ == sensor)
        continue;
      const auto T_base_sensor = tree_.poseIn(sensor, base_, cloud.time);
      is_linked = is_linked && T_base_sensor;
      if (T_base_sensor)
        cloud.pose = *cloud.pose * *T_base_sensor;
    }
    if (!is_linked)
      drive_.notes.push_back("no transform from " +
                             text::quoted(drive_.clouds.front().head.header.frame) +
                             " to " + text::quoted(base_) +
                             " (tf): poses of the latter are taken for the sensor's");
  }

  /** \return whether poses come from positions of satellites */
  bool
  hasFixes() const
  {
    return pose_topic_ && isFixType(bag_.topics()[*pose_topic_].type);
  }

  void
  placeByTransforms()
  {
    auto chain = tree_.chainFrom(drive_.clouds.front().head.header.frame);
    const auto odom = std::find_if(chain.begin(), chain.end(), [](const auto& frame) {
      return frame.substr(frame.find_last_of('/') + 1) == "odom";
    });
    if (odom != chain.end() && odom != chain.begin())
      chain.erase(odom + 1, chain.end());
    if (!tree_.movesAlong(chain)) {
      if (options_.odometry == "tf")
        text::fail(
            bag_.path(),
            "tf: no chain of transforms leads from " + text::quoted(chain.front()) +
                " to a moving frame (the chain ends at " + text::quoted(chain.back()) +
                "); --odometry TOPIC takes a topic");
      noteUnusedOdometry();
      return;
    }
    for (auto frame = chain.rbegin(); frame != chain.rend(); ++frame)
      drive_.pose_source += (drive_.pose_source.empty() ? "tf " : " -> ") + *frame;
    for (BagCloud& cloud : drive_.clouds)
      cloud.pose = tree_.poseAlong(chain, cloud.time);
  }

  void
  noteUnusedOdometry()
  {
    const auto poses = topicsOfType(bag_, [](const std::string& type) {
      return isPoseType(type) || isFixType(type);
    });
    if (!poses.empty())
      drive_.notes.push_back("no poses are used; choose poses by --odometry from " +
                             listOfTopics(bag_, poses));
  }

  void
  leaveOutUnplaced()
  {
    auto& clouds = drive_.clouds;
    const std::size_t before = clouds.size();
    const auto has_none = [](const BagCloud& cloud) { return !cloud.pose; };
    clouds.erase(std::remove_if(clouds.begin(), clouds.end(), has_none), clouds.end());
    if (clouds.empty())
      text::fail(bag_.path(),
                 drive_.pose_source +
                     " has no pose at the time of any cloud; --time record compares "
                     "the times of recording, --odometry none uses no poses");
    if (clouds.size() < before)
      drive_.notes.push_back(
          text::counted(before - clouds.size(), "cloud") + " left out, as " +
          drive_.pose_source +
          " has no pose at the time of the cloud; --odometry none reads every cloud");
  }

  const Bag& bag_;
  const BagOptions& options_;
  BagDrive drive_;
  std::optional<std::size_t> pose_topic_, imu_topic_;
  GnssTrack gnss_;
  std::vector<RecordedPose> poses_;
  std::size_t num_empty_ = 0; ///< clouds without points
  bool uses_record_ = false;  ///< times of recording count
  PoseSeries odometry_;       ///< of base_ in the parent frame
  std::string base_;
  FrameTree tree_;
};
} // namespace

BagDrive
readBagDrive(const Bag& bag, const BagOptions& options)
{
  return DriveReading(bag, options).finish();
}

std::string
topicTitle(const BagTopic& topic)
{
  return "topic " + topic.name;
}

} // namespace pcl6d::sources
