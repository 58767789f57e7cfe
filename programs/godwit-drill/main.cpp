// godwit-drill: crash-recovery drills. See `godwit-drill --help`.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "programs/godwit-drill/command_line.hpp"
#include "programs/godwit-drill/flights/flight_drill.hpp"
#include "programs/godwit-drill/runtime_drill.hpp"
#include "programs/godwit-drill/scratch_folder.hpp"
#include "runtime/config/config.hpp"
#include "runtime/process.hpp"

namespace {

using namespace godwit;
using runtime::exit_code;

int fail(exit_code code, const std::string& what) {
  std::fprintf(stderr, "godwit-drill: %s\n", what.c_str());
  return static_cast<int>(code);
}

int run_runtime(const drill::runtime_arguments& given) {
  auto configuration = given.config_file.empty()
                           ? runtime::load_config("{}", "defaults", runtime::godwit_schema())
                           : runtime::load_config_file(given.config_file, runtime::godwit_schema());
  if (!configuration)
    return fail(exit_code::usage, configuration.error().message());
  const drill::scratch_folder scratch;
  if (scratch.path().empty())
    return fail(exit_code::failed, "no folder can be made in " + std::filesystem::temp_directory_path().string() +
                                       "; set TMPDIR to a folder that can be written");
  drill::runtime_drill_options options;
  options.messages = given.messages;
  options.crashes = given.crashes;
  options.seed = given.seed;
  options.process = runtime::options_from(*configuration);
  options.process.journal.path =
      given.journal_file.empty() ? (scratch.path() / "drill.db").string() : given.journal_file;
  options.process.trace->folder =
      given.trace_folder.empty() ? scratch.path() / "trace" : std::filesystem::path(given.trace_folder);
  options.process.trace->program = "godwit-drill";

  std::printf("%llu messages through supervised actors, %llu crashes, seed %llu\n",
              static_cast<unsigned long long>(given.messages), static_cast<unsigned long long>(given.crashes),
              static_cast<unsigned long long>(given.seed));
  std::fflush(stdout);
  const auto result = drill::run_runtime_drill(std::move(options));
  if (!result)
    return fail(exit_code::failed, result.error());
  std::printf("%s", drill::to_table(*result).c_str());
  if (!given.json_file.empty()) {
    std::ofstream out(given.json_file);
    out << drill::to_json(*result, given.seed).dump(2) << '\n';
    if (!out.flush())
      return fail(exit_code::failed, given.json_file + " can not be written");
  }
  if (!result->passed())
    return fail(exit_code::failed, "FAILED: messages or effects were lost or doubled; run it again with --seed " +
                                       std::to_string(given.seed));
  std::printf("passed: nothing lost, nothing doubled\n");
  return static_cast<int>(exit_code::ok);
}

} // namespace

int main(int argc, char** argv) {
  CLI::App app{"Drills: makes actors and whole flights of godwitd fail, and counts what was lost or done twice."};
  app.require_subcommand(1);
  drill::runtime_arguments runtime_given;
  drill::flight_drill_options flights;
  std::optional<drill::flight_drill> chosen;
  drill::add_runtime_command(app, runtime_given);
  drill::add_flight_commands(app, flights, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0)
      return app.exit(error);
    std::fprintf(stderr, "godwit-drill: %s\n\n%s", error.what(), app.help().c_str());
    return static_cast<int>(exit_code::usage);
  }
  if (!chosen)
    return run_runtime(runtime_given);
  flights.which = *chosen;
  return drill::run_flight_drill(flights);
}
