// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/temp_folder.h"

#include <boost/process.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace pcl6d::test {

/** \return the path of Chromium; empty where there is none */
inline std::string
findBrowser()
{
  for (const char* const name : {"chromium", "chromium-browser", "google-chrome"})
    if (const auto path = boost::process::search_path(name); !path.empty())
      return path.string();
  return {};
}

/** \return text as it was before a browser wrote it into HTML */
inline std::string
withoutEntities(std::string text)
{
  for (const auto& [entity, plain] : {std::pair("&lt;", "<"),
                                      std::pair("&gt;", ">"),
                                      std::pair("&quot;", "\""),
                                      std::pair("&nbsp;", "\u00a0"),
                                      std::pair("&amp;", "&")})
    for (std::size_t at = 0; (at = text.find(entity, at)) != std::string::npos; ++at)
      text.replace(at, std::string(entity).size(), plain);
  return text;
}

/** \return a page that shows another one in a frame, as no browser window is as narrow as
 * a phone, and takes down what it says */
inline std::string
framed(const std::filesystem::path& page, int width, int height)
{
  return "<!doctype html><script>addEventListener('message', (event) => {"
         "document.getElementById('selftest').textContent = event.data; });</script>"
         "<pre id=\"selftest\"></pre><iframe src=\"file://" +
         page.string() + "#selftest\" width=\"" + std::to_string(width) +
         "\" height=\"" + std::to_string(height) + "\" style=\"border:0\"></iframe>";
}

/** \return the text of an element of a document, as a browser prints it; empty: not there */
inline std::string
textOf(const std::string& document, const std::string& id)
{
  const std::string start = "<pre id=\"" + id + "\">";
  const std::size_t begin = document.find(start);
  if (begin == std::string::npos)
    return {};
  const std::size_t from = begin + start.size();
  return withoutEntities(document.substr(from, document.find("</pre>", from) - from));
}

/** \brief Opens a report from disk in a browser without a window, where it tests itself
 * (modules/visualization/report/src/selftest.js). \return what it found: "passed", "width"
 * and "checks"; null and a failed test if it told nothing */
inline nlohmann::json
selfTestOf(const std::filesystem::path& page, int width, int height)
{
  namespace bp = boost::process;
  const TempFolder folder;
  writeText(folder / "frame.html", framed(page, width, height));
  // As root there is no sandbox; without a graphics card WebGL is drawn by the processor.
  bp::system(bp::search_path("timeout"),
             "--kill-after=5",
             "400",
             findBrowser(),
             "--headless=new",
             "--no-sandbox",
             "--no-first-run",
             "--disable-extensions",
             "--disable-background-networking",
             "--disable-dev-shm-usage", // small in containers
             "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader",
             "--user-data-dir=" + (folder / "profile").string(),
             "--window-size=1600,1200",
             "--dump-dom",
             "file://" + (folder / "frame.html").string(),
             bp::std_in<bp::null, bp::std_out>(folder / "page").string(),
             bp::std_err > (folder / "log").string());
  const std::string outcome = textOf(readText(folder / "page"), "selftest");
  if (outcome.empty())
    ADD_FAILURE() << "the page told nothing; the browser: " << readText(folder / "log");
  return nlohmann::json::parse(outcome, nullptr, /*allow_exceptions=*/false);
}

/** \brief Expects that a page passed all checks, and made some. */
inline void
expectPassed(const nlohmann::json& outcome)
{
  ASSERT_TRUE(outcome.is_object());
  EXPECT_GT(outcome["checks"].size(), 8u);
  for (const auto& check : outcome["checks"])
    EXPECT_TRUE(check["passed"]) << check;
}

/** \return whether a page made a check */
inline bool
isChecked(const nlohmann::json& outcome, const std::string& name)
{
  for (const auto& check : outcome.value("checks", nlohmann::json::array()))
    if (check["name"] == name)
      return true;
  return false;
}

} // namespace pcl6d::test
