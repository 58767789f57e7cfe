// What is written into the audit, and how much of it. Everybody has a share of the writing of their own, one for what
// was done and one for what was refused; strangers, whose names prove nothing, have one together:
//
//           ┌─ act      ── 100 rows at once, then 10 a second of each person
//   row ────┼─ refusal  ── 20 rows at once, then one a second of each person
//           └─ stranger ── 10 rows at once, then one a second of all of them
//
// What comes beyond is counted, and the count is written as soon as there is room: nobody can fill the disk, and none
// is forgotten. Rows alike within a minute are one row; of acts only where nothing came in between. How many are kept:
// audit_table.hpp. Pure. Thread: one owner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "actors/operator_bridge/effects.hpp"
#include "io/time_units.hpp"

namespace godwit::operator_bridge {

inline constexpr std::size_t max_reason = 200; // bytes of a sentence in the audit
inline constexpr std::size_t max_name = 32;    // bytes of a name that a stranger gives

enum class audit_kind : std::uint8_t { act, refusal, stranger };

// An act: it was done, or may have been.
[[nodiscard]] audit_kind kind_of(const audit_row& row);

class audit {
public:
  struct rate {
    double at_once = 0;
    double per_s = 0;
  };
  static constexpr rate of_acts{100, 10};
  static constexpr rate of_refusals{20, 1};
  static constexpr rate of_strangers{10, 1};
  static constexpr std::size_t max_shares = 256; // people that are told apart; the others have one share together
  static constexpr std::int64_t alike_within_ns = 60 * ns_per_s;

  explicit audit(std::uint64_t last_row) : last_row_(last_row) {}

  void add(effects& out, audit_row row, instant now);
  // Under a name that nobody has proved.
  void add_stranger(effects& out, std::string name, audit_row row, instant now);

  // When what was counted may be written; monotonic. NEVER: nothing waits.
  [[nodiscard]] std::int64_t due_ns(std::int64_t never) const;
  void write_counted(effects& out, instant now);

private:
  struct share {
    rate its;
    double left = 0; // rows that may be written
    std::int64_t counted_ns = 0;
    std::optional<audit_row> newest = {}; // written
    std::int64_t newest_ns = 0;
    std::optional<audit_row> unwritten = {}; // the newest, with the count of all
  };
  using share_key = std::pair<audit_kind, std::string>;

  [[nodiscard]] share& share_of(const audit_row& row, instant now);
  static void refill(share& of, instant now);
  void forget_idle(instant now);
  void write(effects& out, share& of, audit_row row, instant now);

  std::uint64_t last_row_;
  std::map<share_key, share> shares_;
};

} // namespace godwit::operator_bridge
