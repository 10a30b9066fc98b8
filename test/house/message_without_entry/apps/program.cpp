// SPDX-License-Identifier: BSD-3-Clause
// Texts for the test of test/house/messages.py; nothing compiles this file.
void
work(const std::string& file, int count, bool is_small)
{
  if (count < 0) // throw IoFailed("a comment is no message");
    throw IoFailed(file + ": holds " + std::to_string(count) +
                   " apples, but "
                   "needs more");
  throw UsageError("the basket is " +
                   (is_small ? std::string("too small") : "too large"));
  bar.warn(file + ": no lid on the basket");
  require(count < 9, "count", count, "below 9");
}
