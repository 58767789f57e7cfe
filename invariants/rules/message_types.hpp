// Message types by their number in a name_table, so that millions of deliveries are told apart without comparing text.
// Thread: one at a time.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "runtime/trace/reading/name_table.hpp"

namespace godwit::invariants {

// Whether a number is the one of NAME.
class known_name {
public:
  explicit known_name(std::string_view name) : name_(name) {}

  [[nodiscard]] bool is(std::uint32_t number, const runtime::name_table& names) {
    if (number_ != unknown)
      return number == number_;
    if (known_no_.size() <= number)
      known_no_.resize(number + 1, false);
    if (known_no_[number])
      return false;
    if (names.name(number) == name_) {
      number_ = number;
      return true;
    }
    known_no_[number] = true;
    return false;
  }

private:
  static constexpr std::uint32_t unknown = UINT32_MAX;
  std::string_view name_;
  std::uint32_t number_ = unknown;
  std::vector<bool> known_no_; // looked at, and of another name
};

} // namespace godwit::invariants
