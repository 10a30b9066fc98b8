// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/printable.h"
#include "fuzz/fuzz_target.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>

#include <boost/program_options/errors.hpp>

#include <algorithm>
#include <fstream>

namespace pcl6d::fuzz {

namespace {
constexpr std::size_t kLongestMessage = 2000; // [bytes] about a screen of 80 x 25

/** Calls the reader and takes, as a user sees it, what the programs turn into an error of the user's input.
 * \return 0: read, 1: refused */
int
refuseInWords(const std::string& input, const std::function<void()>& read)
{
  try {
    read();
    return 0;
  } catch (const pcl6d::IoFailed& e) {
    checkWords(app::printable(e.what()), input);
  } catch (const pcl6d::BadArgument& e) {
    checkWords(app::printable(e.what()), input);
  } catch (const pcl6d::ComputeFailed& e) {
    checkWords(app::printable(e.what()), input);
  } catch (const app::UsageError& e) {
    checkWords(app::printable(e.what()), input);
  } catch (const boost::program_options::error& e) { // runMain() knows it
    checkWords(app::printable(e.what()), input);
  }
  return 1;
}
} // namespace

void
expect(bool holds, const std::string& law)
{
  if (!holds)
    throw Finding("does not hold: " + law);
}

int
readAsFile(const char* extension,
           const std::uint8_t* data,
           std::size_t size,
           const std::function<void(const std::filesystem::path&)>& read)
{
  static const test::TempFolder folder; // run.sh puts it into memory
  const auto file = folder / (std::string("input") + extension);
  const std::string input(reinterpret_cast<const char*>(data), size);
  test::writeText(file, input);
  return refuseInWords(input, [&] { read(file); });
}

int
readAsText(const std::uint8_t* data,
           std::size_t size,
           const std::function<void(const std::string&)>& read)
{
  const std::string input(reinterpret_cast<const char*>(data), size);
  return refuseInWords(input, [&] { read(input); });
}

void
checkWords(const std::string& message, const std::string& input)
{
  const auto refuse = [&](const std::string& why) {
    throw Finding("a message " + why + ": " + message.substr(0, kLongestMessage));
  };
  const auto quotes = [&](const char* words) { // or seems to: "\x1basic_ios"
    return input.find(words) != std::string::npos ||
           app::printable(input, std::string::npos).find(words) != std::string::npos;
  };
  if (message.empty())
    refuse("is empty");
  if (message.size() > kLongestMessage)
    refuse("is " + std::to_string(message.size()) + " bytes long");
  const bool has_control = std::any_of(message.begin(), message.end(), [](char c) {
    return (c >= 0 && c < ' ' && c != '\n') || c == 127;
  });
  if (has_control)
    refuse("holds control characters");
  for (const char* const words : {"json.exception",
                                  ": Success",
                                  "vector::",
                                  "basic_string",
                                  "basic_filebuf",
                                  "basic_ios",
                                  "bad_alloc",
                                  "bad_any_cast",
                                  "OpenCV("})
    if (message.find(words) != std::string::npos && !quotes(words))
      refuse("shows the words of a library");
}

} // namespace pcl6d::fuzz
