// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/io/nesting.h>

#include <algorithm>

/** \file Forward scan through a possibly hostile text. */
namespace pcl6d::io {

/** \brief A position in a text that only moves forward. */
class TextCursor {
public:
  /** \param[in] name of the file, for messages; kept by reference */
  TextCursor(std::string_view text, const std::string& name) : text_(text), name_(name)
  {}

  bool
  atEnd() const
  {
    return place_ >= text_.size();
  }

  /** \return the current character or the character `ahead` positions later; 0 behind the end */
  char
  peek(std::size_t ahead = 0) const
  {
    return place_ + ahead < text_.size() ? text_[place_ + ahead] : '\0';
  }

  /** \return the current character, which is then skipped */
  char
  take()
  {
    const char c = peek();
    ++place_;
    return c;
  }

  /** \return whether the word came next; if so, the word is skipped */
  bool
  takeWord(std::string_view word)
  {
    if (atEnd() || text_.compare(place_, word.size(), word) != 0)
      return false;
    place_ += word.size();
    return true;
  }

  /** \brief Moves to the next of the characters, or to the end. */
  void
  skipTo(std::string_view characters)
  {
    place_ = std::min(text_.find_first_of(characters, place_), text_.size());
  }

  /** \brief Skips the characters. */
  void
  skip(std::string_view characters)
  {
    place_ = std::min(text_.find_first_not_of(characters, place_), text_.size());
  }

  /** \brief Moves behind the next occurrence of the word, or to the end. */
  void
  skipPast(std::string_view word)
  {
    const std::size_t found = text_.find(word, place_);
    place_ = found == std::string_view::npos ? text_.size() : found + word.size();
  }

  std::size_t
  place() const
  {
    return place_;
  }

  /** \throws IoFailed "name: line 12: message" */
  [[noreturn]] void
  fail(const std::string& message) const
  {
    const std::string_view read = text_.substr(0, place_);
    const auto lines = std::count(read.begin(), read.end(), '\n');
    throw IoFailed(name_ + ": line " + std::to_string(lines + 1) + ": " + message);
  }

  /** \throws IoFailed depth exceeds the limit of open levels */
  void
  requireShallow(std::size_t depth) const
  {
    if (depth > kDeepestNesting)
      fail("nested more than " + std::to_string(kDeepestNesting) + " deep");
  }

private:
  std::string_view text_;
  const std::string& name_;
  std::size_t place_ = 0;
};

} // namespace pcl6d::io
