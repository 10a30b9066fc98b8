// SPDX-License-Identifier: BSD-3-Clause
#include "live_view/live_view_channel.h"

#include <cerrno>
#include <sys/socket.h>

namespace pcl6d::visualization {

namespace {
/** The fixed part of a message; points and text follow. */
struct Header {
  LiveMessage::Kind kind;
  std::uint32_t scan;
  std::uint64_t num_points;
  std::uint64_t text_size;
  double T_world_scan[16];
};

bool
sendAll(int socket, const void* data, std::size_t size)
{
  const char* next = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = ::send(socket, next, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR)
      continue;
    if (sent <= 0)
      return false;
    next += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool
receiveAll(int socket, void* data, std::size_t size)
{
  char* next = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t received = ::recv(socket, next, size, 0);
    if (received < 0 && errno == EINTR)
      continue;
    if (received <= 0)
      return false;
    next += received;
    size -= static_cast<std::size_t>(received);
  }
  return true;
}
} // namespace

bool
sendMessage(int socket, const LiveMessage& message)
{
  Header header{};
  header.kind = message.kind;
  header.scan = message.scan;
  header.num_points = message.points.size();
  header.text_size = message.text.size();
  Eigen::Map<Eigen::Matrix4d>(header.T_world_scan) = message.T_world_scan;
  return sendAll(socket, &header, sizeof(header)) &&
         sendAll(socket,
                 message.points.data(),
                 message.points.size() * sizeof(Points::value_type)) &&
         sendAll(socket, message.text.data(), message.text.size());
}

std::optional<LiveMessage>
receiveMessage(int socket)
{
  Header header{};
  if (!receiveAll(socket, &header, sizeof(header)))
    return std::nullopt;
  LiveMessage message;
  message.kind = header.kind;
  message.scan = header.scan;
  message.T_world_scan = Eigen::Map<Eigen::Matrix4d>(header.T_world_scan);
  message.points.resize(header.num_points);
  message.text.resize(header.text_size);
  if (!receiveAll(socket,
                  message.points.data(),
                  message.points.size() * sizeof(Points::value_type)) ||
      !receiveAll(socket, message.text.data(), message.text.size()))
    return std::nullopt;
  return message;
}

} // namespace pcl6d::visualization
