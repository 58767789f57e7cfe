// How long a datagram takes from a sender's thread to the other side's callback and back: what two links add to each
// command and its answer.
#include <algorithm>
#include <chrono>
#include <memory>
#include <semaphore>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "io/link/link.hpp"

namespace godwit::io::link {
namespace {

constexpr std::chrono::seconds patience{10};
constexpr std::size_t frame_bytes = 45; // a COMMAND_LONG

struct udp_pair {
  std::binary_semaphore server_up{0};
  std::binary_semaphore client_up{0};
  std::binary_semaphore answered{0};
  std::unique_ptr<link> server;
  std::unique_ptr<link> client; // ends first, because the server's callback uses the server

  static std::function<void(const link_status&)> tell(std::binary_semaphore& up) {
    return [&up](const link_status& status) {
      if (status.phase == link_phase::up)
        up.release();
    };
  }

  bool open() {
    auto listener = open_link(
        *parse_uri("udpin://127.0.0.1:0"),
        {[this](peer_id from, std::span<const std::byte> bytes, bool) { server->send(bytes, from); }, tell(server_up)});
    if (!listener || !server_up.try_acquire_for(patience))
      return false;
    server = std::move(*listener);
    const auto port = parse_uri(server->description())->port;
    auto sender =
        open_link(*parse_uri("udpout://127.0.0.1:" + std::to_string(port)),
                  {[this](peer_id, std::span<const std::byte>, bool) { answered.release(); }, tell(client_up)});
    if (!sender || !client_up.try_acquire_for(patience))
      return false;
    client = std::move(*sender);
    return true;
  }
};

void report_percentiles(benchmark::State& state, std::vector<double>& times_us) {
  if (times_us.empty())
    return;
  std::sort(times_us.begin(), times_us.end());
  const auto at = [&](double part) { return times_us[static_cast<std::size_t>(part * (times_us.size() - 1))]; };
  state.counters["p50_us"] = at(0.5);
  state.counters["p99_us"] = at(0.99);
  state.counters["max_us"] = times_us.back();
}

void udp_round_trip(benchmark::State& state) {
  using clock = std::chrono::steady_clock;
  udp_pair pair;
  if (!pair.open())
    return state.SkipWithError("the links did not come up");
  const std::vector<std::byte> frame(frame_bytes);
  std::vector<double> times_us;
  for (auto _ : state) {
    const auto began = clock::now();
    if (!pair.client->send(frame) || !pair.answered.try_acquire_for(patience)) {
      state.SkipWithError("no answer");
      break;
    }
    times_us.push_back(std::chrono::duration<double, std::micro>(clock::now() - began).count());
  }
  report_percentiles(state, times_us);
}
BENCHMARK(udp_round_trip)->Name("link/udp/round_trip")->UseRealTime();

} // namespace
} // namespace godwit::io::link
