// What one preflight check found: a verdict, and a sentence for people.
//
//   pass      in order
//   degraded  one can fly, and an operator has to say so
//   fail      nothing is flown
//   skipped   there is nothing to look at, or it can not be looked at before another check passes
//
// The sentence says what is wrong, where, and what to do. That of `degraded` has no number in it that changes by
// itself: an operator acknowledges the sentence, and would never get hold of one that is another each second. Thread:
// plain values, pure.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"

namespace godwit::executor::preflight {

// From the best to the worst.
enum class verdict { skipped, pass, degraded, fail };

GODWIT_ENUM_NAMES(verdict, skipped, pass, degraded, fail);

// Bytes. Some sentences quote the mission or the service; the rest of a longer one is cut off.
inline constexpr std::size_t max_sentence = 512;

struct result {
  verdict how = verdict::fail;
  std::string sentence;
  friend bool operator==(const result&, const result&) = default;
};

[[nodiscard]] result pass(std::string sentence);
[[nodiscard]] result degraded(std::string sentence);
[[nodiscard]] result fail(std::string sentence);
[[nodiscard]] result skipped(std::string sentence);

// At most SIZE bytes of TEXT, and no half character at its end.
[[nodiscard]] std::string cut_text(std::string text, std::size_t size);

// The first one, and how many more there are: as much as fits where one line is read. Not of none.
[[nodiscard]] std::string summary_of(const std::vector<std::string>& sentences);

} // namespace godwit::executor::preflight
