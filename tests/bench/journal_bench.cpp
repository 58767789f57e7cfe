// What the journal costs: durable events with a real fdatasync after each commit, snapshots, recovery.
//
// The file lies in the current directory, which should be on the disk that is to be measured (not on tmpfs).
#include <atomic>
#include <cstdio>
#include <semaphore>
#include <string>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "runtime/assert.hpp"
#include "runtime/journal/sqlite_journal.hpp"

namespace {

using namespace godwit::runtime;

// A journal in the current directory that leaves nothing behind.
class bench_journal {
public:
  bench_journal() : path_("godwit_bench_" + std::to_string(::getpid()) + ".db") {
    remove_files();
    auto opened = sqlite_journal::open({.path = path_});
    GODWIT_ASSERT(opened.has_value(), opened ? "" : opened.error().message());
    journal_ = std::move(*opened);
  }

  ~bench_journal() {
    journal_.reset();
    remove_files();
  }

  sqlite_journal* operator->() { return journal_.get(); }

private:
  void remove_files() const {
    for (const auto* suffix : {"", "-wal", "-shm", ".lock"})
      std::remove((path_ + suffix).c_str());
  }

  std::string path_;
  std::unique_ptr<sqlite_journal> journal_;
};

journal_write event_write(const std::string& actor, std::int64_t number) {
  journal_write write;
  write.actor = actor;
  write.events = {{number, number, "bench_event", std::string(100, 'x')}};
  return write;
}

// One actor that always has a number of events on their way, driven by the writer's own answers: what an actor does,
// without the cost of a thread for each.
class event_source {
public:
  event_source(sqlite_journal& journal, std::string name, std::atomic<std::int64_t>& budget,
               std::counting_semaphore<>& ended)
      : journal_(journal), name_(std::move(name)), budget_(budget), ended_(ended) {}

  void next() {
    if (budget_.fetch_sub(1) <= 0) {
      ended_.release();
      return;
    }
    auto write = event_write(name_, ++number_);
    write.done = [this](const commit_result& result) {
      GODWIT_ASSERT(result.has_value(), "bench: a commit failed");
      next();
    };
    GODWIT_ASSERT(journal_.submit(std::move(write)).has_value(), "bench: a write was refused");
  }

private:
  sqlite_journal& journal_;
  std::string name_;
  std::atomic<std::int64_t>& budget_;
  std::counting_semaphore<>& ended_;
  std::int64_t number_ = 0;
};

void report(benchmark::State& state, const journal_status& status) {
  state.SetItemsProcessed(static_cast<std::int64_t>(status.events));
  state.counters["commits"] = static_cast<double>(status.commits);
  state.counters["events_per_commit"] = static_cast<double>(status.events) / static_cast<double>(status.commits);
}

// SUBMITTERS threads, each with one event on its way: it sleeps until `done` wakes it, as a blocked caller does.
void one_in_flight(benchmark::State& state, int submitters) {
  constexpr int events_each = 500;
  bench_journal journal;
  std::int64_t first = 0;
  for (auto _ : state) {
    std::vector<std::thread> threads;
    for (int i = 0; i < submitters; ++i)
      threads.emplace_back([&, i] {
        std::binary_semaphore answered{0};
        for (std::int64_t k = 1; k <= events_each; ++k) {
          auto write = event_write("actor " + std::to_string(i), first + k);
          write.done = [&](const commit_result& result) {
            GODWIT_ASSERT(result.has_value(), "bench: a commit failed");
            answered.release();
          };
          GODWIT_ASSERT(journal->submit(std::move(write)).has_value(), "bench: a write was refused");
          answered.acquire();
        }
      });
    for (auto& thread : threads)
      thread.join();
    first += events_each;
  }
  report(state, journal->status());
}

void many_in_flight(benchmark::State& state, int actors, int in_flight) {
  constexpr std::int64_t events = 20'000;
  bench_journal journal;
  std::atomic<std::int64_t> budget{0};
  std::counting_semaphore<> ended{0};
  std::vector<std::unique_ptr<event_source>> sources;
  for (int i = 0; i < actors; ++i)
    sources.push_back(
        std::make_unique<event_source>(*journal.operator->(), "actor " + std::to_string(i), budget, ended));
  for (auto _ : state) {
    budget = events;
    // The first ones are handed over from the writer thread too, so that each source lives on one thread.
    journal->recover("starter", 1, [&](const auto&) {
      for (int k = 0; k < in_flight; ++k)
        for (auto& source : sources)
          source->next();
    });
    for (int i = 0; i < actors * in_flight; ++i)
      ended.acquire();
  }
  report(state, journal->status());
}

void snapshot_4_kib(benchmark::State& state) {
  bench_journal journal;
  std::int64_t number = 0;
  for (auto _ : state) {
    std::binary_semaphore answered{0};
    auto write = event_write("actor", ++number);
    write.snapshot = snapshot_record{number, number, 1, std::string(4096, 's')};
    write.done = [&](const commit_result&) { answered.release(); };
    GODWIT_ASSERT(journal->submit(std::move(write)).has_value(), "bench: a write was refused");
    answered.acquire();
  }
  report(state, journal->status());
}

void recover_4_kib_and_100_events(benchmark::State& state) {
  bench_journal journal;
  for (std::int64_t number = 1; number <= 101; ++number) {
    auto write = event_write("actor", number);
    if (number == 1)
      write.snapshot = snapshot_record{number, number, 1, std::string(4096, 's')};
    GODWIT_ASSERT(journal->submit(std::move(write)).has_value(), "bench: a write was refused");
  }
  GODWIT_ASSERT(journal->flush(std::chrono::seconds(10)), "bench: flush");
  for (auto _ : state) {
    std::binary_semaphore answered{0};
    journal->recover("actor", 1, [&](auto state_or_error) {
      GODWIT_ASSERT(state_or_error.has_value() && state_or_error->events.size() == 100, "bench: recovery is whole");
      answered.release();
    });
    answered.acquire();
  }
}

const bool registered = [] {
  const auto add = [](const char* name, auto run) {
    benchmark::RegisterBenchmark(name, run)->UseRealTime()->Unit(benchmark::kMicrosecond);
  };
  add("journal/durable_events/1x1", [](benchmark::State& state) { one_in_flight(state, 1); });
  add("journal/durable_events/16x1", [](benchmark::State& state) { one_in_flight(state, 16); });
  add("journal/durable_events/16x16", [](benchmark::State& state) { many_in_flight(state, 16, 16); });
  add("journal/snapshot_4KiB", snapshot_4_kib);
  add("journal/recover/4KiB+100", recover_4_kib_and_100_events);
  return true;
}();

} // namespace
