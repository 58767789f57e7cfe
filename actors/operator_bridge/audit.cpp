#include "actors/operator_bridge/audit.hpp"

#include <algorithm>
#include <utility>

#include "io/fields/utf8.hpp"

namespace godwit::operator_bridge {
void audit::add(effects& out, audit_row row) {
  row.what.resize(io::whole_characters(row.what, max_reason));
  row.id.resize(io::whole_characters(row.id, max_command_id));
  row.reason.resize(io::whole_characters(row.reason, max_reason));
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
  name.resize(io::whole_characters(name, max_name));
  row.who = {std::move(name), operators::role::viewer, {}};
  row.id.clear();
  row.count = 1 + std::exchange(unwritten_, 0);
  add(out, std::move(row));
}

} // namespace godwit::operator_bridge
