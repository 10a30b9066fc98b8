// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/suite/damaged_folder.h"
#include "evaluate/suite/run_record.h"
#include "evaluate/suite/suite_data.h"

#include <pcl6d/common/error.h>

#include <chrono>
#include <thread>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/** \return how the simulator ended; empty if interrupted */
std::optional<ProcessEnd>
simulate(const SuiteData& data,
         const fs::path& folder,
         const fs::path& log,
         double time_limit,
         const Interrupt& interrupt)
{
  ProcessStart start{programBeside("pcl_slam6d_simulate"),
                     {data.scene, "-o", folder.string(), "--quiet"},
                     log,
                     time_limit};
  for (const auto& word : wordsOf(data.simulation))
    start.arguments.push_back(word);
  ChildProcess program(start);
  std::optional<ProcessEnd> end;
  while (!(end = program.poll())) {
    if (interrupt.requested())
      program.stop();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return interrupt.requested() ? std::nullopt : end;
}

Json
inputsOf(const SuiteData& data, const Json& programs)
{
  if (data.scene.empty())
    return {{"folder", data.folder}, {"files", hashOfFiles(data.folder)}};
  Json inputs = {{"programs", programs}, {"scene", data.scene}};
  inputs["options"] = data.simulation;
  if (fs::exists(data.scene)) // a description or a mesh
    inputs["files"] = hashOfFiles(data.scene);
  return inputs;
}
} // namespace

void
makeAnew(const fs::path& folder)
{
  std::error_code error;
  fs::remove_all(folder, error);
  if (!error)
    fs::create_directories(folder, error);
  if (error)
    throw IoFailed(folder.string() + ": cannot write: " + error.message());
}

std::optional<PreparedData>
prepareData(const SuiteData& data,
            const fs::path& folder,
            const Json& programs,
            double time_limit,
            const Interrupt& interrupt,
            ProgressBar& bar)
{
  PreparedData prepared{folder, inputsOf(data, programs), ""};
  if (data.scene.empty()) {
    prepared.scans = data.folder;
    return prepared;
  }
  const fs::path file = folder.string() + ".json", log = folder.string() + ".log";
  const auto before = readRunRecord(file);
  if (before && before->hasResult() && before->countsFor(prepared.inputs, time_limit) &&
      fs::exists(folder / "groundtruth.txt"))
    return prepared;
  fs::remove(file);
  makeAnew(folder);
  bar.show({"simulating " + data.name, 0, 1});
  const auto end = simulate(data, folder, log, time_limit, interrupt);
  if (!end)
    return std::nullopt;
  RunRecord record{prepared.inputs, *end, time_limit, ""};
  if (record.hasResult()) {
    writeRunRecord(file, record);
  }
  else { // the next call tries again
    const std::string error = errorIn(log);
    prepared.fault = "no scans: pcl_slam6d_simulate " + record.verdict() +
                     (error.empty() ? "" : ": ") + error;
    bar.warn(data.name + ": " + prepared.fault);
  }
  bar.show({"simulating " + data.name, 1, 1});
  return prepared;
}

PreparedData
prepareDamaged(const SuiteData& data,
               const PreparedData& source,
               const PreparedData* foreign,
               const fs::path& truth,
               const fs::path& folder)
{
  if (!data.damage.changesFiles() || !source.fault.empty())
    return source;
  if (foreign != nullptr && !foreign->fault.empty())
    return {source.scans, source.inputs, data.foreign + ": " + foreign->fault};
  PreparedData prepared{folder, {{"source", source.inputs}}, ""};
  prepared.inputs["damage"] = data.damage.text;
  if (foreign != nullptr)
    prepared.inputs["foreign"] = foreign->inputs;
  if (!truth.empty() && data.scene.empty())
    prepared.inputs["truth"] = hashOfFiles(truth);
  const fs::path file = folder.string() + ".json";
  const auto before = readRunRecord(file);
  if (before && before->countsFor(prepared.inputs, 0) && fs::exists(folder))
    return prepared;
  fs::remove(file);
  makeAnew(folder);
  try {
    makeDamagedFolder(data.damage,
                      {source.scans, truth, foreign ? foreign->scans : fs::path()},
                      folder);
  } catch (const pcl::PCLException& error) { // becomes a row of the table
    prepared.fault = std::string("cannot be damaged so: ") + error.what();
    return prepared;
  }
  if (!data.damage.links.empty())
    writeLinks(linksOf(folder), data.damage);
  writeRunRecord(file, {prepared.inputs, {}, 0, ""});
  return prepared;
}

fs::path
linksOf(const fs::path& folder)
{
  return folder.string() + ".links";
}

} // namespace pcl6d::app
