#include "programs/godwit-trace/replay/replay_text.hpp"

#include <algorithm>

#include "io/fields/json_text.hpp"

namespace godwit::trace_tool {

namespace {

using runtime::bench_sending;
using runtime::deviation;
using runtime::deviation_kind;
using runtime::recorded_message;

constexpr std::size_t most_of_message = 400; // bytes of a message that are shown

std::string_view title_of(deviation_kind kind) {
  switch (kind) {
  case deviation_kind::differs:
    return "sends something else";
  case deviation_kind::not_sent:
    return "does not send what it sent then";
  case deviation_kind::not_recorded:
    return "sends what it did not send then";
  case deviation_kind::not_done:
    return "does not take or do beside messages what it did then";
  case deviation_kind::crashes:
    return "crashes";
  case deviation_kind::crashed:
    return "does not crash as it did then";
  case deviation_kind::can_not_take:
    return "can not take it";
  }
  return {};
}

void append_body(std::string& out, std::string_view body) {
  append_printable(out, body.substr(0, most_of_message));
  if (body.size() > most_of_message)
    out += " ...";
}

void append_input(std::string& out, const recorded_message& input) {
  append_utc_ns(out, input.began_ns);
  out += ' ' + input.receiver + '/' + std::to_string(input.incarnation) + " <- " + input.sender + ' ' + input.type +
         " #" + std::to_string(input.id) + ' ';
  append_body(out, input.body);
  out += '\n';
}

void append_sent(std::string& out, std::string_view mark, const std::string& to, std::string_view type,
                 const std::string& body) {
  out.append("  ").append(mark).append(" -> ").append(to).append(" ").append(type).append(" ");
  append_body(out, body);
  out += '\n';
}

std::string counted(std::size_t n, const std::string& what) {
  return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s");
}

} // namespace

void append_deviation(std::string& out, const deviation& what, const paint& colours) {
  out.append(colours.bad()).append(what.input->receiver).append(" ").append(title_of(what.kind)).append(colours.end());
  out += what.what.empty() ? ", at\n" : ": " + what.what + "\nat\n";
  append_input(out, *what.input);
  if (what.expected != nullptr)
    append_sent(out, "expected", what.expected->receiver, what.expected->type, what.expected->body);
  if (what.produced)
    append_sent(out, "produced", what.produced->to, what.produced->type, what.produced->body);
  for (const auto& each : what.fields) {
    out += "  " + (each.field.empty() ? std::string("the whole") : each.field) + ": expected ";
    append_body(out, each.expected.empty() ? "nothing" : each.expected);
    out += ", produced ";
    append_body(out, each.produced.empty() ? "nothing" : each.produced);
    out += '\n';
  }
}

void append_deviation_json(std::string& out, const deviation& what) {
  out += R"({"kind":")";
  out += io::name_of(what.kind);
  out += R"(","input":)" + std::to_string(what.input->id) + R"(,"incarnation":)" +
         std::to_string(what.input->incarnation) + R"(,"time_ns":)" + std::to_string(what.input->began_ns);
  append_member(out, "type", what.input->type);
  append_member(out, "sender", what.input->sender);
  if (!what.what.empty())
    append_member(out, "what", what.what);
  if (what.expected != nullptr) {
    append_member(out, "expected_to", what.expected->receiver);
    append_member(out, "expected_type", what.expected->type);
    out += R"(,"expected":)" + (what.expected->body.empty() ? "null" : what.expected->body);
  }
  if (what.produced) {
    append_member(out, "produced_to", what.produced->to);
    append_member(out, "produced_type", what.produced->type);
    out += R"(,"produced":)" + what.produced->body;
  }
  out += R"(,"fields":[)";
  for (const auto& each : what.fields) {
    out += &each == what.fields.data() ? "{\"field\":" : ",{\"field\":";
    io::append_json_string(out, each.field);
    out += R"(,"expected":)" + (each.expected.empty() ? "null" : each.expected) + R"(,"produced":)" +
           (each.produced.empty() ? "null" : each.produced) + '}';
  }
  out += "]}\n";
}

void append_step(std::string& out, const runtime::replay_step& step, const paint& colours) {
  append_input(out, *step.input);
  if (step.is_same) {
    if (step.produced != nullptr)
      for (const auto& each : step.produced->sent)
        append_sent(out, "=", each.to, each.type, each.body);
    return;
  }
  out += colours.bad();
  for (const auto* each : step.expected)
    append_sent(out, "-", each->receiver, each->type, each->body);
  if (step.produced != nullptr)
    for (const auto& each : step.produced->sent)
      append_sent(out, "+", each.to, each.type, each.body);
  out += colours.end();
}

std::string summary_text(const runtime::replay_summary& summary) {
  std::string out = counted(summary.inputs, "input") + " of " + counted(summary.incarnations, "incarnation") +
                    " replayed, " + counted(summary.compared, "message") + " compared";
  if (summary.unconfirmed > 0)
    out += "; " + counted(summary.unconfirmed, "message") + " sent that nobody is known to have taken";
  if (summary.crashes > 0)
    out += "; " + std::to_string(summary.crashes) + (summary.crashes == 1 ? " crash" : " crashes") + " as then";
  if (summary.planned_crashes > 0)
    out += "; " + std::to_string(summary.planned_crashes) +
           " handlers left out that a test made crash, or that were replaced";
  if (summary.inputs_left_out > 0)
    out += "; left out: " + counted(summary.inputs_left_out, "input");
  return out;
}

} // namespace godwit::trace_tool
