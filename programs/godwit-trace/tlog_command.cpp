#include <memory>
#include <optional>
#include <string>

#include "programs/godwit-trace/commands.hpp"
#include "programs/godwit-trace/tlog_run.hpp"

namespace godwit::trace_tool {

namespace {

struct tlog_arguments {
  std::string file;
  print_arguments print;
  bool relative = false;
  std::string from;
  std::string to;
};

constexpr const char* tlog_examples =
    R"(Times are UTC as the writer of the log had it: 2026-07-01T12:34:56.5Z, or seconds since its first record: 90.5.

Examples:
  godwit-trace tlog flight.tlog | less
  godwit-trace tlog flight.tlog --name 'COMMAND_*,MISSION_*,STATUSTEXT' --relative
  godwit-trace tlog flight.tlog --name HEARTBEAT --system 1 --from 60 --to 120
  godwit-trace tlog flight.tlog --json | jq -r 'select(.name == "VFR_HUD") | .fields.alt'
  godwit-trace tlog flight.tlog --stats)";

tl::expected<std::optional<time_mark>, std::string> read_mark(const char* option, const std::string& text) {
  if (text.empty())
    return std::nullopt;
  const auto mark = parse_time_mark(text);
  if (!mark)
    return tl::make_unexpected(option + (": " + mark.error()));
  return *mark;
}

tl::expected<tlog_options, std::string> read(const tlog_arguments& given) {
  tlog_options options;
  options.file = given.file;
  options.time = given.relative ? print_time::since_begin : print_time::utc;
  const auto print = read(given.print);
  const auto from = read_mark("--from", given.from);
  const auto to = read_mark("--to", given.to);
  if (!print)
    return tl::make_unexpected(print.error());
  if (!from || !to)
    return tl::make_unexpected(from ? to.error() : from.error());
  options.print = *print;
  options.range = {*from, *to};
  return options;
}

} // namespace

command add_tlog_command(CLI::App& to) {
  auto* const app = to.add_subcommand("tlog", "Prints the messages of a MAVLink log (.tlog).");
  const auto given = std::make_shared<tlog_arguments>();
  app->add_option("FILE", given->file, "The log, as QGroundControl, MAVProxy, pymavlink and godwit write it")
      ->required();
  add_print_options(*app, given->print);
  app->add_flag("--relative", given->relative, "Seconds since the first record instead of UTC");
  app->add_option("--from", given->from, "From this time on")->type_name("TIME");
  app->add_option("--to", given->to, "Before this time")->type_name("TIME");
  app->footer(tlog_examples);
  return {app, [given](console& into) {
            const auto options = read(*given);
            if (!options) {
              into.say(options.error());
              return exit_code::usage;
            }
            return run_tlog(*options, into);
          }};
}

} // namespace godwit::trace_tool
