#include "programs/godwit-trace/traffic.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <tuple>
#include <utility>

#include "io/fields/json_text.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-trace/message_forms.hpp"
#include "programs/godwit-trace/utc_time.hpp"

namespace godwit::trace_tool {

namespace {

std::uint64_t key_of(io::mavlink::sender from, std::uint32_t id) {
  return std::uint64_t{id} << 16U | std::uint64_t{from.system} << 8U | from.component;
}

} // namespace

void traffic::note(std::uint64_t time_us, const io::mavlink::frame_view& frame) {
  totals_.first_us = totals_.frames == 0 ? time_us : std::min(totals_.first_us, time_us);
  totals_.last_us = totals_.frames == 0 ? time_us : std::max(totals_.last_us, time_us);
  ++totals_.frames;
  totals_.known += io::mavlink::known_messages::contains(frame.id()) ? 1 : 0;
  totals_.signed_frames += frame.is_signed() ? 1 : 0;
  totals_.bytes += frame.size();
  auto row = rows_.find(key_of(frame.from(), frame.id()));
  if (row == rows_.end()) {
    if (rows_.size() == max_rows) {
      ++totals_.not_listed;
      return;
    }
    row = rows_.emplace(key_of(frame.from(), frame.id()), traffic_row{frame.from(), frame.id()}).first;
  }
  ++row->second.count;
  row->second.bytes += frame.size();
}

std::vector<traffic_row> traffic::rows() const {
  std::vector<traffic_row> result;
  result.reserve(rows_.size());
  for (const auto& each : rows_)
    result.push_back(each.second);
  std::ranges::sort(result, {}, [](const traffic_row& row) {
    return std::tuple(row.from.system, row.from.component, message_name(row.id));
  });
  return result;
}

std::optional<double> rate_hz(const traffic_row& row, const traffic_totals& totals) {
  const double duration_s = totals.duration_s();
  return duration_s > 0 ? std::optional(static_cast<double>(row.count) / duration_s) : std::nullopt;
}

namespace {

// The members of an object, one after the other.
class json_object {
public:
  explicit json_object(std::string& out) : out_(out) { out_ += '{'; }
  json_object(const json_object&) = delete;
  json_object& operator=(const json_object&) = delete;
  ~json_object() { out_ += '}'; }

  template <class V>
  void add(std::string_view name, const V& value) {
    key(name);
    io::append_json_value(out_, value);
  }
  void key(std::string_view name) {
    out_ += first_ ? "\"" : ",\"";
    out_.append(name).append("\":");
    first_ = false;
  }

private:
  std::string& out_;
  bool first_ = true;
};

// [...] with what APPEND writes for each of VALUES.
template <class Range, class Append>
void append_list(std::string& out, const Range& values, Append append) {
  out += '[';
  bool first = true;
  for (const auto& each : values) {
    out += first ? "" : ",";
    first = false;
    append(each);
  }
  out += ']';
}

void append_row(std::string& out, const traffic_row& row, const traffic_totals& totals) {
  json_object object(out);
  object.add("system", row.from.system);
  object.add("component", row.from.component);
  object.add("id", row.id);
  object.add("name", message_name(row.id));
  object.add("count", row.count);
  object.add("rate_hz", rate_hz(row, totals));
  object.add("mean_bytes", static_cast<double>(row.bytes) / static_cast<double>(row.count));
}

void append_sender(std::string& out, const io::mavlink::sender_counters& each) {
  json_object object(out);
  object.add("system", each.who.system);
  object.add("component", each.who.component);
  object.add("received", each.received);
  object.add("lost", each.lost);
  object.add("out_of_order", each.out_of_order);
}

} // namespace

void append_traffic_json(std::string& out, const traffic_report& report) {
  const auto& totals = report.heard.totals();
  json_object object(out);
  object.add("first_us", totals.first_us);
  object.add("last_us", totals.last_us);
  object.add("duration_s", totals.duration_s());
  object.add("frames", totals.frames);
  object.add("known", totals.known);
  object.add("other", totals.other());
  object.add("signed", totals.signed_frames);
  object.add("bytes", totals.bytes);
  object.add("not_listed", totals.not_listed);
  object.key("messages");
  append_list(out, report.heard.rows(), [&](const traffic_row& row) { append_row(out, row, totals); });
  object.key("senders");
  append_list(out, report.senders, [&](const auto& each) { append_sender(out, each); });
  object.key("passed_over");
  json_object passed_over(out);
  for (const auto& each : report.passed_over)
    passed_over.add(each.key, each.count);
}

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

namespace {

using io::mavlink::verdict;

struct cause {
  verdict which;
  std::string_view key;
  std::string_view words; // of one, and of many
  std::string_view why;
};

constexpr cause causes[] = {
    {verdict::bad_signature, "refused_bad_signature", "frames with a wrong signature",
     "its signature is wrong: another key, or changed on the way"},
    {verdict::replayed, "refused_replayed", "replayed frames", "its timestamp is not above the last one: replayed"},
    {verdict::too_old, "refused_too_old", "signed frames from the past",
     "its timestamp is more than a minute old; are both clocks right?"},
    {verdict::too_new, "refused_too_new", "signed frames from the future",
     "its timestamp is more than two minutes ahead; are both clocks right?"},
    {verdict::unsigned_refused, "refused_unsigned", "unsigned frames", "it is not signed"},
    {verdict::too_many_streams, "refused_too_many_streams", "frames of too many signed streams",
     "there are too many signed senders and links"},
};

const cause* cause_of(verdict which) {
  for (const auto& each : causes)
    if (each.which == which)
      return &each;
  return nullptr;
}

} // namespace

signature_check::signature_check(std::optional<io::mavlink::secret_key> key)
    : streams_(std::make_unique<io::mavlink::replay_table>()),
      verifier_(key ? io::mavlink::verifier(*std::move(key), *streams_) : io::mavlink::verifier()) {}

signature_check::answer signature_check::judge(const io::mavlink::frame_view& frame, std::uint64_t time_us) {
  const auto now = io::mavlink::signing_time_at(static_cast<std::int64_t>(time_us) * 1'000);
  const auto which = verifier_.judge(frame, now);
  const auto* const why = cause_of(which);
  if (why == nullptr)
    return {};
  if (verifier_.counts().of(which) != 1)
    return {false, {}};
  return {false, "refused " + message_name(frame.id()) + " of " + std::to_string(frame.system()) + '/' +
                     std::to_string(frame.component()) + ": " + std::string(why->why) +
                     " (further ones are only counted)"};
}

std::vector<skipped> signature_check::refused() const {
  std::vector<skipped> result;
  if (verifier_.has_key())
    for (const auto& each : causes)
      result.push_back({each.key, each.words, verifier_.counts().of(each.which)});
  return result;
}

} // namespace godwit::trace_tool
