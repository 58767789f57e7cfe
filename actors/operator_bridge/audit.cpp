#include "actors/operator_bridge/audit.hpp"

#include <algorithm>
#include <utility>

namespace godwit::operator_bridge {
namespace {

// Not in the middle of a character.
void cut(std::string& text, std::size_t bytes) {
  if (text.size() <= bytes)
    return;
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0U) == 0x80U)
    --bytes;
  text.resize(bytes);
}

} // namespace

void audit::add(effects& out, audit_row row, instant) {
  cut(row.what, max_reason);
  cut(row.id, max_command_id);
  cut(row.reason, max_reason);
  out.emplace_back(note{audited{std::move(row)}});
}

void audit::add_stranger(effects& out, std::string name, audit_row row, instant now) {
  left_ = std::min(rows_at_once,
                   left_ + rows_per_s *
                               static_cast<double>(now.monotonic_ns - std::exchange(counted_ns_, now.monotonic_ns)) /
                               static_cast<double>(ns_per_s));
  if (left_ < 1) {
    ++unwritten_;
    return;
  }
  left_ -= 1;
  cut(name, max_name);
  row.who = {std::move(name), operators::role::viewer, {}};
  row.id.clear();
  row.count = 1 + std::exchange(unwritten_, 0);
  add(out, std::move(row), now);
}

} // namespace godwit::operator_bridge
