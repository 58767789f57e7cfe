#include "programs/godwitd/command_line.hpp"

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "actors/domain/mission/commands/command_table.hpp"
#include "programs/godwitd/configuration.hpp"
#include "programs/godwitd/console.hpp"

namespace godwit::daemon {
namespace {

using runtime::exit_code;

constexpr const char* about =
    "The onboard daemon: fetches a mission, checks it, uploads it to the autopilot and flies it, follows its progress, "
    "records sightings, and delivers what is pending to the missions service, also after crashes. It starts a flight "
    "on command (`godwitd ctl start`, or a ground station) and arms nothing, unless its settings allow it.";

constexpr const char* examples =
    R"(Each option with a value is also an environment variable: --token-file is GODWIT_TOKEN_FILE. The command line
overrides the environment, which overrides the file of --config.

Examples:
  godwitd --service https://missions.example.org --token-file token --vehicle udpin://0.0.0.0:14550 \
          --mission-id 7d1c1f0e-6b0c-4c55-9d0d-2f6d3c8b1a42
  godwitd --mission survey.plan --vehicle serial:///dev/ttyAMA0:921600 --ground udpin://0.0.0.0:14555
  godwitd --config godwit.json --sightings seen.ndjson --once
  godwitd --check-config --config godwit.json
  godwitd doctor --vehicle serial:///dev/ttyACM0:57600
  godwitd --outbox --journal godwit.db
  godwitd ctl status
  godwitd ctl start
  godwitd ctl outbox-retry
  godwitd operator add anna --role operator
  godwitd convert survey.plan survey.json

Signals: SIGTERM and SIGINT shut it down cleanly, a second one at once; SIGHUP reopens the log file.

Exit codes: 0 success, 1 failure, 2 an error on the command line or in the configuration, 70 and 71 restart it,
72 a person has to look at the files on disk before it is restarted.)";

constexpr const char* convert_examples = R"(Formats, by the ending: .json (godwit), .plan (QGroundControl),
.waypoints and .txt (QGC WPL 110), .geojson; .kml (map programs) is only read.

Examples:
  godwitd convert survey.plan survey.json
  godwitd convert survey.json survey.geojson
  godwitd convert old.waypoints mission.json --allow-partial
  godwitd convert field.waypoints mission.json --for arducopter
  godwitd convert path.kml path.plan --altitude 40

Exit codes: 0 converted, 1 nothing was written: the file can not be read, is no mission, or something of it can not be
carried over; 2 an ending that means no format.)";

void add_options(CLI::App& app, invocation& to) {
  for (const auto& row : option_rows) {
    const auto flag = "--" + std::string(row.name);
    const auto name = std::string(row.name);
    if (row.kind == option_kind::flag)
      app.add_flag_callback(
          flag, [&to, name] { to.options[name] = "true"; }, std::string(row.help));
    else
      app.add_option_function<std::string>(
             flag, [&to, name](const std::string& text) { to.options[name] = text; }, std::string(row.help))
          ->type_name(std::string(row.type_name));
  }
  app.add_flag_callback(
      "--check-config", [&to] { to.what = task::check_config; },
      "Reports what would keep godwitd from starting with this configuration, and exits");
  app.add_flag_callback(
      "--outbox", [&to] { to.what = task::list_outbox; },
      "Lists what is still to be delivered to the service, also beside a running godwitd, and exits");
  app.add_flag("--json", to.json, "Lists and answers as JSON");
  app.set_version_flag("--version", std::string("godwitd ") + GODWIT_VERSION);
}

struct verb_row {
  operators::command_kind kind;
  const char* name;
  const char* help;
};

constexpr verb_row verbs[] = {
    {operators::command_kind::start, "start",
     "Starts the flight of the plan that is ready; after its end: prepares the mission again."},
    {operators::command_kind::pause, "pause", "Holds where it is."},
    {operators::command_kind::resume, "resume", "Continues the mission; on the ground: prepares the rest of it."},
    {operators::command_kind::come_home, "come-home", "Returns, and ends the mission."},
    {operators::command_kind::hand_back, "hand-back",
     "After a takeover or a failsafe: releases the vehicle to godwit again."},
    {operators::command_kind::check, "check", "Repeats the preflight checks."},
    {operators::command_kind::pull, "pull",
     "Asks the service again, for a mission it refused or a map whose pull failed."},
    {operators::command_kind::acknowledge, "ack",
     "Accepts this degraded preflight report, so that the flight may start."},
    {operators::command_kind::go_to, "goto",
     "Flies there, clear of the fences, and holds; `cancel` continues the mission."},
    {operators::command_kind::cancel, "cancel",
     "Cancels the last goto: continues with the first item that is not done."},
    {operators::command_kind::end_flight, "end-flight",
     "Ends a flight whose vehicle does not come back, or is disarmed: another vehicle may be used then."},
    {operators::command_kind::insert, "insert", "Inserts a waypoint into the mission."}};

// "47.398,8.546,40"; nothing: it is no place.
std::optional<mission::position> place_of(const std::string& text) {
  mission::position result;
  int end = 0;
  const int fields =
      std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &result.latitude, &result.longitude, // NOLINT(cert-err34-c)
                  &result.altitude_m, &end);
  if (fields != 3 || static_cast<std::size_t>(end) != text.size())
    return std::nullopt;
  return result;
}

CLI::Option* add_place(CLI::App& command, invocation& to) {
  return command.add_option_function<std::string>(
      "PLACE",
      [&to](const std::string& text) {
        to.said.place = place_of(text);
        if (!to.said.place)
          throw CLI::ValidationError("\"" + text +
                                     "\" is no place; write degrees, degrees and metres above the "
                                     "place of take-off, such as 47.398,8.546,40");
      },
      "LAT,LON,ALT: degrees, degrees, metres above the place of take-off");
}

// At a place, or at a point of interest that was confirmed, of which nobody but a person says how high.
void add_insert(CLI::App& command, invocation& to) {
  auto* const place = add_place(command, to);
  auto* const point = command.add_option("--point", to.point, "At the position of this point of interest");
  auto* const altitude = command.add_option_function<double>(
      "--altitude", [&to](double metres) { to.said.place.emplace().altitude_m = metres; },
      "With --point: metres above the place of take-off");
  point->check(CLI::PositiveNumber)->needs(altitude)->excludes(place);
  altitude->needs(point);
  command.add_option("--after", to.said.after, "The id of an item (the last one that is done)");
}

void add_points(CLI::App& ctl, invocation& to) {
  auto* const points = ctl.add_subcommand("points", "Lists the points of interest.");
  points->fallthrough();
  points->callback([&to] { to.what = task::list_points; });
  constexpr std::pair<scan_controller::decision, const char*> decisions[] = {
      {scan_controller::decision::confirm, "Confirms a point of interest."},
      {scan_controller::decision::decline,
       "Declines a point of interest: such objects there are ignored from now on."}};
  for (const auto& [says, help] : decisions) {
    auto* const command = ctl.add_subcommand(std::string(io::name_of(says)), help);
    command->fallthrough();
    command->add_option("POINT", to.decided.number, "Its number, as `ctl points` shows it")->required();
    command->callback([&to, kind = says] {
      to.what = task::decide_point;
      to.decided.says = kind;
    });
  }
}

void add_override(CLI::App& ctl, invocation& to) {
  auto* const command = ctl.add_subcommand("override", "Keeps a failsafe from acting for a while.");
  command->fallthrough();
  command->add_option("RULE", to.overridden.rule, "operator_link, battery_low or fence")->required();
  command->add_option("SECONDS", to.overridden.seconds, "For how long; an hour at most")->required();
  command->add_option("REASON", to.overridden.reason, "Why, for the record")->required();
  command->callback([&to] { to.what = task::override_failsafe; });
}

struct control_row {
  operator_bridge::control_act act;
  const char* name;
  const char* help;
};

constexpr control_row control_acts[] = {
    {operator_bridge::control_act::take, "take", "Takes control that is free."},
    {operator_bridge::control_act::take_over, "take-over", "Takes control from whoever has it."},
    {operator_bridge::control_act::give, "give", "Gives one's own control back."},
    {operator_bridge::control_act::hand_over, "hand-over", "Gives one's own control to somebody who is logged in."}};

void add_operators(CLI::App& ctl, invocation& to) {
  auto* const control = ctl.add_subcommand("control", "Whose commands move the vehicle: one operator's at a time.");
  control->require_subcommand(1);
  control->fallthrough();
  for (const auto& row : control_acts) {
    auto* const act = control->add_subcommand(row.name, row.help);
    act->fallthrough();
    if (row.act == operator_bridge::control_act::hand_over)
      act->add_option("NAME", to.control.to, "To whom")->required();
    act->callback([&to, which = row.act] {
      to.what = task::change_control;
      to.control.act = which;
    });
  }
  auto* const login = ctl.add_subcommand("login", "Prints a link that logs in once, within five minutes.");
  login->fallthrough();
  login->callback([&to] { to.what = task::make_link; });
  auto* const audit = ctl.add_subcommand("audit", "Lists who commanded what, when, and with which result.");
  audit->fallthrough();
  audit->add_option("--rows", to.rows, "The newest, 1 to 200 (50)")->check(CLI::Range(1, 200));
  audit->add_option("--before", to.before, "Rows before this number, to page on")->check(CLI::PositiveNumber);
  audit->callback([&to] { to.what = task::list_audit; });
}

void add_words(CLI::App& ctl, invocation& to) {
  for (const auto& row : verbs) {
    auto* const command = ctl.add_subcommand(row.name, row.help);
    command->fallthrough();
    if (row.kind == operators::command_kind::acknowledge)
      command->add_option("REPORT", to.said.report, "Its number, as `ctl status` shows it")->required();
    if (row.kind == operators::command_kind::go_to)
      add_place(*command, to)->required();
    if (row.kind == operators::command_kind::insert)
      add_insert(*command, to);
    command->callback([&to, kind = row.kind] {
      to.what = task::say_word;
      to.said.kind = kind;
      if (kind == operators::command_kind::insert && !to.said.place)
        throw CLI::RequiredError("PLACE, or --point with --altitude,");
    });
  }
  add_override(ctl, to);
  auto* const crash = ctl.add_subcommand("crash", "Ends an actor as a crash would; only with --allow-crash.");
  crash->fallthrough();
  crash->add_option("ACTOR", to.actor, "Its name, such as executor")->required();
  crash->callback([&to] { to.what = task::crash_actor; });
}

void add_control(CLI::App& app, invocation& to) {
  auto* const ctl =
      app.add_subcommand("ctl", "Commands a running godwitd over its control socket, and shows its status.");
  ctl->require_subcommand(1);
  ctl->fallthrough();
  auto* const status = ctl->add_subcommand("status", "Shows the status: mission, map, deliveries, vehicle.");
  status->fallthrough();
  status->callback([&to] { to.what = task::ask_status; });
  auto* const retry = ctl->add_subcommand(
      "outbox-retry", "Delivers now what is pending, and queues again what is orphaned or has expired.");
  retry->fallthrough();
  retry->add_option("ID", to.outbox_key, "The key of one row (all)");
  retry->callback([&to] { to.what = task::retry_outbox; });
  add_words(*ctl, to);
  add_operators(*ctl, to);
  add_points(*ctl, to);
  auto* const sign = ctl->add_subcommand(
      "sign", "Sends the key of --signing-key to the disarmed autopilot, over a line that is marked secure.");
  sign->fallthrough();
  sign->add_flag("--off", to.ends_signing, "Removes the key: the autopilot signs no longer, and accepts everybody");
  sign->callback([&to] { to.what = task::set_up_signing; });
  auto* const restart = ctl->add_subcommand(
      "may-restart", "Exits with 0 while no flight is under way: godwitd may be stopped or exchanged. Else 1.");
  restart->fallthrough();
  restart->callback([&to] { to.what = task::may_restart; });
  auto* const rescue = ctl->add_subcommand(
      "rescue-journal",
      "Writes the journal to a new file beside it when its own was deleted, replaced or cut in flight.");
  rescue->fallthrough();
  rescue->callback([&to] { to.what = task::rescue_journal; });
}

struct account_row {
  accounts::operator_act act;
  const char* name;
  const char* help;
};

constexpr account_row account_acts[] = {
    {accounts::operator_act::add, "add", "Adds an account; asks for its password, or reads it from standard input."},
    {accounts::operator_act::passwd, "passwd", "Asks for a new password; sessions with the old one end."},
    {accounts::operator_act::token, "token", "Prints a new token for a program, once; the one before becomes invalid."},
    {accounts::operator_act::remove, "remove", "Removes an account; its sessions end."},
    {accounts::operator_act::list, "list", "Lists the accounts."}};

void add_accounts(CLI::App& app, invocation& to) {
  auto* const all = app.add_subcommand("operator", "Manages the accounts of remote operators, in a file.");
  all->require_subcommand(1);
  all->fallthrough();
  for (const auto& row : account_acts) {
    auto* const act = all->add_subcommand(row.name, row.help);
    act->fallthrough();
    if (row.act != accounts::operator_act::list)
      act->add_option("NAME", to.account.name, "1 to 32 small letters, digits and -._")->required();
    if (row.act == accounts::operator_act::add)
      act->add_option_function<std::string>(
             "--role",
             [&to](const std::string& text) {
               const auto role = io::value_of<operators::role>(text);
               if (!role)
                 throw CLI::ValidationError("--role: viewer looks, operator flies, engineer takes control from others");
               to.account.role = *role;
             },
             "viewer, operator or engineer")
          ->required();
    act->callback([&to, which = row.act] {
      to.what = task::keep_accounts;
      to.account.act = which;
    });
  }
}

void add_doctor(CLI::App& app, invocation& to) {
  auto* const doctor = app.add_subcommand(
      "doctor",
      "Looks at serial line, autopilot, clock, disk and configuration, and names what is wrong with a remedy.");
  doctor->fallthrough();
  doctor->add_option("--seconds", to.patience_s, "Listens so long for the autopilot, 1 to 60 (5)")
      ->check(CLI::Range(1, 60));
  doctor->footer(
      "Exit codes: 0 nothing keeps a flight from starting, 1 something does, 2 a mistake on the command line.");
  doctor->callback([&to] { to.what = task::examine; });
}

std::vector<std::string> vehicle_names() {
  std::vector<std::string> result;
  for (const auto& each : io::enum_table<mission::vehicle_profile>)
    result.emplace_back(each.second);
  return result;
}

void add_convert(CLI::App& app, invocation& to) {
  auto* const convert = app.add_subcommand("convert", "Converts a mission from one file format to another.");
  convert->fallthrough();
  convert->add_option("IN", to.files.in, "The mission to read")->required();
  convert->add_option("OUT", to.files.out, "Where to write it; an existing file is replaced")->required();
  convert->add_option("--for", to.files.vehicle, "The vehicle that is to fly it (as the .plan says)")
      ->check(CLI::IsMember(vehicle_names()));
  convert->add_option("--altitude", to.files.altitude_m, "Metres above home, where a .kml has no heights")
      ->type_name("M");
  convert->footer(convert_examples);
  convert->callback([&to] { to.what = task::convert; });
}

} // namespace

tl::expected<invocation, exit_code> read_command_line(int argc, const char* const* argv) {
  invocation result;
  CLI::App app{about, "godwitd"};
  app.footer(examples);
  add_options(app, result);
  add_control(app, result);
  add_accounts(app, result);
  add_convert(app, result);
  add_doctor(app, result);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      app.exit(error);
      return tl::make_unexpected(exit_code::ok);
    }
    say(std::string(error.what()) + "; see godwitd --help");
    return tl::make_unexpected(exit_code::usage);
  }
  return result;
}

} // namespace godwit::daemon
