#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "io/mavlink/signing/key_file.hpp"
#include "programs/common/heartbeat_sender.hpp"
#include "programs/common/signal_descriptor.hpp"
#include "programs/godwit-trace/commands.hpp"
#include "programs/godwit-trace/identity.hpp"
#include "programs/godwit-trace/link_session.hpp"

namespace godwit::trace_tool {

namespace {

struct link_arguments {
  std::string where;
  print_arguments print;
  std::optional<double> seconds;
  std::optional<std::uint64_t> count;
  std::string tlog;
  std::string key;
  bool heartbeat = false;
  bool no_heartbeat = false;
  std::string identity;
};

constexpr const char* link_examples =
    R"(Links: udpin://HOST:PORT listens, udpout://HOST:PORT sends first, serial:///dev/NAME:BAUD, tcp://HOST:PORT.

A heartbeat makes those speak who send only to whom they have heard. It is on for udpout, where nobody could know of
us otherwise, and off for all others, so that looking does not change what is looked at. It goes out as an onboard
controller, never as a ground station: that would hide from the autopilot that the human's link is gone. Where godwit
itself runs as 1/191, take another component: --as 1/192.

Examples:
  godwit-trace link udpin://0.0.0.0:14550
  godwit-trace link serial:///dev/ttyACM0:115200 --name 'HEARTBEAT,STATUSTEXT'
  godwit-trace link udpout://127.0.0.1:14580 --stats
  godwit-trace link tcp://127.0.0.1:5760 --seconds 10 --json > ten_seconds.jsonl
  godwit-trace link udpin://:14550 --tlog bench.tlog --key signing.key)";

constexpr double max_seconds = 1e8; // three years

bool wants_heartbeat(const link_arguments& given, const io::link::uri& where) {
  const bool is_usual = where.which == io::link::uri::kind::udp_out;
  return given.heartbeat || (is_usual && !given.no_heartbeat);
}

// All but the key, which is a file and no usage.
tl::expected<link_session_options, std::string> read(const link_arguments& given) {
  auto where = io::link::parse_uri(given.where);
  auto print = read(given.print);
  const auto identity = read_identity(given.identity.empty() ? "1/191" : given.identity);
  if (!where || !print || !identity)
    return tl::make_unexpected(!where ? where.error() : !print ? print.error() : identity.error());
  link_session_options options;
  options.where = *std::move(where);
  options.print = *std::move(print);
  if (given.seconds)
    options.seconds = std::chrono::milliseconds(static_cast<std::int64_t>(*given.seconds * 1e3));
  options.count = given.count;
  options.tlog = given.tlog;
  if (wants_heartbeat(given, options.where))
    options.heartbeat_as = *identity;
  return options;
}

tl::expected<std::optional<link_keys>, std::string> load_keys(const std::string& file) {
  if (file.empty())
    return std::nullopt;
  auto key = io::mavlink::load_key_file(file);
  if (!key)
    return tl::make_unexpected(key.error().message());
  io::mavlink::secret_key to_sign(key->bytes());
  return link_keys{*std::move(key), std::move(to_sign)};
}

exit_code run(const link_arguments& given, console& to) {
  auto options = read(given);
  if (!options) {
    to.say(options.error());
    return exit_code::usage;
  }
  auto keys = load_keys(given.key);
  if (!keys) {
    to.say(keys.error());
    return exit_code::failed;
  }
  options->keys = *std::move(keys);
  if (const auto& identity = options->heartbeat_as)
    to.say("sending a heartbeat each second as " + std::to_string(identity->system) + '/' +
           std::to_string(identity->component) + " (not with --no-heartbeat)");
  const programs::signal_descriptor stop({SIGINT, SIGTERM});
  return run_link(*std::move(options), to, stop.descriptor());
}

} // namespace

command add_link_command(CLI::App& to) {
  auto* const app = to.add_subcommand("link", "Shows what arrives on a MAVLink link, live.");
  const auto given = std::make_shared<link_arguments>();
  app->add_option("URI", given->where, "The link, such as udpin://0.0.0.0:14550")->required();
  add_print_options(*app, given->print);
  app->add_option("--seconds", given->seconds, "Ends after so many seconds; fails if nothing was heard")
      ->type_name("N")
      ->check(CLI::Range(0.001, max_seconds));
  app->add_option("--count", given->count, "Ends after so many messages")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000'000}));
  app->add_option("--tlog", given->tlog, "Records all that arrives into this file, without signatures and keys")
      ->type_name("FILE");
  app->add_option("--key", given->key, "Shows only what is signed with the key in this file, and counts the rest")
      ->type_name("FILE");
  auto* const on = app->add_flag("--heartbeat", given->heartbeat, "Sends a heartbeat each second");
  app->add_flag("--no-heartbeat", given->no_heartbeat, "Sends nothing, also on udpout")->excludes(on);
  app->add_option("--as", given->identity, "Who sends the heartbeat (1/191)")->type_name("SYSTEM/COMPONENT");
  app->footer(link_examples);
  return {app, [given](console& into) { return run(*given, into); }};
}

} // namespace godwit::trace_tool
