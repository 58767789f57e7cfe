#include "actors/fleet_link/live_texts.hpp"

#include <algorithm>
#include <utility>

namespace godwit::fleet_link {
namespace {

// How the hub begins each text.
constexpr std::string_view beginning = R"({"topic":")";

std::size_t index_of(const live_row* row) { return static_cast<std::size_t>(row - live_rows.data()); }

} // namespace

const live_row* row_of_text(std::string_view text) {
  if (!text.starts_with(beginning))
    return nullptr;
  text.remove_prefix(beginning.size());
  const auto what = io::value_of<telemetry_stream::topic>(text.substr(0, text.find('"')));
  if (!what)
    return nullptr;
  const auto* const found = std::ranges::find(live_rows, *what, &live_row::what);
  return found == live_rows.end() ? nullptr : found;
}

void live_texts::take(text_ptr text) {
  const auto* const row = row_of_text(*text);
  if (row == nullptr)
    return;
  auto& its = entries_.at(index_of(row));
  skipped_ += its.is_held ? 1 : 0;
  its.text = std::move(text);
  its.is_new = true;
  its.is_held = false;
}

void live_texts::begin_connection() {
  for (std::size_t i = 0; i < live_rows.size(); ++i) {
    auto& its = entries_.at(i);
    its.is_new = live_rows.at(i).is_kept ? its.text != nullptr : its.is_new;
    its.is_held = false;
    its.next_ns = 0;
  }
}

std::optional<live_texts::due> live_texts::next_due(std::int64_t now_ns) {
  for (std::size_t i = 0; i < live_rows.size(); ++i) {
    auto& its = entries_.at(i);
    if (!is_due(its, now_ns))
      continue;
    its.is_new = false;
    its.is_held = false;
    its.next_ns = now_ns + live_rows.at(i).intervals * interval_ns_;
    return due{&live_rows.at(i), its.text};
  }
  return {};
}

void live_texts::hold_back(std::int64_t now_ns) {
  for (auto& each : entries_)
    each.is_held = each.is_held || is_due(each, now_ns);
}

} // namespace godwit::fleet_link
