// godwit-trace bundle: what a person sends when asking for help, in one archive, without secrets.
#include <chrono>
#include <ctime>
#include <fstream>
#include <iterator>
#include <memory>
#include <system_error>

#include "io/sqlite/database.hpp"
#include "io/time_units.hpp"
#include "programs/common/control_client.hpp"
#include "programs/common/printable.hpp"
#include "programs/godwit-trace/actors/link_frames.hpp"
#include "programs/godwit-trace/bundle/bundle_plan.hpp"
#include "programs/godwit-trace/bundle/tar_writer.hpp"
#include "programs/godwit-trace/commands.hpp"
#include "programs/godwit-trace/utc_time.hpp"
#include "runtime/config/config.hpp"
#include "runtime/journal/journal_file.hpp"

namespace godwit::trace_tool {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* top = "godwit-bundle/";

struct bundle_arguments {
  std::string config;
  std::string journal;
  std::string trace;
  std::string control;
  std::vector<std::string> logs;
  std::vector<std::string> secrets;
  std::string at;
  std::string to;
};

// A file that goes away with it.
struct scratch_file {
  std::string path;
  ~scratch_file() {
    std::error_code ignored;
    fs::remove(path, ignored);
  }
};

std::string place(const json& configuration, const char* section, const char* key) {
  return configuration.at(section).at(key).get<std::string>();
}

// The defaults where no file is named.
tl::expected<json, std::string> configuration_of(const bundle_arguments& given) {
  auto read = given.config.empty() ? runtime::load_config("{}", "the defaults", runtime::godwit_schema())
                                   : runtime::load_config_file(given.config, runtime::godwit_schema());
  if (!read)
    return tl::make_unexpected(read.error().message());
  return *std::move(read);
}

void choose_paths(const json& configuration, bundle_arguments& given) {
  if (given.journal.empty())
    given.journal = place(configuration, "journal", "path");
  given.journal = runtime::journal_in_use(given.journal);
  if (given.trace.empty())
    given.trace = place(configuration, "trace", "directory");
  if (given.control.empty())
    given.control = place(configuration, "control", "path");
  if (given.control.empty())
    given.control = fs::path(given.journal).replace_extension(".control").string();
  if (const auto log = place(configuration, "log", "file"); !log.empty() && given.logs.empty())
    given.logs.push_back(log);
  for (const auto& [section, key] : {std::pair{"service", "token_file"}, std::pair{"service", "key_file"},
                                     std::pair{"vehicle", "key_file"}, std::pair{"ground", "key_file"}})
    if (const auto file = place(configuration, section, key); !file.empty())
      given.secrets.push_back(file);
}

void add_status(const bundle_arguments& given, bundle_plan& to) {
  const auto answer = control::ask_daemon(given.control, {{"do", "status"}});
  if (answer)
    to.add_text(std::string(top) + "status.json", "the status of the running godwitd",
                programs::without_secrets(*answer).dump(2, ' ', false, json::error_handler_t::replace) + "\n");
  else
    to.leave_out("status.json", answer.error());
}

void add_logs(const bundle_arguments& given, bundle_plan& to) {
  constexpr std::size_t longest_name = 60;
  std::size_t number = 0;
  for (const auto& each : given.logs) {
    auto name = fs::path(each).filename().string();
    name = name.substr(name.size() - std::min(longest_name, name.size()));
    to.add_file(top + ("logs/" + std::to_string(++number)) + "-" + name, "the log " + each, each);
  }
  if (given.logs.empty())
    to.leave_out("logs", "no file was named (--log); with systemd: journalctl -u godwitd > FILE");
}

// COPY holds it until the archive is written.
void add_journal(const bundle_arguments& given, const std::string& copy, bundle_plan& to) {
  constexpr const char* name = "journal.db";
  auto journal = runtime::open_for_reading(given.journal, {});
  if (!journal) {
    to.leave_out(name, journal.error().message());
    return;
  }
  std::ofstream(copy).close();
  std::error_code ignored;
  fs::permissions(copy, fs::perms::owner_read | fs::perms::owner_write, ignored);
  if (const auto done = io::sqlite::back_up(*journal, copy); !done)
    to.leave_out(name, given.journal + ": " + done.error().message);
  else
    to.add_file(std::string(top) + name, "a copy of " + given.journal + " as of one moment", copy);
}

void add_flight(const bundle_arguments& given, std::optional<std::int64_t> at_ns, bundle_plan& to) {
  const std::vector<std::string> paths{given.trace};
  auto files = runtime::find_trace_files(paths);
  if (!files) {
    to.leave_out("trace", files.error());
    return;
  }
  const auto runs = runs_of_flight(times_of_runs(*files), at_ns);
  if (runs.empty()) {
    to.leave_out("trace", given.trace + ": no run of godwitd is recorded " + (at_ns ? "at that time" : "there"));
    return;
  }
  std::erase_if(*files, [&](const auto& each) { return std::ranges::find(runs, each.run) == runs.end(); });
  for (const auto& each : *files)
    to.add_file(top + ("trace/" + each.path.filename().string()), "the trace of run " + std::to_string(each.run),
                each.path);
  for (const auto& each : find_link_files(*files))
    to.add_file(top + ("trace/" + each.path.filename().string()), "the " + each.link + " link", each.path);
}

std::string name_for(std::int64_t now_s) {
  const std::time_t now = now_s;
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  std::array<char, 64> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "godwit-bundle-%Y%m%dT%H%M%SZ.tar", &parts)};
}

io::mcap::result<std::uint64_t> write(const bundle_plan& plan, const std::string& file, std::int64_t now_s) {
  std::string head = "What godwit-trace " GODWIT_VERSION " put together, UTC ";
  constexpr std::int64_t us_per_s = 1'000'000;
  append_utc(head, static_cast<std::uint64_t>(now_s * us_per_s));
  head +=
      ".\nThe trace shows where somebody flew: give it to people you trust only.\n`godwit-trace flight trace/ --links` "
      "shows the flight.\n\nBytes, name, what it is:\n";
  tar_writer tar;
  auto result =
      tar.create(file, now_s).and_then([&] { return tar.add(std::string(top) + "CONTENTS.txt", plan.contents(head)); });
  for (const auto& each : plan.members())
    if (result)
      result = each.file.empty() ? tar.add(each.name, each.text) : tar.add_file(each.name, each.file, each.size_bytes);
  return result.and_then([&] { return tar.close(); }).map([&] { return tar.size_bytes(); });
}

exit_code finish(const bundle_plan& plan, const std::string& file, std::int64_t now_s, console& to) {
  for (const auto& each : plan.left_out())
    to.say("not in it: " + each);
  const auto written = write(plan, file, now_s);
  if (!written) {
    to.say(written.error().message());
    return exit_code::failed;
  }
  to.out.text() += file + ": " + std::to_string(plan.members().size() + 1) + " files, " + std::to_string(*written) +
                   " bytes; CONTENTS.txt lists them\n";
  return exit_code::ok;
}

exit_code run_bundle(bundle_arguments given, console& to) {
  std::optional<std::int64_t> at_ns;
  if (!given.at.empty()) {
    const auto at_us = parse_utc(given.at);
    if (!at_us) {
      to.say("--at: \"" + given.at + "\" is no time such as 2026-07-01T12:34:56Z");
      return exit_code::usage;
    }
    at_ns = static_cast<std::int64_t>(*at_us) * ns_per_us;
  }
  const auto configuration = configuration_of(given);
  if (!configuration) {
    to.say(configuration.error());
    return exit_code::failed;
  }
  choose_paths(*configuration, given);
  secret_guard secrets;
  bundle_plan plan(secrets);
  for (const auto& each : given.secrets)
    if (const auto added = secrets.add_file(each); !added)
      plan.leave_out("the search for its secret", added.error());
  const auto now_s =
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  const auto file = given.to.empty() ? name_for(now_s) : given.to;
  const scratch_file copy{file + ".journal"};
  if (fs::exists(file)) {
    to.say(file + ": it is there already");
    return exit_code::failed;
  }
  plan.add_text(std::string(top) + "configuration.json", "the configuration, complete with defaults, without secrets",
                programs::without_secrets(*configuration).dump(2, ' ', false, json::error_handler_t::replace) + "\n");
  add_status(given, plan);
  add_logs(given, plan);
  add_journal(given, copy.path, plan);
  add_flight(given, at_ns, plan);
  return finish(plan, file, now_s, to);
}

} // namespace

command add_bundle_command(CLI::App& to) {
  auto* const app = to.add_subcommand("bundle", "Collects what somebody needs to help, without secrets.");
  const auto given = std::make_shared<bundle_arguments>();
  app->add_option("--config", given->config, "The configuration of godwitd; it names the files below")
      ->type_name("FILE");
  app->add_option("--journal", given->journal, "The journal, if the configuration names another one")
      ->type_name("FILE");
  app->add_option("--trace", given->trace, "The trace folder, the same")->type_name("FOLDER");
  app->add_option("--control", given->control, "The control socket, the same")->type_name("FILE");
  app->add_option("--log", given->logs, "A log; may be given several times")
      ->allow_extra_args(false)
      ->type_name("FILE");
  app->add_option("--secret", given->secrets, "Nothing with the content of this file gets in; several times")
      ->allow_extra_args(false)
      ->type_name("FILE");
  app->add_option("--at", given->at, "The flight at this time instead of the newest one")->type_name("TIME");
  app->add_option("-o,--output", given->to, "The archive; it must not be there yet")->type_name("FILE.tar");
  app->footer(
      R"(In it: the configuration without secrets, the status of a running godwitd, logs, a copy of the journal, trace and
.tlog files of one flight, and CONTENTS.txt, which says what is there, what is not, and why. What holds the content of
a token or key file that the configuration names is left out. godwitd may run or not.

Examples:
  godwit-trace bundle --journal godwit.db --trace trace --log godwitd.log
  godwit-trace bundle --at 2026-07-01T12:34:56Z -o bundle.tar)");
  return {app, [given](console& into) { return run_bundle(*given, into); }};
}

} // namespace godwit::trace_tool
