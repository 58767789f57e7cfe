#include "actors/mission_client/outbox/outbox.hpp"

#include <algorithm>
#include <limits>

#include "io/fields/utf8.hpp"

namespace godwit::mission_client {

std::string cut_error(std::string_view text) {
  return std::string(text.substr(0, io::whole_characters(text, max_error_text)));
}

outbox_row* find_row(std::vector<outbox_row>& rows, std::string_view key) {
  const auto found = std::ranges::find(rows, key, &outbox_row::key);
  return found == rows.end() ? nullptr : &*found;
}

const outbox_row* find_row(const std::vector<outbox_row>& rows, std::string_view key) {
  const auto found = std::ranges::find(rows, key, &outbox_row::key);
  return found == rows.end() ? nullptr : &*found;
}

outbox_counts count_rows(const std::vector<outbox_row>& rows, std::string_view mission_id) {
  outbox_counts result;
  for (const auto& each : rows) {
    if (!mission_id.empty() && each.mission_id != mission_id)
      continue;
    result.pending += each.state == row_state::pending ? 1 : 0;
    result.orphaned += each.state == row_state::orphaned ? 1 : 0;
    result.expired += each.state == row_state::expired ? 1 : 0;
  }
  return result;
}

std::uint64_t held_back_from(const std::vector<outbox_row>& rows, const outbox_row& row) {
  constexpr auto never = std::numeric_limits<std::uint64_t>::max();
  if (is_map(row.to))
    return never;
  const auto found = std::ranges::find_if(rows, [&](const outbox_row& each) {
    const bool goes_first = each.is_flown || (each.to == destination::assignment_response && is_change(row.to));
    return goes_first && each.state == row_state::pending && each.mission_id == row.mission_id;
  });
  return found == rows.end() ? never : found->order + 1;
}

bool is_waiting(const std::vector<outbox_row>& rows, destination to, std::string_view mission_id) {
  return std::ranges::any_of(rows, [&](const outbox_row& each) {
    return each.state == row_state::pending && each.to == to && each.mission_id == mission_id;
  });
}

std::vector<const outbox_row*> cut_from(const std::vector<outbox_row>& rows, const outbox_row& row, std::size_t limit) {
  std::vector<const outbox_row*> result;
  for (const auto& each : rows) {
    if (result.size() == limit)
      break;
    if (each.order >= row.order && each.state == row_state::pending && each.to == row.to &&
        each.mission_id == row.mission_id)
      result.push_back(&each);
  }
  return result;
}

} // namespace godwit::mission_client
