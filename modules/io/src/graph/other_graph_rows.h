// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/text.h>

#include <string_view>

/** \file Rows of g2o files that are neither poses nor links. */
namespace pcl6d::io {

/** \throws IoFailed the word starts no supported line, with an explanation */
[[noreturn]] void
failAtWord(const std::filesystem::path& path,
           const text::Lines& lines,
           std::string_view word);

} // namespace pcl6d::io
