// SPDX-License-Identifier: BSD-3-Clause
#include "packing.h"

#include <pcl6d/common/error.h>
#include <pcl6d/slam6d/run_journal.h>

#include <algorithm>
#include <utility>

namespace pcl6d {
using slam6d::packed;
using slam6d::unpack;

namespace {
/** The content of a record. */
enum class RecordKind : std::uint8_t { kConditions, kMatched, kRelaxed };

std::string
recordOf(const RunJournal::Conditions& conditions)
{
  Packer packer;
  packer.value(RecordKind::kConditions);
  packer.value(conditions.size());
  for (const auto& [name, value] : conditions) {
    packer.value(name);
    packer.value(value);
  }
  return std::move(packer.bytes);
}

RunJournal::Conditions
conditionsOf(const std::string& record)
{
  Unpacker unpacker(record);
  RecordKind kind{};
  std::size_t size = 0;
  unpacker.value(kind);
  if (kind != RecordKind::kConditions)
    throw IoFailed("the journal does not begin with the conditions of the run");
  unpacker.value(size);
  RunJournal::Conditions conditions;
  for (std::size_t i = 0; i < size; ++i) {
    auto& [name, value] = conditions.emplace_back();
    unpacker.value(name);
    unpacker.value(value);
  }
  return conditions;
}

/** \return the first different condition, in words; empty if equal */
std::string
differenceOf(const RunJournal::Conditions& before, const RunJournal::Conditions& now)
{
  for (std::size_t i = 0; i < std::max(before.size(), now.size()); ++i) {
    if (i >= before.size() || i >= now.size() || before[i].first != now[i].first)
      return "is of another version of the program";
    if (before[i].second != now[i].second)
      return now[i].first + " was " + before[i].second + ", and is " + now[i].second +
             " now";
  }
  return "";
}
} // namespace

RunJournal::RunJournal(const std::filesystem::path& path,
                       const Conditions& conditions,
                       std::vector<std::string> names)
: path_(path), conditions_(conditions), names_(std::move(names))
{
  if (std::filesystem::exists(path))
    open();
}

void
RunJournal::open()
{
  file_.emplace(path_);
  try {
    const auto& records = file_->records();
    if (records.empty())
      return file_->append(recordOf(conditions_));
    if (const auto difference =
            differenceOf(conditionsOf(records.front()), conditions_);
        !difference.empty())
      throw IoFailed(path_.string() + ": an interrupted run is kept here, but " +
                     difference);
    for (std::size_t i = 1; i < records.size(); ++i)
      take(records[i]);
  } catch (...) {
    file_.reset();
    throw;
  }
}

void
RunJournal::keep(const std::string& record)
{
  if (!file_)
    open();
  file_->append(record);
}

void
RunJournal::take(const std::string& record)
{
  Unpacker unpacker(record);
  RecordKind kind{};
  std::uint64_t inputs = 0;
  std::size_t scan = 0;
  std::string bytes;
  unpacker.value(kind);
  unpacker.value(inputs);
  unpacker.value(scan);
  unpacker.value(bytes);
  if (kind == RecordKind::kRelaxed) {
    relaxed_[inputs] = std::move(bytes);
    return;
  }
  ScanResult result;
  unpack(bytes, result);
  matched_[scan] = {inputs, std::move(result)};
}

std::optional<ScanResult>
RunJournal::matched(std::size_t scan, std::uint64_t inputs)
{
  const auto known = matched_.find(scan);
  if (known == matched_.end())
    return std::nullopt;
  if (known->second.first != inputs)
    throw IoFailed(
        (scan < names_.size() ? names_[scan] : "scan " + std::to_string(scan)) +
        ": has changed since the interrupted run that " + path_.string() +
        " keeps (points, initial pose, derived parameters, or a scan before); start "
        "afresh");
  return known->second.second;
}

void
RunJournal::keepMatched(std::size_t scan,
                        std::uint64_t inputs,
                        const ScanResult& result)
{
  Packer packer;
  packer.value(RecordKind::kMatched);
  packer.value(inputs);
  packer.value(scan);
  packer.value(packed(result));
  keep(packer.bytes);
}

std::optional<Slam6DResult>
RunJournal::relaxed(std::uint64_t inputs)
{
  const auto known = relaxed_.find(inputs);
  if (known == relaxed_.end())
    return std::nullopt;
  Slam6DResult result;
  unpack(known->second, result);
  return result;
}

void
RunJournal::keepRelaxed(std::uint64_t inputs, const Slam6DResult& result)
{
  Packer packer;
  packer.value(RecordKind::kRelaxed);
  packer.value(inputs);
  packer.value(std::size_t{0});
  packer.value(packed(result));
  keep(packer.bytes);
}

} // namespace pcl6d
