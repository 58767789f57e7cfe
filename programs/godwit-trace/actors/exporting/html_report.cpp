#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <optional>

#include <nlohmann/json.hpp>

#include "programs/common/html_page.hpp"
#include "programs/godwit-trace/actors/exporting/export_format.hpp"
#include "programs/godwit-trace/actors/flight_events.hpp"
#include "programs/godwit-trace/actors/latency.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"

namespace godwit::trace_tool {

namespace {

std::string fixed(double value, int decimals) {
  std::array<char, 64> text{};
  const int size = std::snprintf(text.data(), text.size(), "%.*f", decimals, value); // NOLINT(*-vararg)
  return {text.data(), static_cast<std::size_t>(std::max(size, 0))};
}

// The way of the vehicle, thinned out so that it stays small however long the flight is.
class flown_way {
public:
  struct point {
    double latitude_deg = 0;
    double longitude_deg = 0;
  };

  void add(point each) {
    if (++seen_ % step_ != 0)
      return;
    points_.push_back(each);
    if (points_.size() < max_points)
      return;
    for (std::size_t n = 0; n < points_.size() / 2; ++n)
      points_[n] = points_[2 * n];
    points_.resize(points_.size() / 2);
    step_ *= 2;
  }

  void append_to(std::string& out) const {
    if (points_.empty()) {
      out += "<p class=\"note\">The trace has no positions of the vehicle.</p>\n";
      return;
    }
    const auto [south, north] = std::ranges::minmax(points_, {}, &point::latitude_deg);
    const auto [west, east] = std::ranges::minmax(points_, {}, &point::longitude_deg);
    const double shrink = std::cos(south.latitude_deg * std::numbers::pi / 180);
    const double width_m = (east.longitude_deg - west.longitude_deg) * shrink * m_per_deg;
    const double height_m = (north.latitude_deg - south.latitude_deg) * m_per_deg;
    const double scale = drawn / std::max({width_m, height_m, 1.0});
    out += "<svg viewBox=\"0 0 " + fixed(width_m * scale + 2 * margin, 0) + ' ' +
           fixed(height_m * scale + 2 * margin, 0) + "\" role=\"img\" aria-label=\"way of the vehicle\">\n<polyline " +
           "fill=\"none\" stroke=\"#0967d2\" stroke-width=\"2\" points=\"";
    const auto place = [&](const point& each) {
      return fixed(margin + (each.longitude_deg - west.longitude_deg) * shrink * m_per_deg * scale, 1) + ',' +
             fixed(margin + (north.latitude_deg - each.latitude_deg) * m_per_deg * scale, 1);
    };
    for (const auto& each : points_)
      out += place(each) + ' ';
    out += "\"/>\n";
    append_mark(out, place(points_.front()), "#3f9142");
    append_mark(out, place(points_.back()), "#a61b1b");
    out += "</svg>\n<p class=\"note\">North is up; " + fixed(width_m, 0) + " m wide, " + fixed(height_m, 0) +
           " m high. Green: begin, red: end. From " + fixed(points_.front().latitude_deg, 6) + ", " +
           fixed(points_.front().longitude_deg, 6) + ".</p>\n";
  }

private:
  static constexpr std::size_t max_points = 4'000;
  static constexpr double m_per_deg = 111'195; // of a great circle on the mean sphere; good enough for a picture
  static constexpr double drawn = 800;
  static constexpr double margin = 20;

  static void append_mark(std::string& out, const std::string& place, const char* colour) {
    const auto comma = place.find(',');
    out += "<circle r=\"6\" fill=\"" + std::string(colour) + "\" cx=\"" + place.substr(0, comma) + "\" cy=\"" +
           place.substr(comma + 1) + "\"/>\n";
  }

  std::vector<point> points_;
  std::uint64_t seen_ = 0;
  std::uint64_t step_ = 1;
};

struct actor_times {
  latency_histogram waiting;
  latency_histogram handling;
};

class html_report final : public exporter {
public:
  html_report(const runtime::name_table& names, std::uint64_t limit) : names_(names), limit_(limit), flight_(names) {}

  void begin(std::string& out) override { out += programs::html_head("godwit flight report"); }

  void take(std::string&, const runtime::delivery& each) override {
    first_ns_ = std::min(first_ns_, each.began_ns);
    last_ns_ = std::max(last_ns_, each.ended_ns());
    ++messages_;
    auto& times = actors_[each.actor];
    times.handling.add(each.duration_ns);
    if (const auto waited_ns = recent_.waiting_ns(each))
      times.waiting.add(*waited_ns);
    if (const auto event = flight_.take(each); event && has_room(limit_))
      events_.push_back(*event);
    if (names_.name(each.type) == "GLOBAL_POSITION_INT" && (!heard_by_ || *heard_by_ == each.actor)) {
      heard_by_ = each.actor; // several actors hear the same
      note_position(each.body);
    }
  }

  void end(std::string& out) override {
    out += "<h1>Flight report</h1>\n";
    if (messages_ == 0) {
      out += "<p>The trace holds no messages.</p></body></html>\n";
      return;
    }
    out += "<p>" + utc_ns(first_ns_) + " to " + utc_ns(last_ns_) + " (UTC), " + std::to_string(messages_) +
           " messages between actors.</p>\n<h2>Way of the vehicle</h2>\n";
    way_.append_to(out);
    append_restarts(out);
    append_time_line(out);
    append_times(out);
    out += "</body></html>\n";
  }

private:
  void note_position(std::string_view body) {
    const auto message = nlohmann::json::parse(body, nullptr, false);
    if (!message.is_object())
      return;
    const auto latitude = message.value("lat", nlohmann::json());
    const auto longitude = message.value("lon", nlohmann::json());
    constexpr double per_deg = 1e7; // MAVLink's degE7
    if (latitude.is_number() && longitude.is_number() && (latitude != 0 || longitude != 0))
      way_.add({latitude.get<double>() / per_deg, longitude.get<double>() / per_deg});
  }

  void append_row(std::string& out, const flight_event& each) const {
    constexpr double ns_per_s = 1e9;
    out += each.is_bad ? "<tr class=\"bad\"><td class=\"t\">" : "<tr><td class=\"t\">";
    out += utc_ns(each.at_ns) + "</td><td class=\"n\">" +
           fixed(static_cast<double>(each.at_ns - first_ns_) / ns_per_s, 3) + "</td><td>" +
           std::string(io::name_of(each.matter)) + "</td><td>" + programs::html_escaped(each.sentence) + "</td></tr>\n";
  }
  void append_events(std::string& out, const char* title, auto wanted) const {
    out += "<h2>" + std::string(title) +
           "</h2>\n<table><tr><th>Time</th><th class=\"n\">s</th><th>Matter</th><th>What</th></tr>\n";
    for (const auto& each : events_)
      if (wanted(each))
        append_row(out, each);
    out += "</table>\n";
  }
  void append_restarts(std::string& out) const {
    append_events(out, "What went wrong, restarts and failsafes", [](const flight_event& each) { return each.is_bad; });
  }
  void append_time_line(std::string& out) const {
    append_events(out, "Time line", [](const flight_event&) { return true; });
    if (left_out() > 0)
      out += "<p class=\"note\">" + std::to_string(left_out()) + " further events are left out.</p>\n";
  }
  void append_times(std::string& out) const {
    constexpr double median = 0.5;
    constexpr double nearly_all = 0.99;
    out +=
        "<h2>Actors and their times</h2>\n<table><tr><th>Actor</th><th class=\"n\">Messages</th><th class=\"n\">Wait "
        "p50</th><th class=\"n\">p99</th><th class=\"n\">max</th><th class=\"n\">Handling p50</th><th "
        "class=\"n\">p99</th><th class=\"n\">max</th></tr>\n";
    for (const auto& [actor, times] : actors_) {
      out += "<tr><td>" + programs::html_escaped(names_.name(actor)) + "</td><td class=\"n\">" +
             std::to_string(times.handling.count()) + "</td>";
      for (const auto* each : {&times.waiting, &times.handling})
        for (const double part : {median, nearly_all, 1.0})
          out += "<td class=\"n\">" + (each->count() == 0 ? "-" : duration_text(each->quantile_ns(part))) + "</td>";
      out += "</tr>\n";
    }
    out += "</table>\n";
  }

  const runtime::name_table& names_;
  std::uint64_t limit_; // of events
  flight_events flight_;
  recent_handlers recent_;
  std::int64_t first_ns_ = INT64_MAX;
  std::int64_t last_ns_ = INT64_MIN;
  std::uint64_t messages_ = 0;
  std::vector<flight_event> events_;
  std::map<std::uint32_t, actor_times> actors_;
  std::optional<std::uint32_t> heard_by_;
  flown_way way_;
};

} // namespace

std::unique_ptr<exporter> make_html_report(const runtime::name_table& names, std::uint64_t limit) {
  return std::make_unique<html_report>(names, limit);
}

} // namespace godwit::trace_tool
