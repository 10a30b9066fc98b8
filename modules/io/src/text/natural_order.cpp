// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/io/natural_order.h>

#include <algorithm>

namespace pcl6d {

namespace {

bool
isNumeral(char c)
{
  return c >= '0' && c <= '9';
}

std::string_view
digitsAt(std::string_view name, std::size_t at)
{
  std::size_t end = at;
  while (end < name.size() && isNumeral(name[end]))
    ++end;
  return name.substr(at, end - at);
}

/** Present times in seconds, or any finer unit, have at least nine digits. */
constexpr std::size_t kDigitsOfTime = 9;

/** \brief Reads a name part by part: numbers, decimals behind a point, and single characters. */
class NameParts {
public:
  explicit NameParts(std::string_view name) : name_(name) {}

  bool
  isAtEnd() const
  {
    return at_ == name_.size();
  }
  char
  front() const
  {
    return name_[at_];
  }
  bool
  isNumber() const
  {
    return isNumeral(front());
  }

  /** \return whether the next part is the point and the decimals of a number: at the start of
   * the name or as long as a time, and not part of a version or date such as 1.2.3 */
  bool
  isDecimals() const
  {
    const std::size_t behind = at_ + digitsAt(name_, at_ + 1).size() + 1;
    return front() == '.' && may_have_decimals_ && behind > at_ + 1 &&
           !(behind + 1 < name_.size() && name_[behind] == '.' &&
             isNumeral(name_[behind + 1]));
  }

  /** \return the digits without leading zeros */
  std::string_view
  takeNumber()
  {
    std::string_view digits = digitsAt(name_, at_);
    may_have_decimals_ =
        at_ == 0 || (digits.size() >= kDigitsOfTime && name_[at_ - 1] != '.');
    at_ += digits.size();
    digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
    return digits;
  }

  /** \return the decimals without trailing zeros */
  std::string_view
  takeDecimals()
  {
    const std::string_view digits = digitsAt(name_, at_ + 1);
    at_ += 1 + digits.size();
    may_have_decimals_ = false;
    return digits.substr(0, digits.find_last_not_of('0') + 1);
  }

  void
  skip()
  {
    ++at_;
    may_have_decimals_ = false;
  }

private:
  std::string_view name_;
  std::size_t at_ = 0;
  bool may_have_decimals_ = false; ///< a number ends here
};

/** \return below 0: a is less; 0: equal; both positions then move behind the number */
int
compareNumbers(NameParts& a, NameParts& b)
{
  const std::string_view number_a = a.takeNumber(), number_b = b.takeNumber();
  if (number_a.size() != number_b.size())
    return number_a.size() < number_b.size() ? -1 : 1;
  return number_a.compare(number_b);
}

} // namespace

bool
naturalLess(std::string_view whole_a, std::string_view whole_b)
{
  NameParts a(whole_a), b(whole_b);
  while (!a.isAtEnd() && !b.isAtEnd()) {
    int order = 0;
    if (a.isNumber() && b.isNumber())
      order = compareNumbers(a, b);
    else if (a.front() != b.front())
      order = a.front() < b.front() ? -1 : 1;
    else if (a.isDecimals() != b.isDecimals())
      order = a.isDecimals() ? -1 : 1;
    else if (a.isDecimals())
      order = a.takeDecimals().compare(b.takeDecimals());
    else {
      a.skip();
      b.skip();
    }
    if (order != 0)
      return order < 0;
  }
  if (a.isAtEnd() != b.isAtEnd())
    return a.isAtEnd();
  return whole_a < whole_b;
}

} // namespace pcl6d
