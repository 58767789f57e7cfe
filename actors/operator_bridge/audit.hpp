// What is written into the audit. Of strangers ten rows go at once and one a second after that: the rest is counted,
// and added to the next row, so that nobody can fill the disk from outside. Pure. Thread: one owner.
#pragma once

#include <cstdint>
#include <string>

#include "actors/operator_bridge/effects.hpp"
#include "actors/operator_bridge/instant.hpp"

namespace godwit::operator_bridge {

inline constexpr std::size_t max_reason = 200; // bytes of a sentence in the audit
inline constexpr std::size_t max_name = 32;    // bytes of a name that a stranger gives

class audit {
public:
  static constexpr double rows_at_once = 10;
  static constexpr double rows_per_s = 1;

  void add(effects& out, audit_row row);
  // Under a name that nobody has proved.
  void add_stranger(effects& out, std::string name, audit_row row, instant now);

private:
  double left_ = rows_at_once; // that may be written
  std::int64_t counted_ns_ = 0;
  std::uint32_t unwritten_ = 0;
};

} // namespace godwit::operator_bridge
