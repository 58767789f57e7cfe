#include "actors/operator_bridge/state.hpp"

#include <algorithm>

namespace godwit::operator_bridge {
namespace {

bool is_over(const kept_command& each, std::int64_t wall_ns) { return each.answer && each.valid_until_ns < wall_ns; }

bool is_of(const kept_command& each, const operators::principal& who) { return each.by.name == who.name; }

// A repetition of what is forgotten is late, and so does nothing.
void make_room(state& s, const operators::principal& who, std::int64_t wall_ns) {
  const auto of_one = std::ranges::count_if(s.commands, [&](const auto& each) { return is_of(each, who); });
  const bool is_one_full = static_cast<std::size_t>(of_one) >= max_kept_of_one;
  if (!is_one_full && s.commands.size() < max_kept_commands)
    return;
  const auto oldest = std::ranges::find_if(
      s.commands, [&](const auto& each) { return is_over(each, wall_ns) && (!is_one_full || is_of(each, who)); });
  if (oldest != s.commands.end())
    s.commands.erase(oldest);
}

void put(state& s, const command_kept& m, std::int64_t at_ns) {
  s.last_command = std::max(s.last_command, m.what.number);
  make_room(s, m.what.by, at_ns);
  s.commands.push_back(m.what);
}

void put(state& s, const command_ended& m, std::int64_t) {
  const auto found = std::ranges::find(s.commands, m.number, &kept_command::number);
  if (found == s.commands.end())
    return;
  if (found->id.empty())
    s.commands.erase(found);
  else
    found->answer = m.answer;
}

void put(state& s, const audited& m, std::int64_t at_ns) {
  if (m.row.number != 0) {
    s.last_row = std::max(s.last_row, m.row.number);
    return;
  }
  s.unmoved.push_back(m.row);
  s.unmoved.back().number = ++s.last_row;
  s.unmoved.back().at_ns = at_ns;
}

void put(state& s, const rows_moved&, std::int64_t) { s.unmoved.clear(); }

void put(state& s, const control_changed& m, std::int64_t at_ns) {
  s.control.reset();
  if (m.to)
    s.control = {*m.to, at_ns};
}

void put(state& s, const session_opened& m, std::int64_t at_ns) {
  ++s.last_session;
  s.sessions.push_back(m.what);
  s.sessions.back().opened_ns = at_ns;
  s.sessions.back().used_ns = at_ns;
}

void put(state& s, const session_used& m, std::int64_t at_ns) {
  if (const auto found = std::ranges::find(s.sessions, m.id, &session::id); found != s.sessions.end())
    found->used_ns = at_ns;
}

void put(state& s, const session_closed& m, std::int64_t) {
  std::erase_if(s.sessions, [&](const auto& each) { return each.id == m.id; });
}

void put(state& s, const link_made& m, std::int64_t) {
  if (s.links.size() == max_links)
    s.links.erase(s.links.begin());
  s.links.push_back(m.what);
}

void put(state& s, const link_dropped& m, std::int64_t) {
  std::erase_if(s.links, [&](const auto& each) { return each.hash == m.hash; });
}

void put(state& s, const accounts_read& m, std::int64_t) { s.accounts = m.list; }

} // namespace

std::vector<durable_core::effect> durable_core::apply(state& s, const event& happened, std::int64_t at_ns) {
  std::visit([&](const auto& each) { put(s, each, at_ns); }, happened);
  return {};
}

tl::expected<nlohmann::json, std::string> durable_core::migrate(nlohmann::json old, int) {
  auto rows = nlohmann::json::array();
  for (const auto* kept : {"audit", "strangers"})
    for (auto& each : old.value(kept, nlohmann::json::array()))
      rows.push_back(std::move(each));
  old.erase("audit");
  old.erase("strangers");
  old["unmoved"] = std::move(rows);
  return old;
}

bool has_room(const state& s, const operators::principal& who, std::int64_t wall_ns) {
  std::size_t all = 0;
  std::size_t of_one = 0;
  for (const auto& each : s.commands)
    if (!is_over(each, wall_ns)) {
      ++all;
      of_one += is_of(each, who) ? 1 : 0;
    }
  return all < max_kept_commands && of_one < max_kept_of_one;
}

} // namespace godwit::operator_bridge
