// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/sources/bag.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

/** \file Choice of the topics of a recording. */
namespace pcl6d::sources {

/** \return the indices of the topics with messages of a matching type */
std::vector<std::size_t>
topicsOfType(const Bag& bag, const std::function<bool(const std::string&)>& is_type);

/** \return "/points (sensor_msgs/PointCloud2, 62 messages), ..." */
std::string
listOfTopics(const Bag& bag, const std::vector<std::size_t>& topics);

/** \return the topic of the clouds: the given topic, else the only topic with points in space,
 * else the only topic with ranges in a plane
 * \throws IoFailed no topic, or several and no choice is given; each message lists the topics */
std::size_t
cloudTopicOf(const Bag& bag, const std::string& given);

/** \return the topic of the poses: the given topic, else the only topic of Odometry; empty: use
 * the transforms, or with "none" no poses
 * \throws IoFailed the given topic is missing, or of another type */
std::optional<std::size_t>
poseTopicOf(const Bag& bag, const std::string& given);

/** \return the topic of orientations beside positions; empty if not given
 * \param[in] pose_topic result of poseTopicOf()
 * \throws IoFailed the given topic is missing, or of another type, or the poses are not mere
 * positions */
std::optional<std::size_t>
inertialTopicOf(const Bag& bag,
                const std::string& given,
                const std::optional<std::size_t>& pose_topic);

} // namespace pcl6d::sources
