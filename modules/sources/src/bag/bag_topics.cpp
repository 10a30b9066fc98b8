// SPDX-License-Identifier: BSD-3-Clause
#include "bag/bag_topics.h"
#include "bag/messages/cloud_messages.h"
#include "bag/messages/gnss_messages.h"
#include "bag/messages/pose_messages.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <numeric>

namespace pcl6d::sources {

namespace {
std::string
listOfAllTopics(const Bag& bag)
{
  std::vector<std::size_t> all(bag.topics().size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all.empty() ? "it has no topics" : "its topics are " + listOfTopics(bag, all);
}

/** \return the topic with the name and one of the types
 * \param[in] holds the required content, for the message \throws IoFailed no such topic */
std::size_t
givenTopic(const Bag& bag,
           const std::string& name,
           const std::vector<std::size_t>& of_type,
           const std::string& option,
           const std::string& holds)
{
  for (const std::size_t i : of_type)
    if (bag.topics()[i].name == name)
      return i;
  const auto other =
      std::find_if(bag.topics().begin(),
                   bag.topics().end(),
                   [&](const BagTopic& topic) { return topic.name == name; });
  text::fail(
      bag.path(),
      option + " " + name +
          (other == bag.topics().end() ? ": the recording has no topic of this name"
           : other->num_messages == 0
               ? ": the topic has no messages"
               : ": the topic holds " + other->type + ", but must hold " + holds) +
          "; " +
          (of_type.empty() ? listOfAllTopics(bag)
                           : "choose one of " + listOfTopics(bag, of_type)));
}
} // namespace

std::vector<std::size_t>
topicsOfType(const Bag& bag, const std::function<bool(const std::string&)>& is_type)
{
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < bag.topics().size(); ++i)
    if (bag.topics()[i].num_messages > 0 && is_type(bag.topics()[i].type))
      found.push_back(i);
  return found;
}

std::string
listOfTopics(const Bag& bag, const std::vector<std::size_t>& topics)
{
  constexpr std::size_t kMost = 12; // one line
  std::string list;
  for (std::size_t i = 0; i < std::min(topics.size(), kMost); ++i) {
    const BagTopic& topic = bag.topics()[topics[i]];
    list += (i == 0 ? "" : ", ") + topic.name + " (" + topic.type + ", " +
            text::counted(topic.num_messages, "message") + ")";
  }
  return list + (topics.size() > kMost ? " and others" : "");
}

std::size_t
cloudTopicOf(const Bag& bag, const std::string& given)
{
  const auto clouds = topicsOfType(bag, isCloudType);
  const auto planar = topicsOfType(bag, isPlanarType);
  if (!given.empty()) {
    auto both = clouds;
    both.insert(both.end(), planar.begin(), planar.end());
    return givenTopic(
        bag, given, both, "--topic", "PointCloud2, CustomMsg of Livox or LaserScan");
  }
  const auto& taken = clouds.empty() ? planar : clouds;
  if (taken.empty())
    text::fail(
        bag.path(),
        "no topic holds clouds (PointCloud2, CustomMsg of Livox or LaserScan); " +
            listOfAllTopics(bag));
  if (taken.size() > 1)
    text::fail(bag.path(),
               "several topics hold clouds; choose one by --topic: " +
                   listOfTopics(bag, taken));
  return taken.front();
}

std::optional<std::size_t>
poseTopicOf(const Bag& bag, const std::string& given)
{
  if (given == "none" || given == "tf")
    return {};
  if (!given.empty())
    return givenTopic(bag,
                      given,
                      topicsOfType(bag,
                                   [](const std::string& type) {
                                     return isPoseType(type) || isFixType(type);
                                   }),
                      "--odometry",
                      "Odometry, PoseStamped or NavSatFix");
  const auto odometry = topicsOfType(bag, isOdometryType);
  return odometry.size() == 1 ? std::optional(odometry.front()) : std::nullopt;
}

std::optional<std::size_t>
inertialTopicOf(const Bag& bag,
                const std::string& given,
                const std::optional<std::size_t>& pose_topic)
{
  if (given.empty())
    return {};
  const std::size_t topic =
      givenTopic(bag, given, topicsOfType(bag, isInertialType), "--imu", "Imu");
  if (!pose_topic || !isFixType(bag.topics()[*pose_topic].type))
    text::fail(bag.path(),
               "--imu " + given +
                   " gives orientations beside positions: name a topic of NavSatFix by "
                   "--odometry");
  return topic;
}

} // namespace pcl6d::sources

bool
pcl6d::holdsClouds(const BagTopic& topic)
{
  return sources::isCloudType(topic.type) || sources::isPlanarType(topic.type);
}
