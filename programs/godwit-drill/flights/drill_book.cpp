#include "programs/godwit-drill/flights/drill_book.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "io/fields/json_text.hpp"

namespace godwit::drill {
namespace {

std::string row(const std::string& name, std::size_t name_width, const flight_figures& of) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "%8llu %9llu %7llu %6llu %9llu %6llu %7llu %5llu %8llu",
                static_cast<unsigned long long>(of.flights), static_cast<unsigned long long>(of.not_tried),
                static_cast<unsigned long long>(of.failed), static_cast<unsigned long long>(of.known),
                static_cast<unsigned long long>(of.with_takeover), static_cast<unsigned long long>(of.kills),
                static_cast<unsigned long long>(of.crashes), static_cast<unsigned long long>(of.lost),
                static_cast<unsigned long long>(of.doubled));
  auto result = name + std::string(name_width - name.size() + 1, ' ') + text.data();
  if (!of.recoveries_ms.empty()) {
    std::snprintf(text.data(), text.size(), " %8.1f %8.1f %8.1f", percentile(of.recoveries_ms, 50),
                  percentile(of.recoveries_ms, 99), percentile(of.recoveries_ms, 100));
    result += text.data();
  }
  return result + '\n';
}

nlohmann::json to_json(const std::string& name, const flight_figures& of) {
  nlohmann::json result{{"name", name},
                        {"flights", of.flights},
                        {"not_tried", of.not_tried},
                        {"failed", of.failed},
                        {"known", of.known},
                        {"kills", of.kills},
                        {"lost", of.lost},
                        {"doubled", of.doubled},
                        {"crashes", of.crashes},
                        {"flown_s", of.flown_s},
                        {"with_takeover", of.with_takeover}};
  if (!of.recoveries_ms.empty())
    result["recovery_ms"] = {{"p50", percentile(of.recoveries_ms, 50)},
                             {"p99", percentile(of.recoveries_ms, 99)},
                             {"max", percentile(of.recoveries_ms, 100)}};
  return result;
}

} // namespace

double percentile(std::vector<double> values, double p) {
  if (values.empty())
    return 0;
  std::ranges::sort(values);
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(p * 0.01 * last + 0.5)];
}

void flight_figures::take(const flight_outcome& each) {
  ++flights;
  not_tried += each.skipped.empty() ? 0 : 1;
  failed += each.held() ? 0 : 1;
  known += each.held() && !each.known.empty() ? 1 : 0;
  with_takeover += each.takeovers > 0 ? 1 : 0;
  kills += each.kills;
  crashes += each.crashes;
  lost += each.lost;
  doubled += each.doubled;
  flown_s += each.flown_s;
  if (each.recovery_ms && each.skipped.empty())
    recoveries_ms.push_back(*each.recovery_ms);
}

void drill_book::take(const flight_outcome& each) {
  groups_[each.group].take(each);
  total_.take(each);
  if (keeps_all_ || !each.held())
    kept_.push_back(each);
}

std::string drill_book::to_table(double took_s) const {
  std::size_t name_width = 20;
  for (const auto& [name, figures] : groups_)
    name_width = std::max(name_width, name.size());
  auto result =
      std::string(name_width + 1, ' ') +
      " flights not tried  failed  known takeovers  kills crashes  lost  doubled   p50 ms   p99 ms   max ms\n";
  for (const auto& [name, figures] : groups_)
    result += row(name, name_width, figures);
  result += row("all", name_width, total_);
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), "%.0f s of flights in %.1f s: %.0f times real time\n", total_.flown_s, took_s,
                took_s > 0 ? total_.flown_s / took_s : 0);
  return result + text.data();
}

nlohmann::json drill_book::to_json(double took_s) const {
  nlohmann::json groups = nlohmann::json::array();
  for (const auto& [name, figures] : groups_)
    groups.push_back(drill::to_json(name, figures));
  nlohmann::json flights = nlohmann::json::array();
  for (const auto& each : kept_)
    flights.push_back(nlohmann::json::parse(io::to_json(each)));
  return {{"total", drill::to_json("all", total_)},
          {"groups", groups},
          {"took_s", took_s},
          {"times_real_time", took_s > 0 ? total_.flown_s / took_s : 0},
          {"flights", std::move(flights)}};
}

std::string text_of_failure(const flight_outcome& each) {
  std::string result = "FAILED " + each.name + "\n";
  for (const auto& flaw : each.flaws)
    result += "  " + flaw + "\n";
  return result + "  again: " + each.again + "\n" + each.story;
}

} // namespace godwit::drill
