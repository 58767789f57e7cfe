#include "programs/godwit-drill/report.hpp"

#include <array>
#include <cstdio>
#include <utility>

namespace godwit::drill {

namespace {

constexpr std::size_t name_width = 28;
constexpr std::size_t value_width = 14;

// 1234567 -> "1,234,567"
std::string grouped(std::uint64_t value) {
  auto digits = std::to_string(value);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), 1, ',');
  return digits;
}

std::string fixed(double value, int decimals) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

void add_row(std::string& table, const std::string& name, const std::string& value) {
  table += "  " + name + std::string(name_width - std::min(name_width, name.size()), ' ') +
           std::string(value_width - std::min(value_width, value.size()), ' ') + value + '\n';
}

} // namespace

std::string to_table(const runtime_drill_result& r) {
  const std::array counts{std::pair{"sent", r.sent},
                          std::pair{"handled", r.handled},
                          std::pair{"dead-lettered", r.dead_lettered},
                          std::pair{"lost", r.lost},
                          std::pair{"doubled", r.doubled},
                          std::pair{"durable effects acknowledged", r.effects_expected},
                          std::pair{"durable effects in the table", r.effects_found},
                          std::pair{"crashes", r.crashes},
                          std::pair{"restarts", r.restarts}};
  std::string table;
  for (const auto& [name, value] : counts)
    add_row(table, name, grouped(value));
  add_row(table, "restart latency p50", fixed(r.restart_p50_us, 0) + " us");
  add_row(table, "restart latency p99", fixed(r.restart_p99_us, 0) + " us");
  add_row(table, "restart latency max", fixed(r.restart_max_us, 0) + " us");
  add_row(table, "trace records", grouped(r.trace_records));
  add_row(table, "trace records dropped", grouped(r.trace_dropped));
  add_row(table, "journal commits", grouped(r.journal_commits));
  add_row(table, "seconds", fixed(r.seconds, 2));
  return table;
}

} // namespace godwit::drill
