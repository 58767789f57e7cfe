// godwit-trace replay: what an actor took is handed to it again, and what it does is held against what it did.
#include <algorithm>
#include <charconv>

#include "programs/godwit-trace/actors/trace_arguments.hpp"
#include "programs/godwit-trace/commands.hpp"
#include "programs/godwit-trace/replay/flight_bench.hpp"
#include "programs/godwit-trace/replay/recorded_settings.hpp"
#include "programs/godwit-trace/replay/replay_text.hpp"
#include "runtime/replay/replayer.hpp"

namespace godwit::trace_tool {

namespace {

struct replay_arguments {
  std::string actor;
  trace_arguments trace;
  std::string settings_file;
  std::uint64_t until = 0;
  std::int64_t tolerance_ms = 20;
  bool step = false;
  bool all = false;
};

constexpr std::size_t max_deviations_shown = 1'000;

template <class N>
N number_in(const std::map<std::string, std::string>& about, const std::string& name) {
  N result = 0;
  if (const auto found = about.find(name); found != about.end())
    (void)std::from_chars(found->second.data(), found->second.data() + found->second.size(), result);
  return result;
}

// What all runs came to.
struct replay_end {
  bool has_replayed = false;
  bool has_deviated = false;
  bool has_failed = false;
};

void print_summary(const replay_arguments& given, std::uint64_t run, const runtime::replay_summary& found,
                   console& to) {
  const paint colours(to.is_terminal);
  auto& out = to.out.text();
  for (const auto& each : found.deviations) {
    if (given.trace.json)
      append_deviation_json(out, each);
    else
      append_deviation(out, each, colours);
  }
  if (!given.trace.json)
    out += "run " + std::to_string(run) + ": " + given.actor + ": " + summary_text(found) + "; " +
           (found.deviations.empty()       ? std::string(found.incarnations > 0 ? "no deviation" : "nothing is known")
            : found.deviations.size() == 1 ? std::string("it deviates")
                                           : std::to_string(found.deviations.size()) + " deviations") +
           '\n';
  to.out.flush();
  for (const auto& each : found.notes)
    to.say("run " + std::to_string(run) + ", " + each);
}

void replay_run(const replay_arguments& given, const opened_trace& trace, std::uint64_t run,
                runtime::recorded_run& record, replay_end& end, console& to) {
  record.finish();
  const auto& about = trace.reader.about(run);
  const auto refuse = [&](const std::string& why) {
    to.say("run " + std::to_string(run) + ": " + why);
    end.has_failed = true;
  };
  const auto settings = recorded_settings(about, given.settings_file);
  if (!settings)
    return refuse(settings.error());
  const auto bench = flight_bench::make(given.actor, *settings, {run, number_in<std::uint64_t>(about, "seed")});
  if (!bench)
    return refuse(bench.error());
  if (record.inputs().empty())
    return refuse(given.actor + " has taken nothing in what could be read");
  runtime::replay_options options;
  options.tolerance_ns = given.tolerance_ms * 1'000'000;
  options.until = given.until;
  options.max_deviations = given.all ? max_deviations_shown : 1;
  options.monotonic_to_utc_ns = number_in<std::int64_t>(about, "monotonic_to_utc_ns");
  const paint colours(to.is_terminal);
  const auto found = runtime::replayer((*bench)->bench(), record, options).run([&](const runtime::replay_step& step) {
    if (!given.step || given.trace.json)
      return;
    append_step(to.out.text(), step, colours);
    to.out.flush_if_full();
  });
  print_summary(given, run, found, to);
  end.has_replayed = end.has_replayed || found.incarnations > 0;
  end.has_deviated = end.has_deviated || !found.deviations.empty();
}

exit_code run_replay(const replay_arguments& given, console& to) {
  auto trace = open_trace(given.trace, to);
  if (!trace) {
    to.say(trace.error());
    return exit_code::failed;
  }
  replay_end end;
  std::optional<runtime::recorded_run> record;
  std::uint64_t run = 0;
  runtime::delivery each;
  while ((*trace)->ordered.next(each)) {
    if (record && each.run != run) {
      replay_run(given, **trace, run, *record, end, to);
      record.reset();
    }
    run = each.run;
    if (!record)
      record.emplace(given.actor, (*trace)->names);
    record->add(each);
  }
  if (record)
    replay_run(given, **trace, run, *record, end, to);
  report_losses((*trace)->reader, to);
  if (std::ranges::any_of((*trace)->reader.losses(), &runtime::loss::is_hole) && end.has_deviated)
    to.say("records are missing in between: what deviates may come of that");
  if (!end.has_replayed && !end.has_failed)
    to.say("nothing was replayed");
  return end.has_deviated || end.has_failed || !end.has_replayed ? exit_code::failed : exit_code::ok;
}

} // namespace

command add_replay_command(CLI::App& to) {
  auto* const app =
      to.add_subcommand("replay", "Feeds an actor its recorded input again, and shows where its output differs.");
  const auto given = std::make_shared<replay_arguments>();
  app->add_option("ACTOR", given->actor, "An actor of godwitd: executor, failsafe, vehicle_link, ...")->required();
  add_trace_arguments(*app, given->trace);
  app->add_option("--until", given->until, "Up to the message with this id")->type_name("ID");
  app->add_flag("--step", given->step, "Prints each message and what the actor sent of it");
  app->add_flag("--all", given->all, "Continues after the first difference");
  constexpr std::int64_t most_ms = 60'000;
  app->add_option("--tolerance", given->tolerance_ms, "Milliseconds by which times in messages may differ")
      ->check(CLI::Range(std::int64_t{0}, most_ms))
      ->capture_default_str();
  app->add_option("--settings", given->settings_file, "A configuration in place of that of the record")
      ->type_name("FILE");
  app->footer(R"(Examples:
  godwit-trace replay failsafe trace
  godwit-trace replay executor trace --run 3 --until 6597069766912 --step
Exit codes: 0 it does the same, 1 it does not, or that could not be found out, 2 a mistake on the command line.)");
  return {app, [given](console& into) { return run_replay(*given, into); }, always};
}

} // namespace godwit::trace_tool
