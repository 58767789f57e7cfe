#include "programs/godwitd/program.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <random>
#include <string>
#include <system_error>

#include "actors/domain/mission/utc_text.hpp"
#include "io/fields/field_table.hpp"
#include "io/fields/json_text.hpp"
#include "messages/mission/item_fields.hpp"
#include "programs/common/control_client.hpp"
#include "programs/common/printable.hpp"
#include "programs/godwitd/accounts/password.hpp"
#include "programs/godwitd/checks/config_check.hpp"
#include "programs/godwitd/checks/restart_check.hpp"
#include "programs/godwitd/command_line.hpp"
#include "programs/godwitd/configuration.hpp"
#include "programs/godwitd/console.hpp"
#include "programs/godwitd/doctor/doctor.hpp"
#include "programs/godwitd/outbox_listing.hpp"
#include "programs/godwitd/settings.hpp"
#include "programs/godwitd/status_text.hpp"

namespace godwit::daemon {
namespace {

using runtime::exit_code;
using json = nlohmann::json;

exit_code fail(exit_code code, const std::string& sentence) {
  say(sentence);
  return code;
}

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

std::int64_t wall_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

exit_code list_outbox(const json& configuration, bool as_json) {
  const auto listing = read_outbox(runtime::journal_in_use(journal_path(configuration)));
  if (!listing)
    return fail(exit_code::failed, listing.error());
  const auto now_ns = wall_ns();
  print(as_json ? json_of(*listing, now_ns).dump(2, ' ', false, json::error_handler_t::replace) + "\n"
                : table_of(*listing, now_ns));
  return exit_code::ok;
}

exit_code check_config(const json& configuration, const daemon_settings& wanted) {
  for (const auto& each : doctor::examine_host(configuration)) // they keep it from flying, not from starting
    if (each.how == doctor::grade::problem)
      say(each.subject + ": " + each.sentence + " " + each.remedy);
  const auto problems = problems_of(wanted);
  for (const auto& each : problems)
    say(each);
  if (!problems.empty())
    return exit_code::usage;
  print("the configuration can be used\n");
  return exit_code::ok;
}

exit_code examine(const json& configuration, std::chrono::seconds patience, bool as_json) {
  const auto found = doctor::examine(configuration, patience);
  print(as_json ? doctor::json_of(found).dump(2, ' ', false, json::error_handler_t::replace) + "\n"
                : doctor::text_of(found));
  return doctor::has_problem(found) ? exit_code::failed : exit_code::ok;
}

exit_code may_restart(const json& configuration) {
  if (const auto why_not = why_not_restart(configuration); !why_not.empty())
    return fail(exit_code::failed, programs::printable(why_not) + "; stop or exchange godwitd after it");
  print("no flight is under way: godwitd may be stopped or exchanged\n");
  return exit_code::ok;
}

exit_code ask_running(const json& configuration, const json& question, bool as_json,
                      std::string (*text)(const json& answer)) {
  const auto answer = control::ask_daemon(control_path(configuration), question);
  if (!answer)
    return fail(exit_code::failed, answer.error());
  const bool is_done = answer->value("ok", false);
  if (as_json)
    print(answer->dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
  else if (is_done)
    print(programs::printable(text(shown_answer(*answer)), "") + "\n");
  else
    say(programs::printable(answer->value("error", std::string("refused"))));
  return is_done ? exit_code::ok : exit_code::failed;
}

std::string rescued_text(const json& answer) {
  return "the journal is written to " + answer.value("file", std::string());
}

std::string taken_text(const json& answer) {
  const auto advice = answer.value("advice", std::string());
  return advice.empty() ? "done" : "done; " + advice;
}

std::string sent_text(const json&) {
  return "sent; autopilots do not answer it: `godwitd ctl status` shows whether the vehicle signs";
}

// Who says it, as far as the system tells: the socket is open to nobody else than the user of the daemon.
std::string speaker() {
  for (const auto* name : {"SUDO_USER", "USER", "LOGNAME"})
    if (const char* user = std::getenv(name); user != nullptr && *user != '\0') // NOLINT(concurrency-mt-unsafe): alone
      return user;
  return "the operator";
}

std::string fresh_id() {
  std::random_device source;
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "ctl-%08x%08x", source(), source());
  return text.data();
}

// Whoever waits no longer than `patience` does not want it obeyed later.
json question_of(const operators::command& said, std::uint64_t point) {
  json result{{"do", io::name_of(said.kind)},
              {"by", speaker()},
              {"id", fresh_id()},
              {"valid_until_ns", wall_ns() + std::chrono::nanoseconds(control::patience).count()}};
  if (point != 0) {
    result["point"] = point;
    result["altitude_m"] = said.place->altitude_m;
  }
  if (said.kind == operators::command_kind::acknowledge)
    result["report"] = said.report;
  if (said.place && point == 0)
    result["place"] = json::parse(io::to_json(*said.place));
  if (!said.after.empty())
    result["after"] = said.after;
  return result;
}

// The link is made here and never goes over the socket: what it is known by does.
exit_code make_link(const json& configuration, bool as_json) {
  const auto link = accounts::new_token();
  const auto answer = control::ask_daemon(
      control_path(configuration),
      {{"do", "login"}, {"by", speaker()}, {"link_hash", accounts::hash_of_token(link.revealed())}});
  if (!answer)
    return fail(exit_code::failed, answer.error());
  if (!answer->value("ok", false))
    return fail(exit_code::failed, programs::printable(answer->value("error", std::string("refused"))));
  const auto until =
      mission::utc_text(answer->value("valid_until_ns", std::int64_t{0}) / 1'000'000'000 * 1'000'000'000);
  if (as_json)
    print(json{{"link", link.revealed()}, {"valid_until", until}}.dump() + "\n");
  else
    print(std::string(link.revealed()) + "\n");
  return exit_code::ok;
}

exit_code run_configured(const invocation& asked, const add_more& more) {
  const auto configuration = effective_configuration(asked.options, godwit_variables());
  if (!configuration)
    return fail(exit_code::usage, configuration.error());
  switch (asked.what) {
  case task::examine:
    return examine(*configuration, std::chrono::seconds(asked.patience_s), asked.json);
  case task::may_restart:
    return may_restart(*configuration);
  case task::list_outbox:
    return list_outbox(*configuration, asked.json);
  case task::ask_status:
    return ask_running(*configuration, {{"do", "status"}}, asked.json, status_text);
  case task::retry_outbox:
    return ask_running(*configuration, {{"do", "outbox_retry"}, {"by", speaker()}, {"key", asked.outbox_key}},
                       asked.json, retry_text);
  case task::say_word:
    return ask_running(*configuration, question_of(asked.said, asked.point), asked.json, taken_text);
  case task::override_failsafe:
    return ask_running(*configuration,
                       {{"do", "override"},
                        {"by", speaker()},
                        {"rule", asked.overridden.rule},
                        {"seconds", asked.overridden.seconds},
                        {"reason", asked.overridden.reason}},
                       asked.json, taken_text);
  case task::list_points:
    return ask_running(*configuration, {{"do", "points"}}, asked.json, points_text);
  case task::decide_point:
    return ask_running(*configuration,
                       {{"do", io::name_of(asked.decided.says)}, {"by", speaker()}, {"point", asked.decided.number}},
                       asked.json, taken_text);
  case task::rescue_journal:
    return ask_running(*configuration, {{"do", "rescue_journal"}}, asked.json, rescued_text);
  case task::set_up_signing:
    return ask_running(*configuration, {{"do", "sign"}, {"by", speaker()}, {"off", asked.ends_signing}}, asked.json,
                       sent_text);
  case task::crash_actor:
    return ask_running(*configuration, {{"do", "crash"}, {"by", speaker()}, {"actor", asked.actor}}, asked.json,
                       taken_text);
  case task::change_control:
    return ask_running(
        *configuration,
        {{"do", "control"}, {"by", speaker()}, {"act", io::name_of(asked.control.act)}, {"to", asked.control.to}},
        asked.json, control_text);
  case task::make_link:
    return make_link(*configuration, asked.json);
  case task::keep_accounts:
    return accounts::run_operator(asked.account, accounts_path(*configuration));
  case task::list_audit:
    return ask_running(*configuration,
                       {{"do", "audit"}, {"by", speaker()}, {"rows", asked.rows}, {"before", asked.before}}, asked.json,
                       audit_text);
  default:
    break;
  }
  auto settings = settings_from(*configuration);
  if (!settings)
    return fail(exit_code::usage, settings.error());
  return asked.what == task::check_config ? check_config(*configuration, *settings)
                                          : run_daemon(*std::move(settings), more);
}

} // namespace

int run_program(int argc, const char* const* argv, const add_more& more) {
  std::signal(SIGPIPE, SIG_IGN);
  const auto asked = read_command_line(argc, argv);
  if (!asked)
    return static_cast<int>(asked.error());
  if (asked->what == task::convert)
    return static_cast<int>(run_convert(asked->files, asked->has("allow-partial")));
  try {
    return static_cast<int>(run_configured(*asked, more));
  } catch (const std::bad_alloc&) {
    return static_cast<int>(
        fail(exit_code::failed, "there is not enough memory: raise the limit (ulimit -v, MemoryMax)"));
  } catch (const std::system_error& refused) { // of a thread, mostly
    return static_cast<int>(fail(exit_code::failed, std::string("the system refuses what godwitd needs: ") +
                                                        refused.what() +
                                                        "; raise its limits (ulimit -v, -u; MemoryMax, TasksMax)"));
  }
}

} // namespace godwit::daemon
