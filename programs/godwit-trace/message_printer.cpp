#include "programs/godwit-trace/message_printer.hpp"

#include <algorithm>
#include <utility>

#include "io/fields/json_text.hpp"
#include "programs/godwit-trace/message_forms.hpp"
#include "programs/godwit-trace/utc_time.hpp"

namespace godwit::trace_tool {

namespace {

constexpr std::size_t seconds_width = 12; // 99999.999999: more than a day
constexpr std::size_t sender_width = 7;   // 255/255

void pad_to(std::string& out, std::size_t begin, std::size_t width) {
  const auto size = out.size() - begin;
  out.append(width - std::min(width, size), ' ');
}

} // namespace

void message_printer::append(std::string& out, std::uint64_t time_us, const io::mavlink::frame_view& frame) const {
  if (form_ == print_form::json) {
    append_message_json(out, time_us, frame);
  } else {
    append_head(out, time_us, frame.from());
    append_message_text(out, frame);
    out += frame.is_signed() ? " (signed)" : "";
  }
  out += '\n';
}

void message_printer::append_head(std::string& out, std::uint64_t time_us, io::mavlink::sender from) const {
  if (time_ == print_time::utc) {
    append_utc(out, time_us);
  } else {
    std::string seconds;
    append_seconds(seconds, static_cast<std::int64_t>(time_us - begin_us_));
    out.append(seconds_width - std::min(seconds_width, seconds.size()), ' ').append(seconds);
  }
  out += ' ';
  const auto begin = out.size();
  io::append_json_number(out, from.system);
  out += '/';
  io::append_json_number(out, from.component);
  pad_to(out, begin, sender_width);
  out += ' ';
}

namespace {

std::bitset<256> only(std::span<const std::uint8_t> ids) {
  std::bitset<256> result;
  for (const auto each : ids)
    result.set(each);
  return ids.empty() ? result.set() : result;
}

} // namespace

message_filter::message_filter(name_filter names, std::span<const std::uint8_t> systems,
                               std::span<const std::uint8_t> components)
    : names_(std::move(names)), systems_(only(systems)), components_(only(components)) {}

void add_print_options(CLI::App& command, print_arguments& to) {
  command.add_flag("--json", to.json, "One JSON object a line instead of text; with --stats one object");
  command.add_flag("--stats", to.stats, "Tables of what was heard instead of messages: counts, rates, losses");
  command
      .add_option("--name", to.names,
                  "Only messages with these names, such as HEARTBEAT,MISSION_*; may be given several times")
      ->allow_extra_args(false)
      ->type_name("NAME,...");
  command.add_option("--system", to.systems, "Only from this system (0 to 255); may be given several times")
      ->allow_extra_args(false)
      ->type_name("N");
  command.add_option("--component", to.components, "Only from this component (0 to 255); may be given several times")
      ->allow_extra_args(false)
      ->type_name("N");
}

tl::expected<print_options, std::string> read(const print_arguments& given) {
  auto names = name_filter::parse(given.names);
  if (!names)
    return tl::make_unexpected("--name: " + names.error());
  return print_options{message_filter(*std::move(names), given.systems, given.components),
                       given.json ? print_form::json : print_form::text, given.stats};
}

} // namespace godwit::trace_tool
