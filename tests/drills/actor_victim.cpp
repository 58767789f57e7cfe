// A process with supervised actors, journal and trace that works until it is killed. Prints "KEY" after the deposit of
// that key was acknowledged: whoever has read that line may demand the row from the journal ever after.
//
// While it works, every 50th message of a ledger crashes it, so that a kill also meets actors that come back.
//
// Usage: actor_victim FOLDER         until it is killed
//        actor_victim FOLDER COUNT   COUNT more deposits; ends in order when everything ever let out is acknowledged
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <thread>

#include <unistd.h>

#include "runtime/journal/journal_reader.hpp"
#include "runtime/process.hpp"
#include "tests/drills/deposit_actors.hpp"

namespace godwit::tests::drill {

// A line shorter than PIPE_BUF reaches the pipe whole or not at all.
void auditor::acknowledge(std::int64_t key) {
  const auto line = std::to_string(key) + "\n";
  if (::write(STDOUT_FILENO, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    std::_Exit(3); // nobody listens any more
}

namespace {

using namespace std::chrono_literals;
namespace rt = godwit::runtime;

constexpr std::int64_t window = 32;       // deposits under way at most: bounds every mailbox
constexpr std::uint64_t crash_every = 50; // messages of one ledger
constexpr auto patience = 30s;            // in which the last acknowledgement must come
constexpr std::uint64_t segment_bytes = std::uint64_t{256} << 10U;
constexpr std::uint64_t trace_bytes = std::uint64_t{4} << 20U;

// Makes a ledger crash at each of the four points in turn. Each ledger has its own entry, and is one actor: no lock.
class regular_crashes final : public rt::crash_points {
public:
  // Before the actors start.
  void watch(std::uint32_t address, std::uint32_t lane) { plans_.at(lane).address = address; }

  void hit(rt::crash_point point, std::uint32_t actor, std::uint64_t) override {
    for (auto& each : plans_)
      if (each.address == actor)
        hit(point, each);
  }

private:
  struct plan {
    std::uint32_t address = std::numeric_limits<std::uint32_t>::max();
    std::uint64_t messages = 0;
    std::size_t crashes = 0;
    bool armed = false;
  };

  static void hit(rt::crash_point point, plan& each) {
    constexpr std::array points{rt::crash_point::before_handler, rt::crash_point::after_handler,
                                rt::crash_point::after_commit, rt::crash_point::before_dispatch};
    if (point == rt::crash_point::before_handler && ++each.messages % crash_every == 0)
      each.armed = true;
    if (!each.armed || point != points.at(each.crashes % points.size()))
      return;
    each.armed = false;
    ++each.crashes;
    throw rt::injected_crash("every 50th message does");
  }

  std::array<plan, lanes> plans_;
};

rt::process_options options_in(const std::filesystem::path& folder, rt::crash_points& crashes) {
  rt::process_options result;
  result.journal.path = folder / "journal.db";
  result.journal.tables = {{"deposit_row", {deposit_table}}};
  result.trace.emplace();
  result.trace->folder = folder / "trace";
  result.trace->flush = 20ms;
  result.trace->segment_bytes = segment_bytes;
  result.trace->total_bytes = trace_bytes;
  result.crashes = &crashes;
  return result;
}

std::int64_t number_in_journal(rt::journal_reader& reader, const std::string& sql) {
  const auto found = reader.database().query_integer(sql);
  if (!found) {
    std::fprintf(stderr, "%s: %s\n", sql.c_str(), found.error().message.c_str());
    std::_Exit(static_cast<int>(rt::exit_code::failed));
  }
  return *found;
}

class victim_world {
public:
  victim_world(rt::process& host, regular_crashes& crashes, rt::journal_reader& reader)
      : host_(host), reader_(reader),
        first_key_(number_in_journal(reader, "SELECT coalesce(max(key), 0) FROM deposit_row") + 1) {
    // The drill is about kills, not patience: no back-off, and never given up.
    rt::child_policy unwearied;
    unwearied.restart = {.intensity = UINT32_MAX, .backoff_initial = 0ms, .backoff_max = 0ms};
    auto& actors = host_.actors();
    const auto ear = actors.add<auditor>({.name = "auditor"}, unwearied, first_key_ - 1, &handled_);
    for (std::uint32_t lane = 0; lane < lanes; ++lane) {
      const auto next = actors.add<ledger>({.name = ledger_name(lane)}, unwearied, ear);
      crashes.watch(actors.number(actors.declared().size() - 1), lane);
      relays_.push_back(actors.add<relay>({.name = "relay_" + std::to_string(lane)}, unwearied, next));
    }
    actors.start();
  }

  // COUNT deposits, each as soon as the window has room for it.
  void feed(std::int64_t count) {
    auto source = host_.actors().make_gateway("source");
    for (std::int64_t sent = 0; sent < count; ++sent) {
      while (sent - handled_ >= window)
        std::this_thread::sleep_for(50us);
      const auto key = first_key_ + sent;
      source.tell(relays_[static_cast<std::size_t>(key % lanes)], deposit{key});
    }
  }

  // What did not happen within the patience, if anything.
  [[nodiscard]] std::optional<std::string> wait_for_all(std::int64_t count) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (handled_ < count || number_in_journal(reader_, "SELECT count(*) FROM effect") != 0) {
      if (std::chrono::steady_clock::now() > end)
        return std::to_string(handled_) + " of " + std::to_string(count) + " deposits are acknowledged, no more come";
      std::this_thread::sleep_for(1ms);
    }
    // The deposits go round the ledgers.
    const auto crashes_due = static_cast<std::uint64_t>(count) / lanes / crash_every * lanes;
    if (const auto restarts = host_.actors().restarts(); restarts < crashes_due)
      return std::to_string(restarts) + " restarts instead of " + std::to_string(crashes_due) + " or more";
    return std::nullopt;
  }

private:
  rt::process& host_;
  rt::journal_reader& reader_;
  const std::int64_t first_key_;
  std::atomic<std::int64_t> handled_{0};
  std::vector<depositor_handle> relays_;
};

int run(const std::filesystem::path& folder, std::optional<std::int64_t> count) {
  regular_crashes crashes;
  auto host = rt::process::open(options_in(folder, crashes));
  if (!host) {
    std::fprintf(stderr, "%s\n", host.error().c_str());
    return static_cast<int>(rt::exit_code::failed);
  }
  auto reader = rt::journal_reader::open(folder / "journal.db");
  if (!reader) {
    std::fprintf(stderr, "%s\n", reader.error().message().c_str());
    return static_cast<int>(rt::exit_code::failed);
  }
  victim_world world(**host, crashes, *reader);
  world.feed(count.value_or(std::numeric_limits<std::int64_t>::max()));
  if (const auto missing = world.wait_for_all(*count)) {
    std::fprintf(stderr, "%s\n", missing->c_str());
    return (*host)->finish(static_cast<int>(rt::exit_code::failed));
  }
  return (*host)->finish(static_cast<int>(rt::exit_code::ok));
}

} // namespace
} // namespace godwit::tests::drill

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    std::fprintf(stderr, "usage: actor_victim FOLDER [COUNT]\n");
    return static_cast<int>(godwit::runtime::exit_code::usage);
  }
  return godwit::tests::drill::run(argv[1], argc == 3 ? std::optional(std::atoll(argv[2])) : std::nullopt);
}
