// The command `missions`: a missions service, until it is told to stop.
#include <memory>
#include <string>

#include <unistd.h>

#include "programs/common/line_printer.hpp"
#include "programs/godwit-sim/commands.hpp"
#include "programs/godwit-sim/missions/mission_service_host.hpp"
#include "programs/godwit-sim/missions_options.hpp"

namespace godwit::sim {
namespace {

constexpr const char* missions_examples =
    R"(Examples:
  godwit-sim missions --token-file token --mission survey.plan --db missions.db
  godwit-sim missions --listen 0.0.0.0:8443 --tls cert.pem,key.pem --token-file token --mission m.json --db missions.db
  godwit-sim missions --token-file token --mission m.json --db missions.db --fault "lose on post-progress times 1"
  godwit-sim missions --token-file token --mission m.json --db missions.db --map-objects 100000 --around 47.4,8.5)";

exit_code run(const missions_arguments& given) {
  auto wanted = read(given);
  if (!wanted) {
    say(wanted.error());
    return exit_code::usage;
  }
  wanted->settings.ends_on_signals = true;
  programs::line_printer printer(STDOUT_FILENO);
  missions::mission_service_host::teller teller;
  if (!given.is_quiet)
    teller = [&printer](std::string_view line) { printer.push(line); };
  auto host = missions::mission_service_host::open(std::move(wanted->settings), teller);
  if (!host) {
    say(host.error());
    return exit_code::failed;
  }
  printer.push("listening on " + (*host)->url());
  for (const auto& each : wanted->notes)
    printer.push(each);
  if (const auto control = (*host)->control(); !control.empty())
    printer.push("control port " + control);
  printer.push("Ctrl-C ends it");
  (*host)->wait();
  return exit_code::ok;
}

void add_service_options(CLI::App& app, missions_arguments& given) {
  app.add_option("--listen", given.listen, "Where vehicles reach it; port 0 is any free one")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  app.add_option("--tls", given.tls, "Serves https:// with this certificate and key, in PEM; the key's mode is 0600")
      ->type_name("CERT,KEY");
  app.add_option("--token-file", given.token_file, "The token that vehicles show; the file's mode is 0600")
      ->type_name("FILE")
      ->required();
  app.add_option("--foreign-token-file", given.foreign_token_file, "A token that is known, and gets 403")
      ->type_name("FILE");
  app.add_option("--mission", given.missions, "A mission: ours (.json) or QGroundControl's (.plan); repeatable")
      ->type_name("FILE")
      ->required()
      ->allow_extra_args(false);
  app.add_flag("--allow-partial", given.allow_partial, "Takes what can be taken of a mission in another format");
  app.add_option("--db", given.database, "Its database; created where it is missing")->type_name("FILE")->required();
}

void add_world_options(CLI::App& app, missions_arguments& given) {
  app.add_option("--fault", given.faults, "What is to go wrong, such as \"status 503 from 2 times 3\"; repeatable")
      ->type_name("SPEC")
      ->allow_extra_args(false);
  app.add_option("--wrong-host-tls", given.wrong_host_tls, "The certificate of another host, for the fault wrong-host")
      ->type_name("CERT,KEY");
  app.add_option("--control", given.control, "Takes requests in JSON on this loopback address (docs/godwit-sim.md)")
      ->type_name("HOST:PORT");
  app.add_option("--seed", given.seed, "Draws all that is random")->type_name("N")->capture_default_str();
  app.add_option("--map-objects", given.map_objects, "So many objects on the map of each mission that has none")
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--around", given.around, "The middle of their square of 30 km; default: the first return point")
      ->type_name("LAT,LON");
  app.add_flag("--quiet", given.is_quiet, "Prints no requests");
}

} // namespace

command add_missions_command(CLI::App& to) {
  auto* const app = to.add_subcommand("missions", "Simulates a missions service, with faults on demand.");
  const auto given = std::make_shared<missions_arguments>();
  add_service_options(*app, *given);
  add_world_options(*app, *given);
  app->footer(missions_examples);
  return {app, [given] { return run(*given); }};
}

} // namespace godwit::sim
