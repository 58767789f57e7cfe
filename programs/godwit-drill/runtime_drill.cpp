#include "programs/godwit-drill/runtime_drill.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <thread>
#include <utility>
#include <vector>

#include "programs/godwit-drill/drill_actors.hpp"
#include "programs/godwit-drill/progress_bar.hpp"
#include "runtime/journal/journal_reader.hpp"
#include "runtime/random.hpp"

namespace godwit::drill {

namespace {

constexpr std::uint32_t lanes = 4;         // relays, and ledgers
constexpr std::uint64_t window = 400;      // messages under way at most: bounds every mailbox
constexpr std::uint64_t poison_share = 40; // one in so many plans is a message that crashes every handler
constexpr std::uint64_t kill_share = 4;    // one in so many of the others kills between two messages
constexpr std::uint64_t kills_from_behind =
    8; // so many crashes short of the plan, and actors are killed until it is met
constexpr std::int64_t patience_ns = 30'000'000'000; // without any progress for so long the rest counts as lost

const std::string effect_table = "CREATE TABLE drill_effect(sender INTEGER NOT NULL, seq INTEGER NOT NULL)";

runtime::child_policy unwearied() {
  runtime::child_policy result;
  // The drill measures restarts, not patience: no back-off, and never given up.
  result.restart = {
      .intensity = UINT32_MAX, .backoff_initial = runtime::milliseconds(0), .backoff_max = runtime::milliseconds(0)};
  return result;
}

runtime::address_options named(std::string name) {
  runtime::address_options result;
  result.name = std::move(name);
  result.mailbox_bound = window * 4;
  result.parking_bound = window * 4;
  return result;
}

// The lane of a message; spreads the durable ones, too, over all lanes.
std::uint32_t lane_of(std::uint64_t seq) { return static_cast<std::uint32_t>((seq + seq / durable_every) % lanes); }

class runtime_drill {
public:
  runtime_drill(const runtime_drill_options& options, runtime::process& host, crash_plan& plan)
      : options_(options), host_(host), plan_(plan), random_(options.seed), book_(options.messages) {
    auto& actors = host_.actors();
    const auto auditor_handle = actors.add<auditor>(named("auditor"), unwearied(), &book_);
    for (std::uint32_t i = 0; i < lanes; ++i)
      ledgers_.push_back(actors.add<ledger>(named("ledger_" + std::to_string(i)), unwearied(), auditor_handle));
    for (std::uint32_t i = 0; i < lanes; ++i)
      relays_.push_back(actors.add<relay>(named("relay_" + std::to_string(i)), unwearied(), ledgers_[i]));
  }

  void run(runtime_drill_result& result) {
    const auto began_ns = host_.time().monotonic_ns();
    host_.actors().start();
    auto source = host_.actors().make_gateway("source");
    progress_bar bar(options_.messages);
    const auto stride =
        std::max<std::uint64_t>(1, options_.messages / (std::max<std::uint64_t>(options_.crashes, 1) * 8));
    for (std::uint64_t seq = 1; seq <= options_.messages; ++seq) {
      if (seq % stride == 0)
        crash_what_is_due(seq);
      wait_for_room(seq);
      send(source, seq);
      if (seq % 1024 == 0)
        bar.show(ended(), std::to_string(crashes()) + " crashes");
    }
    wait_for_end();
    plan_.disarm_all();
    bar.show(options_.messages, std::to_string(crashes()) + " crashes");
    bar.finish();
    result.seconds = static_cast<double>(host_.time().monotonic_ns() - began_ns) * 1e-9;
    count(result);
  }

  [[nodiscard]] std::uint64_t durable_handled() const {
    std::uint64_t result = 0;
    for (auto seq = durable_every; seq <= options_.messages; seq += durable_every)
      result += book_.is_done(seq) ? 1 : 0;
    return result;
  }

private:
  void send(runtime::gateway& source, std::uint64_t seq) {
    const auto lane = lane_of(seq);
    const bool poison = poison_due_ > 0 && !is_durable(seq);
    poison_due_ -= poison ? 1 : 0;
    source.tell(relays_[lane], work{lane, seq, poison});
  }

  // Keeps the number of crashes in step with the number of messages, and done a little before the last message.
  void crash_what_is_due(std::uint64_t seq) {
    const auto due = std::min(options_.crashes, seq * options_.crashes * 50 / (options_.messages * 49) + 1);
    const auto happened = crashes();
    if (happened >= due)
      return;
    if (due - happened < kills_from_behind) {
      plan_one_crash();
      return;
    }
    // The plan waits for traffic that may not come; killing does not.
    while (crashes() < due && !kill_someone())
      std::this_thread::yield();
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }

  bool kill_someone() { return host_.actors().kill_child(random_.below(host_.actors().declared().size())); }

  // A poisoned message (which crashes max_crashes times), a kill between two messages, or a throw at some point.
  void plan_one_crash() {
    if (random_.below(poison_share) == 0) {
      ++poison_due_;
      return;
    }
    if (random_.below(kill_share) == 0) {
      (void)kill_someone();
      return;
    }
    constexpr std::array points{runtime::crash_point::before_handler, runtime::crash_point::after_handler,
                                runtime::crash_point::after_commit, runtime::crash_point::before_dispatch};
    // The auditor writes into the drill's book, which no crash takes back; only a ledger commits.
    const auto child = random_.below(host_.actors().declared().size());
    const bool is_auditor = child == 0;
    const bool is_ledger = child >= 1 && child <= lanes;
    const auto point = points.at(is_auditor ? 0 : random_.below(is_ledger ? 4 : 2));
    (void)plan_.arm(host_.actors().number(child), point);
  }

  [[nodiscard]] std::uint64_t ended() const { return book_.done() + sum(&runtime::address_counters::dead_lettered); }
  [[nodiscard]] std::uint64_t crashes() const { return sum(&runtime::address_counters::crashes); }
  [[nodiscard]] std::uint64_t sum(std::uint64_t runtime::address_counters::*counter) const {
    std::uint64_t result = 0;
    for (std::size_t child = 0; child < host_.actors().declared().size(); ++child)
      result += host_.actors().counters(child).*counter;
    return result;
  }

  void wait_for_room(std::uint64_t seq) {
    while (seq - book_.done() > window && seq - ended() > window)
      std::this_thread::sleep_for(std::chrono::microseconds(50));
  }

  void wait_for_end() {
    auto last = ended();
    auto last_change_ns = host_.time().monotonic_ns();
    while (last < options_.messages && host_.time().monotonic_ns() - last_change_ns < patience_ns) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (const auto now = ended(); now != last) {
        last = now;
        last_change_ns = host_.time().monotonic_ns();
      }
    }
  }

  void count(runtime_drill_result& result) const {
    result.sent = options_.messages;
    result.handled = book_.done();
    result.doubled = book_.repeated();
    result.crashes = crashes();
    result.restarts = host_.actors().restarts();
    auto latencies = plan_.latencies_ns();
    std::sort(latencies.begin(), latencies.end());
    const auto quantile_us = [&](double share) {
      const auto last = static_cast<double>(latencies.size()) - 1;
      return latencies.empty() ? 0.0 : static_cast<double>(latencies[static_cast<std::size_t>(share * last)]) * 1e-3;
    };
    result.restart_p50_us = quantile_us(0.5);
    result.restart_p99_us = quantile_us(0.99);
    result.restart_max_us = quantile_us(1.0);
  }

  const runtime_drill_options& options_;
  runtime::process& host_;
  crash_plan& plan_;
  runtime::random_source random_;
  audit book_;
  std::vector<worker_handle> ledgers_;
  std::vector<worker_handle> relays_;
  std::uint64_t poison_due_ = 0;
};

// What the journal says, read as anybody could with the sqlite3 shell.
tl::expected<void, std::string> count_in_journal(const std::string& path, runtime_drill_result& result) {
  auto reader = runtime::journal_reader::open(path);
  if (!reader)
    return tl::unexpected(reader.error().message());
  const auto number = [&](const std::string& sql) { return reader->database().query_integer(sql); };
  const auto rows = number("SELECT count(*) FROM drill_effect");
  const auto different = number("SELECT count(*) FROM (SELECT DISTINCT sender, seq FROM drill_effect)");
  const auto dead =
      number("SELECT count(DISTINCT json_extract(body, '$.seq')) FROM dead_letter WHERE type = 'drill.work'");
  if (!rows || !different || !dead)
    return tl::unexpected(path + " can not be counted: " +
                          (!rows        ? rows
                           : !different ? different
                                        : dead)
                              .error()
                              .message);
  result.effects_found = static_cast<std::uint64_t>(*rows);
  result.doubled += static_cast<std::uint64_t>(*rows - *different);
  result.dead_lettered = static_cast<std::uint64_t>(*dead);
  result.lost = result.sent - std::min(result.sent, result.handled + result.dead_lettered);
  return {};
}

} // namespace

tl::expected<runtime_drill_result, std::string> run_runtime_drill(runtime_drill_options options) {
  const auto path = options.process.journal.path;
  if (std::filesystem::exists(path))
    return tl::unexpected(
        path + " is there already. The drill counts on an empty journal: name another file, or move this one away");
  const runtime::system_time time;
  crash_plan plan(time);
  options.process.journal.tables = {{"drill_effect", {effect_table}}};
  options.process.crashes = &plan;
  options.process.seed = options.seed;
  auto host = runtime::process::open(options.process);
  if (!host)
    return tl::unexpected(host.error());
  runtime_drill_result result;
  {
    runtime_drill drill(options, **host, plan);
    drill.run(result);
    (void)(*host)->finish(static_cast<int>(runtime::exit_code::failed));
    result.effects_expected = drill.durable_handled();
  }
  const auto traced = (*host)->traced();
  result.trace_records = traced.recorded;
  result.trace_dropped = traced.dropped + traced.unwritten;
  result.journal_commits = (*host)->journal().status().commits;
  if (auto counted = count_in_journal(path, result); !counted)
    return tl::unexpected(counted.error());
  return result;
}

nlohmann::json to_json(const runtime_drill_result& r, std::uint64_t seed) {
  return {{"sent", r.sent},
          {"handled", r.handled},
          {"dead_lettered", r.dead_lettered},
          {"lost", r.lost},
          {"doubled", r.doubled},
          {"effects_expected", r.effects_expected},
          {"effects_found", r.effects_found},
          {"crashes", r.crashes},
          {"restarts", r.restarts},
          {"restart_p50_us", r.restart_p50_us},
          {"restart_p99_us", r.restart_p99_us},
          {"restart_max_us", r.restart_max_us},
          {"trace_records", r.trace_records},
          {"trace_dropped", r.trace_dropped},
          {"journal_commits", r.journal_commits},
          {"seconds", r.seconds},
          {"seed", seed}};
}

namespace {

constexpr std::size_t name_width = 28;
constexpr std::size_t value_width = 14;

// 1234567 -> "1,234,567"
std::string grouped(std::uint64_t value) {
  auto digits = std::to_string(value);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), 1, ',');
  return digits;
}

std::string fixed(double value, int decimals) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

void add_row(std::string& table, const std::string& name, const std::string& value) {
  table += "  " + name + std::string(name_width - std::min(name_width, name.size()), ' ') +
           std::string(value_width - std::min(value_width, value.size()), ' ') + value + '\n';
}

} // namespace

std::string to_table(const runtime_drill_result& r) {
  const std::array counts{std::pair{"sent", r.sent},
                          std::pair{"handled", r.handled},
                          std::pair{"dead-lettered", r.dead_lettered},
                          std::pair{"lost", r.lost},
                          std::pair{"doubled", r.doubled},
                          std::pair{"durable effects acknowledged", r.effects_expected},
                          std::pair{"durable effects in the table", r.effects_found},
                          std::pair{"crashes", r.crashes},
                          std::pair{"restarts", r.restarts}};
  std::string table;
  for (const auto& [name, value] : counts)
    add_row(table, name, grouped(value));
  add_row(table, "restart latency p50", fixed(r.restart_p50_us, 0) + " us");
  add_row(table, "restart latency p99", fixed(r.restart_p99_us, 0) + " us");
  add_row(table, "restart latency max", fixed(r.restart_max_us, 0) + " us");
  add_row(table, "trace records", grouped(r.trace_records));
  add_row(table, "trace records dropped", grouped(r.trace_dropped));
  add_row(table, "journal commits", grouped(r.journal_commits));
  add_row(table, "seconds", fixed(r.seconds, 2));
  return table;
}

void crash_plan::hit(runtime::crash_point point, std::uint32_t actor, std::uint64_t) {
  auto& slot = slots_.at(actor);
  if (const auto crashed_at_ns = slot.crashed_at_ns.load(std::memory_order_relaxed); crashed_at_ns != 0) {
    slot.crashed_at_ns.store(0, std::memory_order_relaxed);
    const std::lock_guard guard(mutex_);
    latencies_ns_.push_back(time_.monotonic_ns() - crashed_at_ns);
  }
  if (slot.armed.load(std::memory_order_relaxed) != static_cast<std::uint8_t>(point))
    return;
  slot.armed.store(idle);
  slot.crashed_at_ns.store(time_.monotonic_ns());
  throw runtime::injected_crash("planned by the drill");
}

std::vector<std::int64_t> crash_plan::latencies_ns() const {
  const std::lock_guard guard(mutex_);
  return latencies_ns_;
}

} // namespace godwit::drill
