// SPDX-License-Identifier: BSD-3-Clause
#include "common/process/child_process.h"
#include "render/survey.h"

#include <pcl6d/common/error.h>
#include <pcl6d/visualization/survey_report.h>

#include <chrono>
#include <cstdlib>
#include <sstream>
#include <thread>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

/** [s] Far more than a page of 1000 stations takes. */
constexpr double kPrintTime = 180;

/** \return the value of an option of the run; empty: not given */
std::string
valueOf(const RunResult& run, const std::string& name)
{
  for (const auto& option : run.options)
    if (option.name == name && option.source == "given")
      return option.value;
  return {};
}

/** \return the browser; empty: not found */
fs::path
findChromium()
{
  const char* const path = std::getenv("PATH");
  for (const char* const name : {"chromium", "chromium-browser", "google-chrome"}) {
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
      std::error_code error;
      if (const fs::path file = fs::path(folder) / name;
          fs::is_regular_file(file, error))
        return file;
    }
  }
  return {};
}

/** A temporary folder for the browser, removed at destruction. */
class BrowserFolder {
public:
  BrowserFolder()
  {
    std::string name = (fs::temp_directory_path() / "pcl6d-print-XXXXXX").string();
    if (!::mkdtemp(name.data()))
      throw IoFailed(name + ": cannot be made");
    path_ = name;
  }
  ~BrowserFolder()
  {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  BrowserFolder(const BrowserFolder&) = delete;
  BrowserFolder&
  operator=(const BrowserFolder&) = delete;

  const fs::path&
  path() const
  {
    return path_;
  }

private:
  fs::path path_;
};

void
printPdf(const fs::path& page, const fs::path& pdf)
{
  const fs::path browser = findChromium();
  if (browser.empty())
    throw IoFailed(
        "--pdf: Chromium is missing (apt-get install chromium); any browser prints " +
        page.string());
  const BrowserFolder folder;
  const fs::path made = folder.path() / "page.pdf";
  ProcessStart start;
  start.program = browser;
  start.arguments = {"--headless=new",
                     // root cannot use the sandbox; the page has no scripts
                     "--no-sandbox",
                     "--no-first-run",
                     "--disable-gpu",
                     "--disable-extensions",
                     "--disable-background-networking",
                     "--disable-dev-shm-usage",
                     "--user-data-dir=" + (folder.path() / "profile").string(),
                     "--no-pdf-header-footer",
                     "--print-to-pdf=" + made.string(),
                     "file://" + fs::absolute(page).string()};
  start.log = "/dev/null";
  start.time_limit = kPrintTime;
  ChildProcess child(start);
  while (!child.poll())
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  std::error_code error;
  if (fs::file_size(made, error) == 0 || error)
    throw IoFailed(pdf.string() + ": " + browser.string() + " did not print it");
  fs::copy_file(made, pdf, fs::copy_options::overwrite_existing, error);
  if (error)
    throw IoFailed(pdf.string() + ": " + error.message());
}
} // namespace

std::vector<fs::path>
writeSurvey(const std::string& run,
            const fs::path& output,
            const SurveySettings& settings)
{
  const RunFolder folder(run);
  std::vector<std::string> project = settings.project;
  if (project.empty())
    project = {valueOf(folder.summary(), "project")};
  const SurveyReport report =
      surveyOf(folder,
               surveyOptionsFrom(project,
                                 settings.tolerance.empty()
                                     ? valueOf(folder.summary(), "tolerance")
                                     : settings.tolerance));
  writeSurveyReport(output, report);
  fs::path base = output;
  base.replace_extension();
  std::vector<fs::path> files = writeSurveyTables(base, report);
  files.insert(files.begin(), output);
  if (settings.pdf) {
    files.push_back(base);
    files.back() += ".pdf";
    printPdf(output, files.back());
  }
  return files;
}

} // namespace pcl6d::app
