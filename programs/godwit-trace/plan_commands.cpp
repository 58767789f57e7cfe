#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "io/mavlink/signing/key_file.hpp"
#include "io/mavlink/waypoint_file/waypoint_file.hpp"
#include "programs/common/signal_descriptor.hpp"
#include "programs/godwit-trace/commands.hpp"
#include "programs/godwit-trace/identity.hpp"
#include "programs/godwit-trace/plan_transfer.hpp"

namespace godwit::trace_tool {

namespace {

using io::mavlink::mav_mission_type;

struct plan_arguments {
  std::string where;
  std::string file;
  std::string type = "mission";
  std::string identity;
  std::string key;
  int system = 0;
  double wait_s = 15;
  bool json = false;
};

constexpr const char* about_files = R"(
A plan file is the text that ground stations write ("QGC WPL 110"), one item a line. Items go as they stand in the file:
an ArduPilot takes the first one of a mission as home and puts its own in its place (a mission that does not begin with
home is not sent to it), a PX4 flies it.

)";

constexpr const char* upload_examples = R"(Examples:
  godwit-trace upload udpin://0.0.0.0:14550 survey.waypoints
  godwit-trace upload serial:///dev/ttyUSB0:57600 fence.waypoints --type fence
  godwit-trace upload udpout://127.0.0.1:14580 survey.waypoints --json)";

constexpr const char* download_examples = R"(Examples:
  godwit-trace download udpin://0.0.0.0:14550 there.waypoints
  godwit-trace download tcp://127.0.0.1:5760 rally.waypoints --type rally)";

constexpr const char* clear_examples = R"(Examples:
  godwit-trace clear udpin://0.0.0.0:14550
  godwit-trace clear udpin://0.0.0.0:14550 --type fence)";

mav_mission_type type_of(const std::string& name) {
  return name == "fence"   ? mav_mission_type::fence
         : name == "rally" ? mav_mission_type::rally
                           : mav_mission_type::mission;
}

// What is on the command line; the files come later, being no usage.
tl::expected<plan_transfer_options, std::string> read(const plan_arguments& given) {
  plan_transfer_options options;
  auto where = io::link::parse_uri(given.where);
  if (!where)
    return tl::make_unexpected(where.error());
  options.where = *std::move(where);
  if (!given.identity.empty()) {
    const auto identity = read_identity(given.identity);
    if (!identity)
      return tl::make_unexpected(identity.error());
    options.link.as.system = identity->system;
    options.link.as.component = identity->component;
  }
  options.save_to = given.file;
  options.json = given.json;
  options.wait_for_vehicle = std::chrono::milliseconds(static_cast<std::int64_t>(given.wait_s * 1e3));
  options.link.watch.system = static_cast<std::uint8_t>(given.system);
  options.link.streams.clear(); // a transfer needs none of them, and the line may be slow
  return options;
}

exit_code run(const plan_arguments& given, console& to, const std::optional<plan_request>& without_file) {
  auto options = read(given);
  if (!options) {
    to.say(options.error());
    return exit_code::usage;
  }
  if (without_file) {
    options->what = *without_file;
  } else {
    auto items = io::mavlink::load_waypoint_file(given.file, type_of(given.type));
    if (!items) {
      to.say(items.error().message());
      return exit_code::failed;
    }
    if (items->empty()) {
      to.say(given.file + " has no items; to remove a plan from a vehicle: godwit-trace clear");
      return exit_code::failed;
    }
    options->what = vehicle_link::upload_plan{type_of(given.type), *std::move(items)};
  }
  if (!given.key.empty()) {
    auto key = io::mavlink::load_key_file(given.key);
    if (!key) {
      to.say(key.error().message());
      return exit_code::failed;
    }
    options->signing.key = std::make_shared<io::mavlink::secret_key>(*std::move(key));
  }
  const programs::signal_descriptor stop({SIGINT, SIGTERM});
  return run_plan_transfer(*options, to, stop.descriptor());
}

CLI::App* add(CLI::App& to, const char* name, const char* about, const std::shared_ptr<plan_arguments>& given) {
  auto* const app = to.add_subcommand(name, about);
  app->add_option("URI", given->where, "The link, such as udpin://0.0.0.0:14550")->required();
  app->add_option("--type", given->type, "Which plan (mission)")->check(CLI::IsMember({"mission", "fence", "rally"}));
  app->add_option("--system", given->system, "The vehicle's system id (the first that is heard)")
      ->check(CLI::Range(1, 255));
  app->add_option("--as", given->identity, "Who asks (component 191 of the vehicle's system)")
      ->type_name("SYSTEM/COMPONENT");
  app->add_option("--key", given->key, "Signs with the key in this file, and believes only what is signed with it")
      ->type_name("FILE");
  app->add_option("--wait", given->wait_s, "How long to wait for a vehicle (15)")
      ->type_name("SECONDS")
      ->check(CLI::Range(0.1, 86'400.0));
  app->add_flag("--json", given->json, "Prints the outcome as one JSON object");
  return app;
}

} // namespace

command add_upload_command(CLI::App& to) {
  const auto given = std::make_shared<plan_arguments>();
  auto* const app = add(to, "upload", "Uploads a plan from a file to the vehicle.", given);
  app->add_option("FILE", given->file, "The plan")->required();
  app->footer(std::string(about_files) + upload_examples);
  return {app, [given](console& into) { return run(*given, into, std::nullopt); }};
}

command add_download_command(CLI::App& to) {
  const auto given = std::make_shared<plan_arguments>();
  auto* const app = add(to, "download", "Downloads the plan of the vehicle into a file.", given);
  app->add_option("FILE", given->file, "Where to write it; an existing file is replaced")->required();
  app->footer(std::string(about_files) + download_examples);
  return {app, [given](console& into) { return run(*given, into, vehicle_link::download_plan{type_of(given->type)}); }};
}

command add_clear_command(CLI::App& to) {
  const auto given = std::make_shared<plan_arguments>();
  auto* const app = add(to, "clear", "Removes a plan from the vehicle.", given);
  app->footer(clear_examples);
  return {app, [given](console& into) { return run(*given, into, vehicle_link::clear_plan{type_of(given->type)}); }};
}

} // namespace godwit::trace_tool
