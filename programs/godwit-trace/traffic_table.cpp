#include <algorithm>
#include <array>
#include <cstdio>

#include "programs/godwit-trace/message_name.hpp"
#include "programs/godwit-trace/traffic.hpp"
#include "programs/godwit-trace/utc_time.hpp"

namespace godwit::trace_tool {

namespace {

constexpr std::size_t line_bytes = 160;

template <class... Args>
void append_format(std::string& out, const char* format, Args... args) {
  std::array<char, line_bytes> line{};
  const int size = std::snprintf(line.data(), line.size(), format, args...); // NOLINT(*-vararg)
  out.append(line.data(), std::min(static_cast<std::size_t>(std::max(size, 0)), line.size() - 1));
}

using big = unsigned long long;

std::string text_of(io::mavlink::sender who) {
  return std::to_string(who.system) + '/' + std::to_string(who.component);
}

void append_messages(std::string& out, const traffic& heard) {
  const auto rows = heard.rows();
  if (rows.empty())
    return;
  append_format(out, "%-7s  %-36s  %9s  %9s  %7s\n", "SENDER", "MESSAGE", "COUNT", "HZ", "BYTES");
  for (const auto& each : rows) {
    append_format(out, "%-7s  %-36s  %9llu  ", text_of(each.from).c_str(), message_name(each.id).c_str(),
                  static_cast<big>(each.count));
    if (const auto rate = rate_hz(each, heard.totals()))
      append_format(out, "%9.2f", *rate);
    else
      append_format(out, "%9s", "-");
    append_format(out, "  %7.1f\n", static_cast<double>(each.bytes) / static_cast<double>(each.count));
  }
  out += '\n';
}

void append_senders(std::string& out, const std::vector<io::mavlink::sender_counters>& senders) {
  if (senders.empty())
    return;
  append_format(out, "%-7s  %9s  %9s  %7s  %12s\n", "SENDER", "RECEIVED", "LOST", "LOST %", "OUT OF ORDER");
  for (const auto& each : senders)
    append_format(out, "%-7s  %9llu  %9llu  %7.2f  %12llu\n", text_of(each.who).c_str(),
                  static_cast<big>(each.received), static_cast<big>(each.lost),
                  100.0 * static_cast<double>(each.lost) / static_cast<double>(each.lost + each.received),
                  static_cast<big>(each.out_of_order));
  out += '\n';
}

void append_totals(std::string& out, const traffic_totals& totals) {
  if (totals.frames != 0) {
    append_utc(out, totals.first_us);
    out += " to ";
    append_utc(out, totals.last_us);
    append_format(out, ", %.3f s\n", totals.duration_s());
  }
  append_format(out, "%llu frames, %llu bytes: %llu of messages that are decoded, %llu of other ids; %llu signed\n",
                static_cast<big>(totals.frames), static_cast<big>(totals.bytes), static_cast<big>(totals.known),
                static_cast<big>(totals.other()), static_cast<big>(totals.signed_frames));
  if (totals.not_listed != 0)
    append_format(out, "%llu frames of further senders and messages are not in the table\n",
                  static_cast<big>(totals.not_listed));
}

} // namespace

void append_table(std::string& out, const traffic_report& report) {
  append_messages(out, report.heard);
  append_senders(out, report.senders);
  append_totals(out, report.heard.totals());
  const auto sentence = passed_over_sentence(report.passed_over);
  out += (sentence.empty() ? "passed over: nothing" : sentence) + '\n';
}

std::string passed_over_sentence(std::span<const skipped> list) {
  std::string sentence;
  for (const auto& each : list)
    if (each.count != 0)
      sentence +=
          (sentence.empty() ? "passed over: " : "; ") + std::string(each.words) + ": " + std::to_string(each.count);
  return sentence;
}

} // namespace godwit::trace_tool
