// godwit-drill: crash-recovery drills. See `godwit-drill --help`.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "programs/godwit-drill/report.hpp"
#include "programs/godwit-drill/runtime_drill.hpp"
#include "programs/godwit-drill/scratch_folder.hpp"
#include "runtime/config/config.hpp"
#include "runtime/process.hpp"

namespace {

using namespace godwit;
using runtime::exit_code;

struct arguments {
  std::uint64_t messages = 1'000'000;
  std::uint64_t crashes = 1'000;
  std::uint64_t seed = 1;
  std::string config_file;
  std::string json_file;
  std::string journal_file;
  std::string trace_folder;
};

int fail(exit_code code, const std::string& what) {
  std::fprintf(stderr, "godwit-drill: %s\n", what.c_str());
  return static_cast<int>(code);
}

int run_runtime(const arguments& given) {
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
  CLI::App app{"Crash-recovery drills: makes actors crash and counts what was lost or done twice."};
  app.require_subcommand(1);
  arguments given;
  auto* runtime_command = app.add_subcommand("runtime", "Messages through supervised actors while these are crashed.");
  runtime_command->add_option("--messages", given.messages, "How many messages")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  runtime_command->add_option("--crashes", given.crashes, "How many crashes, spread over the run")
      ->capture_default_str()
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000}));
  runtime_command->add_option("--seed", given.seed, "Draws who crashes, where and when")->capture_default_str();
  runtime_command->add_option("--config", given.config_file,
                              "Configuration file (config/godwit.json shows the defaults)");
  runtime_command->add_option("--json", given.json_file, "Writes the counts to this file");
  runtime_command->add_option(
      "--journal", given.journal_file,
      "Keeps the journal as this new file: drill_effect(sender, seq) has a row for each tenth message");
  runtime_command->add_option("--trace", given.trace_folder, "Keeps the trace in this folder (MCAP files)");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0)
      return app.exit(error);
    std::fprintf(stderr, "godwit-drill: %s\n\n%s", error.what(), app.help().c_str());
    return static_cast<int>(exit_code::usage);
  }
  return run_runtime(given);
}
