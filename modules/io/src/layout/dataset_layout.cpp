// SPDX-License-Identifier: BSD-3-Clause
#include "layout/dataset_rules.h"

#include <pcl6d/io/text.h>

#include <algorithm>
#include <deque>
#include <utility>

namespace pcl6d {

using namespace io;

namespace fs = std::filesystem;

namespace {
// From the folder of a data set to the folder of the scans: Oxford Spires has
// sequences/NAME/processed/vilens-slam/undist-clouds.
constexpr std::size_t kDeepest = 5;
// A search started below "/" by mistake ends after about a second.
constexpr std::size_t kMostFolders = 20000;
constexpr std::size_t kMostListed = 12; // candidates in a message

/** \return the absolute path, without a trailing slash */
fs::path
wholePath(const fs::path& path)
{
  std::error_code error;
  fs::path whole = fs::absolute(path, error).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

/** \return `folder` without the trailing part `inner`; empty if `folder` does not end with
 * `inner` */
fs::path
folderAround(fs::path folder, const fs::path& inner)
{
  const std::vector<fs::path> parts(inner.begin(), inner.end());
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    if (folder.filename() != *part)
      return {};
    folder = folder.parent_path();
  }
  return folder;
}

/** \return whether the first file with the extension has a scan name of the rule */
bool
holdsScansNamed(const fs::path& folder, const DatasetRule& rule)
{
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == rule.extension &&
        entry->path().filename().string().front() != '.')
      return isNamed(entry->path(), rule.names);
  return false;
}

/** \return a path of a rule, from the folder of the sequence on */
fs::path
pathOf(const fs::path& sequence, const char* of_rule)
{
  std::string text = of_rule;
  if (const std::size_t place = text.find('*'); place != std::string::npos)
    text.replace(place, 1, sequence.filename().string());
  return (sequence / text).lexically_normal();
}

/** \return the first existing path, or empty */
fs::path
firstThere(const fs::path& sequence, const std::vector<const char*>& paths)
{
  for (const char* const path : paths)
    if (path && text::isThere(pathOf(sequence, path)))
      return pathOf(sequence, path);
  return {};
}

DatasetLayout
layoutOf(const DatasetRule& rule, const fs::path& folder, const fs::path& sequence)
{
  DatasetLayout layout;
  layout.name = rule.name;
  layout.scans = folder;
  layout.sequence = sequence;
  layout.format = scanFormatOfExtension(std::string("x") + rule.extension);
  layout.bin_layout = rule.bin_layout;
  layout.frame = rule.frame;
  layout.stamps = firstThere(sequence, {rule.stamps});
  layout.names_are_stamps = rule.names != ScanNames::kNumber;
  layout.calibration = firstThere(sequence, {rule.calibration});
  layout.reference = firstThere(sequence, rule.references);
  layout.times = rule.times;
  layout.times_text = rule.times_text;
  return layout;
}

std::vector<fs::path>
foldersIn(const fs::path& folder)
{
  std::vector<fs::path> found;
  std::error_code error, broken;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().filename().string().front() != '.' && entry->is_directory(broken))
      found.push_back(entry->path());
  std::sort(found.begin(), found.end());
  return found;
}

/** \return the rank of the folder among the folders of the layout; the first is preferred */
std::size_t
rankOf(const DatasetLayout& layout)
{
  std::size_t rank = 0;
  for (const DatasetRule& rule : datasetRules())
    for (const char* const scans : rule.scans) {
      if (layout.name == rule.name &&
          wholePath(layout.sequence / scans) == wholePath(layout.scans))
        return rank;
      ++rank;
    }
  return rank;
}

/** Adds a layout, unless the sequence is already listed; then the layout of better rank is kept.
 */
void
addLayout(DatasetLayout layout, std::vector<DatasetLayout>& all)
{
  for (DatasetLayout& other : all)
    if (other.name == layout.name && other.sequence == layout.sequence) {
      if (rankOf(layout) < rankOf(other))
        other = std::move(layout);
      return;
    }
  all.push_back(std::move(layout));
}

std::string
listOf(const std::vector<DatasetLayout>& layouts, const fs::path& folder)
{
  std::string list;
  for (std::size_t i = 0; i < std::min(layouts.size(), kMostListed); ++i)
    list += (i > 0 ? ", " : "") + layouts[i].scans.lexically_relative(folder).string() +
            " (" + layouts[i].name + ")";
  if (layouts.size() > kMostListed)
    list += " and " + std::to_string(layouts.size() - kMostListed) + " more";
  return list;
}
} // namespace

std::optional<DatasetLayout>
layoutOfScans(const fs::path& folder)
{
  const fs::path whole = wholePath(folder);
  for (const DatasetRule& rule : datasetRules())
    for (const char* const scans : rule.scans) {
      const fs::path sequence = folderAround(whole, scans);
      if (sequence.empty() ||
          (rule.around && sequence.parent_path().filename() != rule.around) ||
          (!rule.evidence.empty() && firstThere(sequence, rule.evidence).empty()) ||
          !holdsScansNamed(folder, rule))
        continue;
      return layoutOf(rule, folder, sequence);
    }
  return std::nullopt;
}

std::optional<DatasetLayout>
findDataset(const fs::path& folder)
{
  std::vector<DatasetLayout> found;
  std::deque<std::pair<fs::path, std::size_t>> waiting = {{folder, 0}};
  for (std::size_t looked = 0; !waiting.empty() && looked < kMostFolders; ++looked) {
    const auto [path, depth] = std::move(waiting.front());
    waiting.pop_front();
    if (depth > 0) {
      if (auto layout = layoutOfScans(path)) {
        addLayout(*std::move(layout), found);
        continue;
      }
    }
    if (depth < kDeepest)
      for (fs::path& inner : foldersIn(path))
        waiting.emplace_back(std::move(inner), depth + 1);
  }
  if (found.size() > 1)
    text::fail(folder,
               "holds several sequences of scans: " + listOf(found, folder) +
                   "; give the folder of a single sequence");
  return found.empty() ? std::nullopt : std::optional(found.front());
}

std::string
describe(const DatasetLayout& layout)
{
  const auto named = [&](const fs::path& path) {
    return path.lexically_relative(layout.sequence).string();
  };
  std::string line = "data set " + layout.name;
  if (layout.bin_layout != BinLayout::kAuto)
    line += "; points " + toString(layout.bin_layout);
  line += "; " + layout.frame;
  if (!layout.stamps.empty())
    line += "; stamps of " + named(layout.stamps);
  else
    line += layout.names_are_stamps ? "; names are stamps" : "; no stamps";
  line += "; times of points: " + layout.times_text;
  if (!layout.calibration.empty())
    line += "; calibration " + named(layout.calibration);
  if (!layout.reference.empty())
    line += "; reference " + named(layout.reference) + ", not read";
  return line;
}

} // namespace pcl6d
