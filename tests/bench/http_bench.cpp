// How long a small request takes over TLS on a kept connection, and how fast a body of 100 MB runs into a sink and what
// it costs in memory. The service runs in the same process, in a thread of its own, on the loopback interface: it has
// its part in both figures.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <semaphore>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "io/http/client.hpp"
#include "tests/support/http_server.hpp"

namespace godwit::io::http {
namespace {

using godwit::test::http_peer;
using godwit::test::http_request;
using godwit::test::http_server;
using godwit::test::make_tls_identity;

constexpr std::size_t large_bytes = 100'000'000;

// A service over TLS, and a client that trusts it.
class tls_pair {
public:
  tls_pair()
      : server_(answer, {.tls = identity_, .client_issuer = {}}),
        issuer_file_(std::filesystem::temp_directory_path() / ("godwit-http-bench-" + std::to_string(::getpid()))) {
    std::ofstream(issuer_file_) << identity_.certificate;
    settings wanted;
    wanted.base_url = server_.url();
    wanted.ca_file = issuer_file_.string();
    if (auto opened = client::open(wanted))
      client_ = std::move(*opened);
  }
  ~tls_pair() { std::filesystem::remove(issuer_file_); }
  tls_pair(const tls_pair&) = delete;
  tls_pair& operator=(const tls_pair&) = delete;

  // Sends and waits. False: there was no answer.
  bool ask(request asked) {
    bool is_answered = false;
    const auto sent = client_->send(std::move(asked), [&](const result<response>& end) {
      is_answered = end.has_value();
      done_.release();
    });
    if (sent)
      done_.acquire();
    return is_answered;
  }

private:
  static void answer(http_peer& peer, const http_request& asked) {
    if (asked.target() != "/large") {
      peer.write(godwit::test::http_answer("200 OK", "{\"a\":1}", "Content-Type: application/json\r\n"));
      return;
    }
    const std::string piece(1'000'000, 'x');
    peer.write("HTTP/1.1 200 OK\r\nContent-Length: " + std::to_string(large_bytes) + "\r\n\r\n");
    for (std::size_t sent = 0; sent < large_bytes && peer.write(piece);)
      sent += piece.size();
  }

  godwit::test::tls_identity identity_ = make_tls_identity({.hosts = {"IP:127.0.0.1"}});
  http_server server_;
  std::filesystem::path issuer_file_;
  std::binary_semaphore done_{0};
  std::unique_ptr<client> client_;
};

void small_get(benchmark::State& state) {
  tls_pair pair;
  std::vector<double> times_us;
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    if (!pair.ask({}))
      state.SkipWithError("no answer");
    times_us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
  }
  std::ranges::sort(times_us);
  state.counters["p50_us"] = times_us[times_us.size() / 2];
  state.counters["p99_us"] = times_us[times_us.size() * 99 / 100];
}
BENCHMARK(small_get)->Name("http/tls/get_small_kept")->UseRealTime();

// Of /proc/self/status, in kB.
long memory_kb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":"))
      return std::stol(line.substr(name.size() + 1));
  return 0;
}

void large_body(benchmark::State& state) {
  tls_pair pair;
  if (!pair.ask({})) // the connection, and what is allocated once
    state.SkipWithError("no answer");
  std::size_t taken = 0;
  std::ofstream("/proc/self/clear_refs") << "5"; // the peak counts from here: proc(5)
  const auto before_kb = memory_kb("VmRSS");
  for (auto _ : state) {
    request asked;
    asked.target = "/large";
    asked.max_body_bytes = large_bytes;
    asked.on_body = [&](std::span<const std::byte> bytes) {
      taken += bytes.size();
      return body_flow::more;
    };
    if (!pair.ask(std::move(asked)))
      state.SkipWithError("no answer");
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(taken));
  state.counters["peak_growth_MB"] = static_cast<double>(memory_kb("VmHWM") - before_kb) / 1000.0;
}
BENCHMARK(large_body)->Name("http/tls/body_100MB_to_sink")->UseRealTime()->Unit(benchmark::kMillisecond);

} // namespace
} // namespace godwit::io::http
