#include "programs/godwit-trace/print_options.hpp"

#include <utility>

namespace godwit::trace_tool {

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
