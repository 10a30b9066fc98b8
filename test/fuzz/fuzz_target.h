// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fuzz/mutate.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

/** \file What feeds bytes to the readers of the suite: libFuzzer (fuzz_main.cpp, test/fuzz/run.sh)
 * and, with any compiler, the test of the corpus (test_fuzz_corpus.cpp). */
namespace pcl6d::fuzz {

/** \brief A reader did what none may do: it is no exception of the suite's own. */
class Finding : public std::logic_error {
public:
  using std::logic_error::logic_error;
};

/** \brief A reader of bytes. What it refuses it refuses by the suite's exceptions, which
 * stay inside; everything else comes out. \return 0: read, 1: refused */
using Reader = int (*)(const std::uint8_t* data, std::size_t size);

struct Target {
  const char* name; ///< of the target and of its folder in corpus/
  Reader read;
  Structure structure;  ///< how its files are changed
  std::size_t max_size; ///< [bytes] larger files show nothing new
};

/** \return all targets, by name */
const std::vector<Target>&
targets();

/** \return the target of that name; null: there is none */
const Target*
findTarget(const std::string& name);

/** \throws Finding unless it holds */
void
expect(bool holds, const std::string& law);

/** \brief Gives the bytes as a file to a reader that takes a name, and looks at the words in
 * which it refuses them. \param[in] extension of the file, with its dot
 * \throws Finding the words are none for people (see checkWords()) */
int
readAsFile(const char* extension,
           const std::uint8_t* data,
           std::size_t size,
           const std::function<void(const std::filesystem::path&)>& read);

/** \brief Gives the bytes as text. */
int
readAsText(const std::uint8_t* data,
           std::size_t size,
           const std::function<void(const std::string&)>& read);

/** \param[in] input whose words a message may repeat
 * \throws Finding a message is empty, longer than a screen, holds control characters, or
 * shows the words of a library instead of ours */
void
checkWords(const std::string& message, const std::string& input = {});

} // namespace pcl6d::fuzz
