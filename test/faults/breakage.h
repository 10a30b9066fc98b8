// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/random.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/** \file Ways to break a valid file. They know its format, not the program that reads it. */
namespace pcl6d::faults {

/** \brief What a file is made of. */
enum class Format {
  kRows,   ///< text: rows of numbers
  kPcd,    ///< header of text; body of text, of numbers or compressed
  kPly,    ///< header of text; body of text or of numbers
  kFloats, ///< nothing but float32
  kStl,    ///< binary: 80 bytes, count, triangles
  kPng,    ///< chunks with checksums
  kBytes,  ///< anything else
  kJson,
  kXml,
  kYaml,
  kConfig ///< text: name = value
};

/** \brief One way to break one file. */
struct Breakage {
  std::string kind; ///< such as "cut"
  /** No right result can follow: a program that says "done" lies. */
  bool hopeless = false;
  std::function<void(const std::filesystem::path& file)> apply; ///< breaks it in place
};

/** \brief What is known of a file that is to be broken. */
struct Victim {
  Format format = Format::kBytes;
  std::string bytes;             ///< its valid content
  bool needs_all_numbers = true; ///< one that is not finite cannot be left out
  bool may_be_empty = false;     ///< an empty file is a valid one
  bool may_be_missing = false;   ///< and so is none
  bool holds_rotations = false;  ///< which no factor leaves rigid
};

/** \return a whole number in [0, n), or 0 if n is 0 */
inline std::size_t
pick(Random& random, std::size_t n)
{
  return n == 0 ? 0
                : static_cast<std::size_t>(random.uniform() * static_cast<double>(n));
}

/** \return a number that depends on all bytes of a text (FNV-1a) */
inline std::uint64_t
hashOf(const std::string& text)
{
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const char c : text)
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return hash;
}

/** \brief A breakage that puts other bytes into the file. */
Breakage
withBytes(const std::string& kind, bool hopeless, std::string bytes);

/** \brief A breakage that makes its bytes when they are needed, as they are many. */
Breakage
withMadeBytes(const std::string& kind,
              bool hopeless,
              std::function<std::string()> make);

/** \return the text with a part of it replaced */
std::string
replaced(const std::string& text,
         std::size_t at,
         std::size_t length,
         const std::string& with);

/** \return where the body of a file begins: behind the header of PCD and PLY, else 0 */
std::size_t
bodyOf(const Victim& victim);

/** \return whether it is text from its first byte to its last */
bool
isText(const Victim& victim);

using Breakages = std::vector<Breakage>;

// The families, each with its own way to look at a file. Equal seeds: equal breakages.

/** \brief Cuts, flipped bits, lost, doubled, swapped and zero bytes, empty files. */
Breakages
brokenBytes(const Victim& victim, Random& random);

/** \brief Folders, pipes, devices and links that lead nowhere in its place. */
Breakages
brokenPlaces(const Victim& victim);

/** \brief Numbers that are none, too large, too small; lines too long, too few, too many. */
Breakages
brokenText(const Victim& victim, Random& random);

/** \brief Wrong types, missing and doubled keys, deep nesting; of JSON, XML and YAML. */
Breakages
brokenTree(const Victim& victim, Random& random);

/** \brief Counts, sizes and numbers of formats that are not text. */
Breakages
brokenBinary(const Victim& victim, Random& random);

/** \brief So many breakages, evenly from all kinds that suit the file. */
Breakages
breakagesOf(const Victim& victim, std::size_t count, std::uint64_t seed);

} // namespace pcl6d::faults
