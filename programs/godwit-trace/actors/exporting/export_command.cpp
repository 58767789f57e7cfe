// godwit-trace export: a trace in the forms of other programs.
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "programs/godwit-trace/actors/exporting/export_format.hpp"
#include "programs/godwit-trace/actors/trace_arguments.hpp"
#include "programs/godwit-trace/commands.hpp"

namespace godwit::trace_tool {

namespace {

struct format {
  const char* name;
  make_exporter make;
  std::uint64_t limit; // what the programs that read it still bear
};

constexpr std::array<format, 5> formats{{{"perfetto", make_perfetto, 500'000},
                                         {"mermaid", make_sequence, 300},
                                         {"graphviz", make_graph, 1'000},
                                         {"csv", make_csv, UINT64_MAX},
                                         {"html", make_html_report, 20'000}}};

struct export_arguments {
  trace_arguments trace;
  filter_arguments filter;
  std::string form = "perfetto";
  std::string file;
  std::uint64_t limit = 0; // 0: that of the format
};

exit_code export_to(const export_arguments& given, console& to, output& out) {
  auto trace = open_trace(given.trace, to);
  if (!trace) {
    to.say(trace.error());
    return exit_code::failed;
  }
  const auto* chosen = formats.data();
  for (const auto& each : formats)
    if (given.form == each.name)
      chosen = &each;
  const auto limit = given.limit == 0 ? chosen->limit : given.limit;
  const auto made = chosen->make((*trace)->names, limit);
  delivery_filter filter(given.filter);
  made->begin(out.text());
  runtime::delivery each;
  while (out.flush_if_full() && (*trace)->ordered.next(each))
    if (filter.wants(each, (*trace)->names))
      made->take(out.text(), each);
  made->end(out.text());
  out.flush();
  report_losses((*trace)->reader, to);
  if (made->left_out() > 0)
    to.say("left out, because " + std::to_string(limit) + " is the bound of " + given.form + ": " +
           std::to_string(made->left_out()) + "; --from, --to and --actor choose a part, --limit raises the bound");
  return exit_code::ok;
}

exit_code run_export(const export_arguments& given, console& to) {
  if (given.file.empty())
    return export_to(given, to, to.out);
  constexpr mode_t private_file = 0600; // a trace tells where somebody flew
  const int file = ::open(given.file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, private_file);
  if (file < 0 && errno == ELOOP) {
    to.say(given.file + ": is a symbolic link, which is not followed; name the file itself");
    return exit_code::failed;
  }
  if (file < 0) {
    to.say(given.file + ": " + std::generic_category().message(errno));
    return exit_code::failed;
  }
  auto code = exit_code::failed;
  std::string failure;
  {
    output out(file);
    code = export_to(given, to, out);
    failure = out.failure();
  }
  if (::close(file) != 0 && failure.empty())
    failure = std::generic_category().message(errno);
  if (!failure.empty()) {
    to.say(given.file + ": " + failure);
    return exit_code::failed;
  }
  return code;
}

} // namespace

command add_export_command(CLI::App& to) {
  auto* const app = to.add_subcommand("export", "Writes the trace in the form of another program.");
  const auto given = std::make_shared<export_arguments>();
  add_trace_arguments(*app, given->trace);
  app->remove_option(app->get_option("--json"));
  add_filter_arguments(*app, given->filter);
  std::vector<std::string> names;
  for (const auto& each : formats)
    names.emplace_back(each.name);
  app->add_option("--format", given->form, "perfetto (Chrome's JSON), mermaid, graphviz, csv or html")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  app->add_option("--output,-o", given->file, "Into this file instead of the standard output")->type_name("FILE");
  app->add_option("--limit", given->limit, "At most so many messages (graphviz: edges)")->type_name("N");
  app->footer(R"(What does not fit the bound of a format is left out, and said.

Examples:
  godwit-trace export trace -o flight.json               # open it at https://ui.perfetto.dev
  godwit-trace export trace --format html -o flight.html # one page, needs no network
  godwit-trace export trace --format graphviz | dot -Tsvg > actors.svg
  godwit-trace export trace --format mermaid --from 2 --to 2.2 --actor executor,vehicle_link
  godwit-trace export trace --format csv --type GLOBAL_POSITION_INT --actor failsafe)");
  return {app, [given](console& into) { return run_export(*given, into); }};
}

} // namespace godwit::trace_tool
