// A broker of MQTT in virtual time behind the port of fleet_link, with the vices of a real one: away, deaf, refusing,
// slow to acknowledge. The world of it outlives the processes, the port is one for each process.
//
// Between two things that are due nothing happens. Thread: one.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "actors/fleet_link/broker_port.hpp"
#include "messages/fleet_link/types.hpp"

namespace godwit::drill {

// What the broker is like, and what it has taken.
struct broker_world {
  bool is_away = false;                    // nobody answers, and connections are lost
  bool is_deaf = false;                    // connections are made, and nothing comes of it
  bool refuses = false;                    // knows nobody by this name
  std::int64_t takes_ns = 20'000'000;      // from a message to its acknowledgement
  std::vector<std::string> events;         // as they came, repetitions too
  std::map<std::string, std::string> kept; // the newest of each topic that is retained
  std::uint64_t live = 0;                  // messages that are not
  std::uint64_t connects = 0;
  std::int64_t connected_ns = 0; // when it was connected last
};

class simulated_broker final : public fleet_link::broker_port {
public:
  static constexpr std::int64_t never_ns = std::numeric_limits<std::int64_t>::max();
  static constexpr std::int64_t look_ns = 100'000'000;

  using news = std::variant<fleet_link::broker_opened, fleet_link::broker_closed, fleet_link::event_taken,
                            fleet_link::text_left>;

  // WORLD outlives it.
  explicit simulated_broker(broker_world& world) : world_(world) {}
  ~simulated_broker() override { lose(); }

  void open(std::uint64_t attempt, const fleet_link::publication& will) override;
  void close(std::uint64_t upto) override;
  void publish(std::uint64_t attempt, const fleet_link::publication& what) override;

  // What it has to say by then.
  [[nodiscard]] std::vector<news> on_time(std::int64_t now_ns);
  [[nodiscard]] std::int64_t next_deadline_ns() const { return next_ns_; }

private:
  struct arriving {
    std::int64_t due_ns = 0; // 0: as soon as time is known
    fleet_link::publication what;
  };

  // The connection is gone: the broker says so to all others.
  void lose();
  void answer_try(std::vector<news>& to, std::int64_t now_ns);
  void take(std::vector<news>& to, std::int64_t now_ns);

  broker_world& world_;
  std::optional<std::uint64_t> attempt_;
  fleet_link::publication will_;
  bool is_open_ = false;
  std::deque<arriving> on_the_way_;
  std::int64_t next_ns_ = never_ns;
};

} // namespace godwit::drill
