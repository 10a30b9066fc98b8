// SPDX-License-Identifier: BSD-3-Clause
#include "packing.h"

#include <pcl6d/run/run_fields.h>

namespace pcl6d {

// In the namespace of the records, for argument-dependent lookup. Each function both packs and
// unpacks.

template <typename Archive>
void
packFields(Archive& archive, ScanResult& scan)
{
  visitScanFields(scan, [&](const char*, auto& field) { archive(field); });
  archive(scan.matched_pose);
}

template <typename Archive>
void
packFields(Archive& archive, StageResult& stage)
{
  visitStageFields(stage, [&](const char*, auto& field) { archive(field); });
  archive(stage.history);
}

template <typename Archive>
void
packFields(Archive& archive, PoseLink& link)
{
  archive(link.from, link.to, link.T_from_to, link.information);
}

template <typename Archive>
void
packFields(Archive& archive, Slam6DResult& result)
{
  archive(result.scans,
          result.matching_seconds,
          result.stages,
          result.links,
          result.graph.poses,
          result.graph.links,
          result.graph.ids,
          result.floating);
}
} // namespace pcl6d

namespace pcl6d::slam6d {

std::string
packed(const ScanResult& scan)
{
  Packer packer;
  packer(scan);
  return std::move(packer.bytes);
}

std::string
packed(const Slam6DResult& result)
{
  Packer packer;
  packer(result);
  return std::move(packer.bytes);
}

void
unpack(const std::string& bytes, ScanResult& scan)
{
  Unpacker unpacker(bytes);
  unpacker(scan);
  unpacker.finish();
}

void
unpack(const std::string& bytes, Slam6DResult& result)
{
  Unpacker unpacker(bytes);
  unpacker(result);
  unpacker.finish();
}

} // namespace pcl6d::slam6d
