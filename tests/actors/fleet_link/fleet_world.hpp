// fleet_link without actors: its core and its durable state in a time that the test moves, on a disk that syncs when it
// is told to, and with a broker that may refuse, be slow, forget to acknowledge, vanish and come back. Thread: one.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "actors/fleet_link/core.hpp"

namespace godwit::tests {

inline constexpr std::int64_t fleet_second = 1'000'000'000;

[[nodiscard]] inline fleet_link::settings fleet_settings() {
  fleet_link::settings result;
  result.broker = io::mqtt::parse_broker_uri("mqtts://fleet.example.org").value();
  result.vehicle = "rover-7";
  return result;
}

[[nodiscard]] inline fleet_link::noted progress_news(std::uint32_t items_done) {
  fleet_link::noted result;
  result.what.push_back({fleet_link::event_kind::progress, "{\"items_done\":" + std::to_string(items_done) + "}"});
  return result;
}

struct fleet_world {
  fleet_world() {
    apply(fleet_link::store_named{"5707e"});
    sync();
  }

  [[nodiscard]] godwit::instant now() const { return {now_ns, wall_began_ns + now_ns}; }

  void apply(const fleet_link::durable_core::event& what) {
    for (const auto& each : fleet_link::durable_core::apply(state, what, now().wall_ns))
      unsynced.push_back(std::get<fleet_link::written>(each).upto);
  }
  void note(std::uint32_t items_done) {
    auto what = progress_news(items_done);
    what.is_late = !core.is_connected();
    apply(what);
  }
  // All that was decided is on the disk.
  void sync() {
    disk = state;
    for (const auto upto : std::exchange(unsynced, {}))
      core.on_written(upto);
  }
  // The process is killed, and a new one begins.
  void kill() {
    state = disk;
    unsynced.clear();
    ++incarnation;
    cut();
    core = fleet_link::core(fleet_settings(), incarnation, "s" + std::to_string(incarnation), incarnation << 24U);
    core.on_written(state.next_number - 1);
  }

  void turn() {
    if (const auto news = core.newly_delivered(state))
      apply(*news);
    execute(core.turn(state, now()));
  }
  void wait(std::int64_t ns) {
    for (const auto end_ns = now_ns + ns; now_ns < end_ns;) {
      now_ns = std::min(end_ns, now_ns + fleet_link::core::beat_ns);
      turn();
    }
  }
  void execute(const fleet_link::effects& all) {
    for (const auto& each : all) {
      if (const auto* open = std::get_if<fleet_link::open_broker>(&each)) {
        attempt = open->attempt;
        will = open->will;
        is_open = false;
        is_silent = false;
      } else if (const auto* sent = std::get_if<fleet_link::publish>(&each)) {
        if (attempt == sent->attempt && is_open && !is_silent)
          on_the_way.push_back(sent->what);
      } else if (const auto* said = std::get_if<fleet_link::announce>(&each)) {
        told.push_back(said->sentence);
      } else {
        attempt.reset();
      }
    }
  }

  // -- the broker
  // It answers a try, if there is one.
  void accept() {
    if (!attempt || is_open)
      return;
    is_open = true;
    execute(core.on_opened({*attempt, max_packet_bytes}, state, now()));
  }
  void refuse(fleet_link::broker_failure why, const std::string& sentence = "no") {
    if (!attempt)
      return;
    const auto which = *attempt;
    cut();
    execute(core.on_closed({which, why, sentence}, now()));
  }
  // The connection is gone, and what was on its way with it; nobody has told yet.
  void cut() {
    attempt.reset();
    is_open = false;
    is_silent = false;
    on_the_way.clear();
  }
  // Nothing gets through any more, and neither side has seen it.
  void fall_silent() {
    is_silent = true;
    on_the_way.clear();
  }
  // The next message arrives; false: there is none. ACKNOWLEDGED: the vehicle hears of it, too.
  bool take(bool acknowledged = true) {
    if (on_the_way.empty())
      return false;
    auto what = std::move(on_the_way.front());
    on_the_way.pop_front();
    bytes += what.payload->size() + what.topic.size();
    if (what.how == fleet_link::publication::kind::event) {
      received.push_back(*what.payload);
      if (acknowledged)
        core.on_taken({*attempt, what.number});
    } else {
      others.push_back(what);
      if (what.how != fleet_link::publication::kind::status && acknowledged)
        core.on_left({*attempt});
    }
    return true;
  }
  // A broker without vices, until nothing is left.
  void deliver_all() {
    for (int rounds = 0; rounds < 1'000'000 && !state.events.empty(); ++rounds) {
      sync();
      wait(fleet_link::core::beat_ns);
      accept();
      while (take()) {
      }
    }
    turn();
  }

  static constexpr std::int64_t wall_began_ns = 1'800'000'000 * fleet_second;
  std::int64_t now_ns = 1'000 * fleet_second;
  std::uint64_t incarnation = 1;
  fleet_link::state state;
  fleet_link::state disk;
  std::vector<std::uint64_t> unsynced;
  fleet_link::core core{fleet_settings(), 1, "s1", std::uint64_t{1} << 24U};
  std::optional<std::uint64_t> attempt;
  std::uint32_t max_packet_bytes = 1024 * 1024;
  bool is_open = false;
  bool is_silent = false;
  fleet_link::publication will;
  std::deque<fleet_link::publication> on_the_way;
  std::vector<std::string> received; // events, as they came
  std::vector<fleet_link::publication> others;
  std::uint64_t bytes = 0;
  std::vector<std::string> told;
};

} // namespace godwit::tests
