#include "programs/godwit-trace/actors/trace_arguments.hpp"

#include <algorithm>

#include <unistd.h>

#include "io/fields/field_table.hpp"
#include "io/time_units.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"
#include "programs/godwit-trace/name_filter.hpp"
#include "programs/godwit-trace/utc_time.hpp"

namespace godwit::trace_tool {

namespace {

using runtime::time_span_ns;
using runtime::trace_file;

constexpr std::size_t max_losses_said = 10;

// The time of the first delivery; 0 if there is none.
std::int64_t begin_of(const std::vector<trace_file>& files) {
  runtime::name_table names;
  runtime::trace_reader reader(files, names);
  runtime::delivery first;
  return reader.next(first) ? first.began_ns : 0;
}

tl::expected<std::int64_t, std::string> point_in_time(const char* option, const std::string& text,
                                                      const std::vector<trace_file>& files) {
  const auto mark = parse_time_mark(text);
  if (!mark)
    return tl::unexpected(option + (": " + mark.error()));
  const auto at_ns = static_cast<std::int64_t>(mark->time_us) * ns_per_us;
  return mark->is_since_begin ? begin_of(files) + at_ns : at_ns;
}

// A line that is drawn over itself, for who waits in front of a terminal.
void show_progress(console& to, std::uint64_t done, std::uint64_t all) {
  if (all == 0)
    return;
  constexpr std::uint64_t percent = 100;
  auto& text = to.words.text();
  text += done >= all ? "\r\x1b[K" : "\rreading: " + std::to_string(done * percent / all) + " %\x1b[K";
  to.words.flush();
}

} // namespace

void add_trace_arguments(CLI::App& command, trace_arguments& to) {
  command.add_option("TRACE", to.paths, "The trace folder of godwitd, the folder above it, or files (.mcap)")
      ->required();
  command.add_option("--from", to.from, "From this time on")->type_name("TIME");
  command.add_option("--to", to.to, "Before this time")->type_name("TIME");
  command.add_option("--run", to.run, "Only this start of godwitd (the first number in the names of the files)")
      ->type_name("N");
  command.add_flag("--json", to.json, "JSON for other programs instead of text");
}

tl::expected<std::unique_ptr<opened_trace>, std::string> open_trace(const trace_arguments& given, console& to) {
  auto files = runtime::find_trace_files(given.paths);
  if (!files)
    return tl::unexpected(files.error());
  if (given.run)
    std::erase_if(*files, [&](const trace_file& each) { return each.run != *given.run; });
  if (files->empty())
    return tl::unexpected("there is no segment of run " + std::to_string(given.run.value_or(0)));
  time_span_ns span;
  if (!given.from.empty()) {
    const auto from = point_in_time("--from", given.from, *files);
    if (!from)
      return tl::unexpected(from.error());
    span.from_ns = *from;
  }
  if (!given.to.empty()) {
    const auto until = point_in_time("--to", given.to, *files);
    if (!until)
      return tl::unexpected(until.error());
    span.to_ns = *until;
  }
  auto result = std::make_unique<opened_trace>(*std::move(files), span);
  if (!to.is_terminal && ::isatty(STDERR_FILENO) != 0)
    result->reader.on_progress([&to](std::uint64_t done, std::uint64_t all) { show_progress(to, done, all); });
  return result;
}

void report_losses(const runtime::trace_reader& reader, console& to) {
  to.out.flush();
  const auto& losses = reader.losses();
  for (std::size_t n = 0; n < losses.size() && n < max_losses_said; ++n)
    to.say(loss_sentence(losses[n]));
  const auto more = losses.size() - std::min(losses.size(), max_losses_said) + reader.losses_not_kept();
  if (more > 0)
    to.say("there are " + std::to_string(more) + " more places like these");
}

void add_filter_arguments(CLI::App& command, filter_arguments& to) {
  const auto add = [&command](const char* option, std::vector<std::string>& list, const char* help) {
    return command.add_option(option, list, help)->delimiter(',')->allow_extra_args(false)->type_name("NAME,...");
  };
  add("--actor", to.actors, "Only what these actors took, such as executor,vehicle_*");
  add("--sender", to.senders, "Only what these actors sent");
  add("--type", to.types, "Only these types of message, such as HEARTBEAT,failsafe.*");
  std::vector<std::string> outcomes;
  for (const auto& [value, text] : enum_names(runtime::outcome{}))
    outcomes.emplace_back(text);
  add("--outcome", to.outcomes, "Only what ended so")->check(CLI::IsMember(outcomes));
  command.add_option("--text", to.text, "Only messages in which this text stands, as the trace has it (JSON)");
  command.add_option("--cause", to.cause, "Only what was sent because of this message")->type_name("ID");
}

bool delivery_filter::is_one_of(const std::vector<std::string>& patterns, std::uint32_t number,
                                const runtime::name_table& names, answers& known) {
  if (patterns.empty())
    return true;
  if (known.size() <= number)
    known.resize(number + 1, answer::unknown);
  auto& said = known[number];
  if (said == answer::unknown)
    said = std::ranges::any_of(patterns, [&](const auto& each) { return matches(each, names.name(number)); })
               ? answer::yes
               : answer::no;
  return said == answer::yes;
}

bool delivery_filter::wants(const runtime::delivery& each, const runtime::name_table& names) {
  return (!wanted_.cause || each.cause == *wanted_.cause) && is_one_of(wanted_.actors, each.actor, names, actors_) &&
         is_one_of(wanted_.senders, each.sender, names, senders_) &&
         is_one_of(wanted_.types, each.type, names, types_) &&
         (wanted_.outcomes.empty() || std::ranges::count(wanted_.outcomes, io::name_of(each.how)) > 0) &&
         (wanted_.text.empty() || each.body.find(wanted_.text) != std::string_view::npos);
}

} // namespace godwit::trace_tool
