// SPDX-License-Identifier: BSD-3-Clause
#include "packing.h"

namespace pcl6d::slam6d {

namespace {
// One description for both ways: `Archive` is Packer or Unpacker, and what is packed const.

template <typename Archive>
struct Fields {
  Archive& archive;

  template <typename Value>
  void
  operator()(const char*, Value& value) const
  {
    all(value);
  }

  template <typename Value>
  void
  all(Value& value) const
  {
    archive.value(value);
  }
  template <typename Value>
  void
  all(std::optional<Value>& value) const // taken
  {
    bool has_value = false;
    archive.value(has_value);
    if (has_value)
      all(value.emplace());
    else
      value.reset();
  }
  template <typename Value>
  void
  all(const std::optional<Value>& value) const // given
  {
    archive.value(value.has_value());
    if (value)
      all(*value);
  }
  template <typename Value>
  void
  all(std::vector<Value>& values) const
  {
    std::size_t size = 0;
    archive.value(size);
    values.clear();
    for (std::size_t i = 0; i < size; ++i)
      all(values.emplace_back());
  }
  template <typename Value>
  void
  all(const std::vector<Value>& values) const
  {
    archive.value(values.size());
    for (const Value& value : values)
      all(value);
  }

  void
  all(ScanResult& scan) const
  {
    scanFields(scan);
  }
  void
  all(const ScanResult& scan) const
  {
    scanFields(scan);
  }
  void
  all(StageResult& stage) const
  {
    stageFields(stage);
  }
  void
  all(const StageResult& stage) const
  {
    stageFields(stage);
  }
  void
  all(ScanLink& link) const
  {
    linkFields(link);
  }
  void
  all(const ScanLink& link) const
  {
    linkFields(link);
  }
  void
  all(PoseLink& link) const
  {
    poseLinkFields(link);
  }
  void
  all(const PoseLink& link) const
  {
    poseLinkFields(link);
  }

  template <typename Scan>
  void
  scanFields(Scan& scan) const
  {
    visitScanFields(scan, *this);
    all(scan.matched_pose);
  }
  template <typename Stage>
  void
  stageFields(Stage& stage) const
  {
    visitStageFields(stage, *this);
    all(stage.history);
  }
  template <typename Link>
  void
  linkFields(Link& link) const
  {
    visitLinkFields(link, *this);
    all(link.T_from_to);
  }
  template <typename Link>
  void
  poseLinkFields(Link& link) const
  {
    all(link.from);
    all(link.to);
    all(link.T_from_to);
    all(link.information);
  }
  template <typename Result>
  void
  resultFields(Result& result) const
  {
    all(result.scans);
    all(result.matching_seconds);
    all(result.stages);
    all(result.links);
    all(result.graph.poses);
    all(result.graph.links);
    all(result.graph.ids);
    all(result.floating);
  }
};
} // namespace

std::string
packed(const ScanResult& scan)
{
  Packer packer;
  Fields<Packer>{packer}.all(scan);
  return std::move(packer.bytes);
}

std::string
packed(const Slam6DResult& result)
{
  Packer packer;
  Fields<Packer>{packer}.resultFields(result);
  return std::move(packer.bytes);
}

void
unpack(const std::string& bytes, ScanResult& scan)
{
  Unpacker unpacker(bytes);
  Fields<Unpacker>{unpacker}.all(scan);
  unpacker.finish();
}

void
unpack(const std::string& bytes, Slam6DResult& result)
{
  Unpacker unpacker(bytes);
  Fields<Unpacker>{unpacker}.resultFields(result);
  unpacker.finish();
}

} // namespace pcl6d::slam6d
