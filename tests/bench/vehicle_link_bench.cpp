// What a command to the vehicle costs on the way: actor, vehicle_link, socket, vehicle, and back.
//
// command/udp_round_trip: from the ask in an actor to its answer there, over loopback, against a vehicle that answers
// at once; journal and trace as in life. p50, p99 and the worst are given as counters, in microseconds.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <future>
#include <vector>

#include "actors/vehicle_link/actor.hpp"
#include "actors/vehicle_link/link_port.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/define_message.hpp"
#include "runtime/process.hpp"
#include "tests/support/loopback_vehicle.hpp"

namespace godwit::bench {

namespace {

using namespace std::chrono_literals;

struct ask_commands {
  int count = 0;
  static constexpr auto fields = io::table("bench.ask_commands", io::field("count", &ask_commands::count));
};

struct round_trips {
  std::vector<std::int64_t> us;
  std::promise<void> done;
};

using commander_handle = runtime::mailbox<runtime::tells<ask_commands>>;

// Sends one command after the other, each when the one before it is answered.
class commander final : public runtime::actor_base<commander_handle> {
public:
  commander(runtime::spawn_context context, vehicle_link::command_handle vehicle, round_trips* out)
      : actor_base(std::move(context)), vehicle_(std::move(vehicle)), out_(out) {}

protected:
  behavior_type handlers() override {
    return {on<ask_commands>([this](const ask_commands& m) { next(m.count); })};
  }

private:
  void next(int left) {
    if (left == 0) {
      out_->done.set_value();
      return;
    }
    vehicle_link::send_command what;
    what.command = 410;
    const auto began_ns = now_ns();
    ask(
        vehicle_, 5s, what,
        [this, began_ns, left](const vehicle_link::command_outcome& outcome) {
          GODWIT_ASSERT(outcome.verdict == vehicle_link::command_verdict::accepted, "the vehicle answers each");
          out_->us.push_back((now_ns() - began_ns) / 1'000);
          next(left - 1);
        },
        [](const runtime::ask_error&) { GODWIT_ASSERT(false, "vehicle_link answers each"); });
  }

  vehicle_link::command_handle vehicle_;
  round_trips* out_;
};

class link_scratch {
public:
  link_scratch() : path_(std::filesystem::temp_directory_path() / ("godwit-bench-link-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_ / "trace");
  }
  link_scratch(const link_scratch&) = delete;
  link_scratch& operator=(const link_scratch&) = delete;
  ~link_scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

void wait_until(const std::function<bool()>& holds) {
  while (!holds())
    std::this_thread::sleep_for(1ms);
}

void udp_round_trip(benchmark::State& bench) {
  const link_scratch folder;
  runtime::process_options options;
  options.journal.path = (folder.path() / "bench.db").string();
  options.trace = runtime::trace_options{};
  options.trace->folder = folder.path() / "trace";
  options.trace->program = "godwit-bench";
  auto host = *runtime::process::open(options);
  const auto port = std::make_shared<vehicle_link::link_port>();
  vehicle_link::settings settings;
  settings.streams.clear();
  const auto link = host->actors().add<vehicle_link::actor>(
      {.name = "vehicle_link"}, {}, settings, vehicle_link::signing_settings{},
      std::static_pointer_cast<vehicle_link::wire>(port), std::make_shared<const vehicle_link::listeners>());
  round_trips measured;
  const auto asker =
      host->actors().add<commander>({.name = "commander"}, {}, vehicle_link::command_handle(link), &measured);
  host->actors().start();
  (void)port->open(*io::link::parse_uri("udpin://127.0.0.1:0"), {}, host->actors().make_gateway("port"), link);
  wait_until([&] { return !port->description().ends_with(":0") && port->description() != "closed"; });
  auto address = port->description();
  const support::loopback_vehicle vehicle("udpout" + address.substr(address.find(':')), {.beat_period = 50ms});
  wait_until([&] { return vehicle.heartbeats_heard() > 0; });
  auto way_in = host->actors().make_gateway("bench");
  constexpr int commands = 2'000;
  for (auto _ : bench) {
    measured.done = {};
    way_in.tell(asker, ask_commands{commands});
    measured.done.get_future().wait();
  }
  std::sort(measured.us.begin(), measured.us.end());
  const auto quantile = [&](std::size_t per_thousand) {
    return static_cast<double>(measured.us[(measured.us.size() - 1) * per_thousand / 1'000]);
  };
  bench.counters["p50_us"] = quantile(500);
  bench.counters["p99_us"] = quantile(990);
  bench.counters["worst_us"] = quantile(1'000);
  bench.SetItemsProcessed(bench.iterations() * commands);
  port->close();
  (void)host->finish(0);
}

} // namespace

BENCHMARK(udp_round_trip)->Name("command/udp_round_trip")->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace godwit::bench
