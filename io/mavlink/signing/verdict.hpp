// What became of a frame that arrived, as far as signing goes. Thread: values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "io/fields/field_table.hpp"

namespace godwit::io::mavlink {

enum class verdict : std::uint8_t {
  accepted_signed,
  accepted_unsigned, // no signature was asked for: the link is trusted, or the id is let through
  bad_signature,     // another key, or changed on the way
  replayed,          // of a known stream, and not above its last timestamp
  too_old,           // of a new stream, and too far behind our time
  too_new,           // too far ahead of our time
  unsigned_refused,
  too_many_streams, // of a new stream, and there is no place for one
};

GODWIT_ENUM_NAMES(verdict, accepted_signed, accepted_unsigned, bad_signature, replayed, too_old, too_new,
                  unsigned_refused, too_many_streams);

[[nodiscard]] constexpr bool is_accepted(verdict each) {
  return each == verdict::accepted_signed || each == verdict::accepted_unsigned;
}

// How many frames got which verdict.
class verdict_counts {
public:
  void count(verdict each) { ++counts_[static_cast<std::size_t>(each)]; }
  [[nodiscard]] std::uint64_t of(verdict each) const { return counts_[static_cast<std::size_t>(each)]; }
  [[nodiscard]] std::uint64_t total() const {
    return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
  }
  [[nodiscard]] std::uint64_t rejected() const {
    return total() - of(verdict::accepted_signed) - of(verdict::accepted_unsigned);
  }

private:
  std::array<std::uint64_t, enum_names(verdict{}).size()> counts_{};
};

} // namespace godwit::io::mavlink
