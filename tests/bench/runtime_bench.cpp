// What the runtime costs: messages, restarts.
//
// message/*: one actor sends batches to another and waits for its sign, on one worker; what is measured is the
// processor time of that worker per message sent and handled. Bursts fit into the trace's ring and the trace is given
// time between them, as in life. plain_caf is CAF's typed actor with the same payload; godwit adds stable address,
// cell, header and trace. The difference of the two is the cost. restart/*: from the throw in a handler to the first
// answer of the new incarnation, with a snapshot of 4 KiB and 100 events.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <condition_variable>
#include <filesystem>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

#include <caf/all.hpp>

#include "runtime/actor_base.hpp"
#include "runtime/define_message.hpp"
#include "runtime/process.hpp"
#include "tests/support/ledger.hpp"

namespace godwit::bench {

namespace {

using runtime::mailbox;
using runtime::tells;

// A message as the link actor will send many of.
struct attitude {
  std::uint64_t time_boot_ms = 0;
  float roll_rad = 0;
  float pitch_rad = 0;
  float yaw_rad = 0;
  static constexpr auto fields = io::table(
      "bench.attitude", io::field("time_boot_ms", &attitude::time_boot_ms), io::field("roll_rad", &attitude::roll_rad),
      io::field("pitch_rad", &attitude::pitch_rad), io::field("yaw_rad", &attitude::yaw_rad));
};

struct batch_end {
  static constexpr auto fields = io::table("bench.batch_end");
};

struct go_on {
  static constexpr auto fields = io::table("bench.go_on");
};

constexpr int batch = 200; // messages between two signs

// CAF without anything around it asks for an inspect of each message.
template <class Inspector>
typename Inspector::result_type inspect(Inspector& f, attitude& x) {
  return f(x.time_boot_ms, x.roll_rad, x.pitch_rad, x.yaw_rad);
}
template <class Inspector>
typename Inspector::result_type inspect(Inspector& f, batch_end&) {
  return f();
}
template <class Inspector>
typename Inspector::result_type inspect(Inspector& f, go_on&) {
  return f();
}

// What ends a run: all messages are handled.
class finish_line {
public:
  void reached() {
    const std::lock_guard guard(mutex_);
    done_ = true;
    changed_.notify_all();
  }
  void wait() {
    std::unique_lock guard(mutex_);
    changed_.wait(guard, [this] { return done_; });
    done_ = false;
  }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
};

double thread_cpu_s() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

constexpr int batches_per_burst = 40;

struct flow {
  int batches_left = 0;
  double sum = 0; // so that the payload is read
  double began_s = 0;
  double took_s = 0; // processor time of the worker
  finish_line end;

  // Called by the source for each batch, on the worker; false when the burst is over.
  bool next_batch() {
    if (batches_left == batches_per_burst)
      began_s = thread_cpu_s();
    if (batches_left-- > 0)
      return true;
    took_s = thread_cpu_s() - began_s;
    end.reached();
    return false;
  }
};

template <class Start>
void run_bursts(benchmark::State& bench, flow& state, Start start) {
  for (auto _ : bench) {
    state.batches_left = batches_per_burst;
    start();
    state.end.wait();
    bench.SetIterationTime(state.took_s);
    std::this_thread::sleep_for(std::chrono::milliseconds(20)); // the trace writes what it has
  }
  benchmark::DoNotOptimize(state.sum);
  const auto messages = bench.iterations() * batches_per_burst * batch;
  bench.SetItemsProcessed(messages);
}

// -- plain CAF ---------------------------------------------------------------------------------

using plain_sink = caf::typed_actor<caf::reacts_to<attitude>, caf::reacts_to<batch_end>>;
using plain_source = caf::typed_actor<caf::reacts_to<go_on>>;

class plain_sink_actor final : public plain_sink::base {
public:
  plain_sink_actor(caf::actor_config& config, flow* state) : plain_sink::base(config), state_(state) {}
  void set_source(plain_source source) { source_ = std::move(source); }
  behavior_type make_behavior() override {
    return {[this](const attitude& m) { state_->sum += static_cast<double>(m.roll_rad); },
            [this](const batch_end&) { caf::anon_send(source_, go_on{}); }};
  }
  void on_exit() override { source_ = nullptr; }

private:
  flow* state_;
  plain_source source_;
};

class plain_source_actor final : public plain_source::base {
public:
  plain_source_actor(caf::actor_config& config, flow* state, plain_sink sink)
      : plain_source::base(config), state_(state), sink_(std::move(sink)) {}
  behavior_type make_behavior() override {
    return {[this](const go_on&) {
      if (!state_->next_batch())
        return;
      for (int i = 0; i < batch; ++i)
        send(sink_, attitude{static_cast<std::uint64_t>(i), 0.1F, 0.2F, 0.3F});
      send(sink_, batch_end{});
    }};
  }
  void on_exit() override { sink_ = nullptr; }

private:
  flow* state_;
  plain_sink sink_;
};

void plain_caf(benchmark::State& bench) {
  caf::actor_system_config config;
  config.set("scheduler.policy", caf::atom("sharing"));
  config.set("scheduler.max-threads", std::size_t{1});
  config.set("scheduler.max-throughput", std::size_t{20});
  caf::actor_system system(config);
  flow state;
  const auto sink = system.spawn<plain_sink_actor>(&state);
  const auto source = system.spawn<plain_source_actor>(&state, sink);
  static_cast<plain_sink_actor*>(caf::actor_cast<caf::abstract_actor*>(sink))->set_source(source);
  run_bursts(bench, state, [&] { caf::anon_send(source, go_on{}); });
  caf::anon_send_exit(sink, caf::exit_reason::kill);
  caf::anon_send_exit(source, caf::exit_reason::kill);
}

// -- godwit ------------------------------------------------------------------------------------

using sink_handle = mailbox<tells<attitude>, tells<batch_end>>;
using source_handle = mailbox<tells<go_on>>;

class sink_actor final : public runtime::actor_base<sink_handle> {
public:
  sink_actor(runtime::spawn_context context, flow* state, source_handle* source)
      : actor_base(std::move(context)), state_(state), source_(source) {}

protected:
  behavior_type handlers() override {
    return {on<attitude>([this](const attitude& m) { state_->sum += static_cast<double>(m.roll_rad); }),
            on<batch_end>([this](const batch_end&) { tell(*source_, go_on{}); })};
  }

private:
  flow* state_;
  source_handle* source_;
};

class source_actor final : public runtime::actor_base<source_handle> {
public:
  source_actor(runtime::spawn_context context, flow* state, sink_handle sink)
      : actor_base(std::move(context)), state_(state), sink_(std::move(sink)) {}

protected:
  behavior_type handlers() override {
    return {on<go_on>([this](const go_on&) {
      if (!state_->next_batch())
        return;
      for (int i = 0; i < batch; ++i)
        tell(sink_, attitude{static_cast<std::uint64_t>(i), 0.1F, 0.2F, 0.3F});
      tell(sink_, batch_end{});
    })};
  }

private:
  flow* state_;
  sink_handle sink_;
};

// A folder on the disk of the working directory, gone at the end.
class scratch {
public:
  scratch() : path_(std::filesystem::current_path() / ("godwit-bench-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  scratch(const scratch&) = delete;
  scratch& operator=(const scratch&) = delete;
  ~scratch() { std::filesystem::remove_all(path_); }
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

private:
  std::filesystem::path path_;
};

runtime::address_options named(const std::string& name) {
  runtime::address_options result;
  result.name = name;
  return result;
}

runtime::child_policy at_once() {
  runtime::child_policy result;
  result.restart = {
      .intensity = UINT32_MAX, .backoff_initial = runtime::milliseconds(0), .backoff_max = runtime::milliseconds(0)};
  return result;
}

void godwit_messages(benchmark::State& bench, bool traced) {
  const scratch folder;
  runtime::process_options options;
  options.journal.path = folder.file("bench.db");
  if (traced) {
    options.trace.emplace();
    options.trace->folder = folder.file("trace");
    options.trace->total_bytes = std::uint64_t{32} << 20U;
  }
  options.actors.workers = 1;
  auto host = std::move(*runtime::process::open(options));
  flow state;
  source_handle source;
  const auto sink = host->actors().add<sink_actor>(named("sink"), at_once(), &state, &source);
  source = host->actors().add<source_actor>(named("source"), at_once(), &state, sink);
  host->actors().start();
  auto gate = host->actors().make_gateway("bench");
  run_bursts(bench, state, [&] { gate.tell(source, go_on{}); });
  (void)host->finish(0);
  source = nullptr;
  const auto counts = host->traced();
  bench.counters["trace_dropped_share"] =
      static_cast<double>(counts.dropped) /
      static_cast<double>(std::max<std::uint64_t>(1, counts.recorded + counts.dropped));
}

void godwit_traced(benchmark::State& bench) { godwit_messages(bench, true); }
void godwit_untraced(benchmark::State& bench) { godwit_messages(bench, false); }

// -- restart -----------------------------------------------------------------------------------

// Crashes one actor when it is told to, and notes when.
class one_crash final : public runtime::crash_points {
public:
  explicit one_crash(const runtime::time_source& time) : time_(time) {}
  void arm(std::uint32_t actor) { actor_.store(actor); }
  [[nodiscard]] std::int64_t crashed_at_ns() const { return crashed_at_ns_.load(); }
  void hit(runtime::crash_point point, std::uint32_t actor, std::uint64_t) override {
    if (point != runtime::crash_point::before_handler || actor != actor_.load(std::memory_order_relaxed))
      return;
    actor_.store(0);
    crashed_at_ns_.store(time_.monotonic_ns());
    throw runtime::injected_crash("bench");
  }

private:
  const runtime::time_source& time_;
  std::atomic<std::uint32_t> actor_{0};
  std::atomic<std::int64_t> crashed_at_ns_{0};
};

struct ask_now {
  bool gated = false;
  static constexpr auto fields = io::table("bench.ask_now", io::field("gated", &ask_now::gated));
};

using prober_handle = mailbox<tells<ask_now>>;

// Asks the ledger and notes when the answer came.
class prober final : public runtime::actor_base<prober_handle> {
public:
  prober(runtime::spawn_context context, tests::ledger_handle ledger, const runtime::time_source* time,
         std::promise<std::int64_t>** answered)
      : actor_base(std::move(context)), ledger_(std::move(ledger)), time_(time), answered_(answered) {}

protected:
  behavior_type handlers() override {
    using namespace std::chrono_literals;
    return {on<ask_now>([this](const ask_now& a) {
      const auto note = [this](const auto&) { (*answered_)->set_value(time_->monotonic_ns()); };
      const auto failed = [this](const runtime::ask_error&) { (*answered_)->set_value(-1); };
      if (a.gated)
        ask(ledger_, 5s, tests::withdraw{1, 0}, note, failed);
      else
        ask(ledger_, 5s, tests::get_balance{}, note, failed);
    })};
  }

private:
  tests::ledger_handle ledger_;
  const runtime::time_source* time_;
  std::promise<std::int64_t>** answered_;
};

// A state of 4 KiB and 100 events after it, as an actor has them in the worst moment.
void fill(runtime::journal& journal, const std::string& actor) {
  constexpr std::int64_t covered = 100;
  constexpr std::size_t ballast_bytes = 4096 - 48;
  for (std::int64_t n = 1; n <= covered * 2; ++n) {
    runtime::journal_write write;
    write.actor = actor;
    write.events = {{n, n, "test.deposit", R"({"key":)" + std::to_string(n) + R"(,"amount":1})"}};
    if (n == covered)
      write.snapshot = runtime::snapshot_record{
          n, n, 1, R"({"amount":100,"deposits":100,"ballast":")" + std::string(ballast_bytes, 'x') + "\"}"};
    (void)journal.submit(std::move(write));
  }
}

void report(benchmark::State& bench, std::vector<std::int64_t>& latencies_ns) {
  std::sort(latencies_ns.begin(), latencies_ns.end());
  const auto at_us = [&](double share) {
    const auto last = static_cast<double>(latencies_ns.size()) - 1;
    return static_cast<double>(latencies_ns[static_cast<std::size_t>(share * last)]) * 1e-3;
  };
  bench.counters["p50_us"] = at_us(0.5);
  bench.counters["p99_us"] = at_us(0.99);
  bench.counters["max_us"] = at_us(1.0);
}

// LOADERS other actors keep one durable event each in flight all the time.
void restart(benchmark::State& bench, bool gated, int loaders) {
  const scratch folder;
  const runtime::system_time time;
  one_crash crash(time);
  runtime::process_options options;
  options.journal.path = folder.file("bench.db");
  options.trace.emplace();
  options.trace->folder = folder.file("trace");
  options.crashes = &crash;
  auto host = std::move(*runtime::process::open(options));
  fill(host->journal(), "ledger");
  (void)host->journal().flush(std::chrono::seconds(5));
  tests::audit seen;
  auto& actors = host->actors();
  const auto auditor = actors.add<tests::auditor_actor>(named("auditor"), at_once(), &seen);
  const auto ledger = actors.add<tests::ledger_actor>(named("ledger"), at_once(), auditor);
  const auto ledger_number = actors.number(1);
  std::promise<std::int64_t>* answered = nullptr;
  const auto asker = actors.add<prober>(named("prober"), at_once(), ledger, &time, &answered);
  actors.start();
  auto gate = actors.make_gateway("bench");

  std::atomic<bool> stop{false};
  std::vector<std::thread> load;
  for (int i = 0; i < loaders; ++i)
    load.emplace_back([&, i] {
      const auto name = "loader_" + std::to_string(i);
      for (std::int64_t n = 1; !stop.load(); ++n) {
        std::promise<void> durable;
        runtime::journal_write write;
        write.actor = name;
        write.events = {{n, n, "test.deposit", R"({"key":1,"amount":1})"}};
        write.done = [&](const runtime::commit_result&) { durable.set_value(); };
        (void)host->journal().submit(std::move(write));
        durable.get_future().wait();
      }
    });

  std::vector<std::int64_t> latencies_ns;
  for (auto _ : bench) {
    std::promise<std::int64_t> answer;
    answered = &answer;
    crash.arm(ledger_number);
    gate.tell(asker, ask_now{gated}); // crashes the ledger, is put back, and is answered by the next incarnation
    const auto took_ns = answer.get_future().get() - crash.crashed_at_ns();
    latencies_ns.push_back(took_ns);
    bench.SetIterationTime(static_cast<double>(took_ns) * 1e-9);
    std::this_thread::sleep_for(std::chrono::milliseconds(2)); // let the journal come to rest
  }
  stop = true;
  for (auto& each : load)
    each.join();
  report(bench, latencies_ns);
  (void)host->finish(0);
}

void restart_plain(benchmark::State& bench) { restart(bench, false, 0); }
void restart_gated_idle(benchmark::State& bench) { restart(bench, true, 0); }
void restart_gated_loaded(benchmark::State& bench) { restart(bench, true, 16); }

BENCHMARK(plain_caf)->Name("message/plain_caf")->UseManualTime()->Iterations(200);
BENCHMARK(godwit_untraced)->Name("message/godwit_without_trace")->UseManualTime()->Iterations(200);
BENCHMARK(godwit_traced)->Name("message/godwit")->UseManualTime()->Iterations(200);
BENCHMARK(restart_plain)->Name("restart/answer_without_gate")->UseManualTime()->Iterations(1000);
BENCHMARK(restart_gated_idle)->Name("restart/gated_answer_idle_journal")->UseManualTime()->Iterations(1000);
BENCHMARK(restart_gated_loaded)->Name("restart/gated_answer_16_writers")->UseManualTime()->Iterations(1000);

} // namespace

} // namespace godwit::bench
