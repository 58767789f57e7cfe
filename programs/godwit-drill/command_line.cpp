#include "programs/godwit-drill/command_line.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <thread>

namespace godwit::drill {
namespace {

template <class E>
std::map<std::string, E> words_of(E) {
  std::map<std::string, E> result;
  for (const auto& [value, text] : enum_names(E{}))
    result.emplace(text, value);
  return result;
}

const char* purpose_of(flight_drill which) {
  switch (which) {
  case flight_drill::simulate:
    return "Missions of the whole daemon in virtual time, with faults and people drawn from seeds.";
  case flight_drill::interventions:
    return "Missions in virtual time in which people act within a second of godwit's orders, drawn from seeds.";
  case flight_drill::starts:
    return "Missions in virtual time whose line is cut, also one way, as an order goes out, with people, drawn from "
           "seeds.";
  case flight_drill::actors:
    return "Actors throw at each crash point, two at once, until they are given up, or hang, in each part of a flight.";
  case flight_drill::process:
    return "The process is killed at each commit of a mission, at any moment, and again and again.";
  case flight_drill::disk:
    return "The journal's disk fails, is slow, loses its power or its file at the writes of a mission.";
  case flight_drill::links:
    return "The lines to vehicle, station and service are cut or bad, the autopilot starts again, a stranger speaks.";
  case flight_drill::people:
    return "People take each vehicle in each part of a flight, again, and while godwitd is dead; or contradict "
           "themselves.";
  case flight_drill::clock:
    return "The wall clock is set in each part of a flight, and the process is suspended.";
  }
  return "";
}

void add_flight_options(CLI::App& command, flight_drill which, flight_drill_options& given) {
  command.add_option("--personality", given.who, "Fly this vehicle only: rover, px4, ardupilot or plane")
      ->transform(CLI::CheckedTransformer(words_of(sim::personality{})));
  command.add_option("--jobs", given.jobs, "How many flights at a time")
      ->capture_default_str()
      ->check(CLI::Range(1U, 256U));
  command.add_option("--json", given.json_file, "Writes the figures to this file");
  command.add_option("--html", given.html_file, "Writes a page with table, plots and failing flights to this file");
  command.add_option("--trace", given.trace_folder,
                     "Keeps what the actors of the one flight did in this folder; of several flights, those that fail");
  command.add_option("--plant", given.planted, "Every flight does this wrong, to see that it is found")
      ->transform(CLI::CheckedTransformer(words_of(planted_flaw{})));
  if (is_by_seed(which)) {
    command
        .add_option_function<std::string>(
            "--seeds", [&given](const std::string& text) { given.seeds = *seed_range_from(text); },
            "Which flights: A..B or A")
        ->default_str("1..100")
        ->check([](const std::string& text) {
          return seed_range_from(text) ? std::string() : "seeds are A..B or A, and A is not after B: " + text;
        });
    command
        .add_option_function<std::string>(
            "--shard", [&given](const std::string& text) { given.shard = *shard_from(text); },
            "Part I of N of these, to fly the others elsewhere: I/N")
        ->check([](const std::string& text) {
          return shard_from(text) ? std::string() : "a part is I/N, with I from 1 to N: " + text;
        });
    if (which == flight_drill::simulate)
      command
          .add_option("--stream-hz", given.stream_hz,
                      "Positions a second that the vehicle reports; as fast as its world")
          ->check(CLI::Range(0.1, 1000.0));
    command.add_option("--without", given.without,
                       "Leaves out fault N of each flight: 0 a bad line, 1 and up in order");
    return;
  }
  command.add_option("--only", given.only, "Flies this case and prints its events");
  command.add_option("--sample", given.sample, "Flies so many of the cases")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000}));
  command.add_option("--sample-seed", given.sample_seed, "Draws which")->capture_default_str();
}

} // namespace

void add_runtime_command(CLI::App& app, runtime_arguments& given) {
  auto* command = app.add_subcommand("runtime", "Messages through supervised actors while these are crashed.");
  command->add_option("--messages", given.messages, "How many messages")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  command->add_option("--crashes", given.crashes, "How many crashes, spread over the run")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000}));
  command->add_option("--seed", given.seed, "Draws who crashes, where and when")->capture_default_str();
  command->add_option("--config", given.config_file, "Configuration file (config/godwit.json shows the defaults)");
  command->add_option("--json", given.json_file, "Writes the counts to this file");
  command->add_option("--journal", given.journal_file,
                      "Keeps the journal as this new file: drill_effect(sender, seq) has a row for each tenth message");
  command->add_option("--trace", given.trace_folder, "Keeps the trace in this folder (MCAP files)");
}

void add_flight_commands(CLI::App& app, flight_drill_options& given, std::optional<flight_drill>& chosen) {
  given.jobs = std::max(std::thread::hardware_concurrency(), 1U);
  for (const auto& [which, name] : enum_names(flight_drill{})) {
    auto* command = app.add_subcommand(std::string(name), purpose_of(which));
    add_flight_options(*command, which, given);
    command->callback([&chosen, which = which] { chosen = which; });
  }
}

} // namespace godwit::drill
