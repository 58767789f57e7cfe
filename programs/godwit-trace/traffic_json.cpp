#include "io/fields/json_text.hpp"
#include "programs/godwit-trace/message_name.hpp"
#include "programs/godwit-trace/traffic.hpp"

namespace godwit::trace_tool {

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

} // namespace godwit::trace_tool
