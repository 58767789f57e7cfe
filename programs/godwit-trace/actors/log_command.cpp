// godwit-trace log: the deliveries one after the other; godwit-trace show: one message whole.
#include <chrono>
#include <thread>

#include <nlohmann/json.hpp>

#include "programs/godwit-trace/actors/link_frames.hpp"
#include "programs/godwit-trace/actors/text_forms.hpp"
#include "programs/godwit-trace/actors/trace_arguments.hpp"
#include "programs/godwit-trace/commands.hpp"

namespace godwit::trace_tool {

namespace {

using runtime::delivery;

struct log_arguments {
  trace_arguments trace;
  filter_arguments filter;
  link_arguments link;
  bool follow = false;
};

void append(std::string& out, const delivery& each, const runtime::name_table& names, const paint& colours,
            bool is_json) {
  if (!is_json) {
    append_line(out, each, names, colours);
    return;
  }
  append_json_line(out, each, names);
  out += '\n';
}

// Prints what is added to the trace, until it is interrupted or nobody reads any more. It reads the files and asks
// godwitd for nothing, so that it costs godwitd nothing, however slowly somebody reads.
exit_code follow_log(const log_arguments& given, console& to) {
  const auto list = [&given] {
    auto files = runtime::find_trace_files(given.trace.paths).value_or(std::vector<runtime::trace_file>{});
    if (given.trace.run)
      std::erase_if(files, [&](const auto& each) { return each.run != *given.trace.run; });
    return files;
  };
  runtime::time_span_ns since_now;
  since_now.from_ns = std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count();
  runtime::name_table names;
  runtime::trace_reader reader(list(), names, since_now);
  reader.follow(list);
  delivery_filter filter(given.filter);
  const paint colours(to.is_terminal);
  delivery each;
  for (;;) {
    while (to.out.flush_if_full() && reader.next(each))
      if (filter.wants(each, names))
        append(to.out.text(), each, names, colours, given.trace.json);
    if (!to.out.flush())
      return exit_code::ok;
    constexpr std::chrono::milliseconds between_looks{100}; // as often as godwitd writes
    std::this_thread::sleep_for(between_looks);
  }
}

exit_code run_log(const log_arguments& given, console& to) {
  if (given.follow)
    return follow_log(given, to);
  auto trace = open_trace(given.trace, to);
  if (!trace) {
    to.say(trace.error());
    return exit_code::failed;
  }
  auto frames = open_links(given.link, **trace);
  if (!frames) {
    to.say(frames.error());
    return exit_code::usage;
  }
  const auto print_frame = [&](const link_frame& frame) {
    given.trace.json ? append_frame_json_line(to.out.text(), frame) : append_frame_line(to.out.text(), frame);
  };
  delivery_filter filter(given.filter);
  const paint colours(to.is_terminal);
  delivery each;
  while (to.out.flush_if_full() && (*trace)->ordered.next(each)) {
    while (const auto frame = frames->next_until(each.run, each.began_ns)) {
      print_frame(*frame);
      to.out.flush_if_full();
    }
    if (filter.wants(each, (*trace)->names))
      append(to.out.text(), each, (*trace)->names, colours, given.trace.json);
  }
  for (auto frame = frames->next(); frame && to.out.flush_if_full(); frame = frames->next())
    print_frame(*frame);
  if (to.out.is_taken()) {
    report_losses((*trace)->reader, to);
    report_problems(*frames, to);
  }
  return exit_code::ok;
}

struct show_arguments {
  trace_arguments trace;
  std::uint64_t id = 0;
};

void append_whole(std::string& out, const delivery& each, const runtime::name_table& names, const paint& colours) {
  const auto line = [&](const char* name, const std::string& value) { out.append(name).append(value).append("\n"); };
  line("id           ", std::to_string(each.id));
  line("run          ", std::to_string(each.run));
  line("type         ", colours.type() + names.name(each.type) + colours.end());
  line("from         ", names.name(each.sender));
  line("to           ", names.name(each.actor) + ", incarnation " + std::to_string(each.incarnation));
  line("because of   ",
       each.cause == 0 ? std::string("nothing in the trace: it came from outside") : "#" + std::to_string(each.cause));
  line("began        ", utc_ns(each.began_ns));
  line("handled in   ", duration_text(each.duration_ns));
  const bool is_well = each.how == runtime::outcome::handled;
  line("ended        ",
       std::string(is_well ? "" : colours.bad()) + std::string(io::name_of(each.how)) + (is_well ? "" : colours.end()));
  if (each.oversize) {
    out += "message      (too long for the trace)\n";
    return;
  }
  const auto document = nlohmann::json::parse(each.body, nullptr, false);
  out += "message\n";
  if (document.is_discarded())
    append_printable(out, each.body);
  else
    out += document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
  out += '\n';
}

exit_code run_show(const show_arguments& given, console& to) {
  auto trace = open_trace(given.trace, to);
  if (!trace) {
    to.say(trace.error());
    return exit_code::failed;
  }
  const paint colours(to.is_terminal);
  std::size_t found = 0;
  delivery each;
  while ((*trace)->ordered.next(each)) {
    if (each.id != given.id)
      continue;
    auto& out = to.out.text();
    if (given.trace.json) {
      append_json_line(out, each, (*trace)->names);
      out += '\n';
    } else {
      out += found == 0 ? "" : "\n";
      append_whole(out, each, (*trace)->names, colours);
    }
    ++found;
  }
  report_losses((*trace)->reader, to);
  if (found == 0)
    to.say("no message has the id " + std::to_string(given.id) + " in what could be read");
  return found == 0 ? exit_code::failed : exit_code::ok;
}

} // namespace

command add_log_command(CLI::App& to) {
  auto* const app = to.add_subcommand("log", "Prints what the actors took, a line for each message, in order of time.");
  const auto given = std::make_shared<log_arguments>();
  add_trace_arguments(*app, given->trace);
  add_filter_arguments(*app, given->filter);
  add_link_arguments(*app, given->link);
  app->add_flag("--follow,-f", given->follow, "Print what is added from now on, until interrupted")
      ->excludes("--links")
      ->excludes("--from")
      ->excludes("--to");
  app->footer(
      R"(Times are UTC: 2026-07-01T12:34:56.5Z, or seconds since the first record: 90.5. A line: time, actor/incarnation,
who sent it, type, #id, the id of the message that caused it, time in the handler, how it ended if not well, message.

Examples:
  godwit-trace log trace | less -R
  godwit-trace log trace --actor executor --type 'failsafe.*,mission_client.*' --from 60 --to 90
  godwit-trace log trace --outcome crashed --json
  godwit-trace log trace --links --name 'COMMAND_*,MISSION_*' --actor vehicle_link
  godwit-trace log trace --cause 13194139533338)");
  return {app, [given](console& into) { return run_log(*given, into); }, [given] { return !given->follow; }};
}

command add_show_command(CLI::App& to) {
  auto* const app = to.add_subcommand("show", "Prints one message whole: each delivery of it.");
  const auto given = std::make_shared<show_arguments>();
  app->add_option("ID", given->id, "Its id, as `log` prints it")->required();
  add_trace_arguments(*app, given->trace);
  app->footer(R"(Ids begin again with each run: with several runs in a folder, --run chooses one.

Examples:
  godwit-trace show 13194139533338 trace --run 1)");
  return {app, [given](console& into) { return run_show(*given, into); }, always};
}

} // namespace godwit::trace_tool
