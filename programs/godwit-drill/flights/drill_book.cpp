#include "programs/godwit-drill/flights/drill_book.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "io/fields/json_text.hpp"
#include "programs/common/html_page.hpp"

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

namespace {

using programs::html_escaped;

constexpr const char* green = "#3a8f5c";
constexpr const char* amber = "#c98a1b";
constexpr const char* red = "#b3261e";
constexpr const char* grey = "#b8c2cc";

std::string fixed(double value, int decimals) {
  std::array<char, 64> text{};
  const int size = std::snprintf(text.data(), text.size(), "%.*f", decimals, value); // NOLINT(*-vararg)
  return {text.data(), static_cast<std::size_t>(std::max(size, 0))};
}

std::string number_cell(const std::string& text) { return "<td class=\"n\">" + text + "</td>"; }
std::string number_cell(std::uint64_t value) { return number_cell(std::to_string(value)); }

std::string rectangle(double x, double y, double width, double height, const char* colour) {
  return "<rect x=\"" + fixed(x, 2) + "\" y=\"" + fixed(y, 1) + "\" width=\"" + fixed(width, 2) + "\" height=\"" +
         fixed(height, 1) + "\" fill=\"" + colour + "\"/>";
}

std::string label(double x, double y, const std::string& text, const char* anchor = "start") {
  return "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" font-size=\"12\" text-anchor=\"" + anchor + "\">" +
         html_escaped(text) + "</text>";
}

std::string group_row(const std::string& name, const flight_figures& of) {
  auto result = (of.failed > 0 ? "<tr class=\"bad\"><td>" : "<tr><td>") + html_escaped(name) + "</td>";
  for (const auto value :
       {of.flights, of.not_tried, of.failed, of.known, of.with_takeover, of.kills, of.crashes, of.lost, of.doubled})
    result += number_cell(value);
  for (const double part : {50.0, 99.0, 100.0})
    result += number_cell(of.recoveries_ms.empty() ? "-" : fixed(percentile(of.recoveries_ms, part), 1));
  return result + "</tr>\n";
}

std::string table_of(const drill_book& book) {
  std::string result = "<table><tr><th>Group</th>";
  for (const char* each : {"Flights", "Not tried", "Failed", "Known", "Takeovers", "Kills", "Crashes", "Lost",
                           "Doubled", "Recovery p50 ms", "p99 ms", "max ms"})
    result += std::string("<th class=\"n\">") + each + "</th>";
  result += "</tr>\n";
  for (const auto& [name, figures] : book.groups())
    result += group_row(name, figures);
  return result + group_row("all", book.total()) + "</table>\n";
}

constexpr double name_width = 260;
constexpr double plot_width = 700;
constexpr double row_height = 20;

std::string plot_begin(std::size_t rows, double below) {
  return "<svg viewBox=\"0 0 1000 " + fixed(row_height * static_cast<double>(rows) + below, 0) + "\">\n";
}

// How many of a group's flights held, are known findings, failed, and had nothing to try.
std::string outcomes_of(const drill_book& book) {
  auto result = plot_begin(book.groups().size(), 10);
  double y = 5;
  for (const auto& [name, of] : book.groups()) {
    const auto held = of.flights - of.failed - of.known - of.not_tried;
    result += label(0, y + 14, name);
    double x = name_width;
    for (const auto& [count, colour] :
         {std::pair{held, green}, {of.known, amber}, {of.failed, red}, {of.not_tried, grey}}) {
      const auto width = plot_width * static_cast<double>(count) / static_cast<double>(of.flights);
      result += rectangle(x, y + 2, width, row_height - 5, colour);
      x += width;
    }
    result += label(name_width + plot_width + 5, y + 14, std::to_string(of.flights)) + "\n";
    y += row_height;
  }
  return result + "</svg>\n<p class=\"note\">Green: held. Amber: a known finding. Red: failed. Grey: not tried.</p>\n";
}

// Each recovery is a stroke on a logarithmic scale of milliseconds.
std::string recoveries_of(const drill_book& book) {
  constexpr double least_ms = 0.01;
  constexpr double decades = 7; // up to 100 s
  const auto x_of = [&](double ms) {
    const auto behind = std::log10(std::max(ms, least_ms)) - std::log10(least_ms);
    return name_width + plot_width * std::min(behind, decades) / decades;
  };
  std::string rows;
  std::size_t count = 0;
  for (const auto& [name, of] : book.groups()) {
    if (of.recoveries_ms.empty())
      continue;
    const double y = row_height * static_cast<double>(count++);
    rows += label(0, y + 15, name);
    auto each_ms = of.recoveries_ms;
    std::ranges::sort(each_ms);
    constexpr std::size_t most_strokes = 400;
    for (std::size_t i = 0; i < each_ms.size(); i += 1 + each_ms.size() / most_strokes)
      rows += rectangle(x_of(each_ms[i]), y + 3, 1.5, row_height - 6, "#2b5c8a");
    rows += rectangle(x_of(each_ms.back()), y + 3, 1.5, row_height - 6, "#2b5c8a") + "\n";
  }
  if (count == 0)
    return {};
  auto result = "<h2>Recovery (virtual time)</h2>\n" + plot_begin(count, 25) + rows;
  const double bottom = row_height * static_cast<double>(count);
  for (const char* each : {"0.1", "1", "10", "100", "1000", "10000"}) {
    const double x = x_of(std::stod(each));
    result += rectangle(x, 0, 0.5, bottom, grey) + label(x, bottom + 15, std::string(each) + " ms", "middle");
  }
  return result + "</svg>\n";
}

std::string failures_of(const drill_book& book) {
  std::string result;
  for (const auto& each : book.kept()) {
    if (each.held())
      continue;
    result += "<h3>" + html_escaped(each.name) + "</h3>\n<ul>\n";
    for (const auto& flaw : each.flaws)
      result += "<li>" + html_escaped(flaw) + "</li>\n";
    result += "</ul>\n<p>Again: <code>" + html_escaped(each.again) + "</code></p>\n";
    if (!each.story.empty())
      result += "<details><summary>What happened</summary><pre>" + html_escaped(each.story) + "</pre></details>\n";
  }
  return result.empty() ? result : "<h2>Flights with a flaw</h2>\n" + result;
}

std::string known_of(const drill_book& book) {
  std::string result;
  for (const auto& each : book.kept())
    for (const auto& known : each.known)
      result += "<tr><td>" + html_escaped(each.name) + "</td><td>" + html_escaped(known) + "</td></tr>\n";
  return result.empty()
             ? result
             : "<h2>Known findings</h2>\n<table><tr><th>Flight</th><th>Finding</th></tr>\n" + result + "</table>\n";
}

} // namespace

std::string to_html(const drill_page& page) {
  const auto& total = page.book.total();
  std::string verdict = "Passed: nothing lost, nothing doubled, no promise broken.";
  if (total.failed > 0)
    verdict = "FAILED: " + std::to_string(total.failed) + " of " + std::to_string(total.flights) + " flights.";
  else if (total.known > 0)
    verdict = "Passed, but for the known findings of " + std::to_string(total.known) + " flights.";
  return programs::html_head(page.command) + "<h1>" + html_escaped(page.command) + "</h1>\n<p>" + verdict + " " +
         fixed(total.flown_s, 0) + " s of flights in " + fixed(page.took_s, 1) + " s.</p>\n" + table_of(page.book) +
         "<h2>Outcomes</h2>\n" + outcomes_of(page.book) + recoveries_of(page.book) + failures_of(page.book) +
         known_of(page.book) + "</body></html>\n";
}

} // namespace godwit::drill
