#include "actors/mission_client/outbox.hpp"

#include <algorithm>

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
