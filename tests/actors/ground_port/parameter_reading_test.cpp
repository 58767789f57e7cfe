// A station that reads all parameters through the port, against one that has the vehicle's radio to itself.
//
//   direct    station <-radio-> vehicle
//   through   station <-radio-> ground_port's core <-> vehicle_link's core <-wire-> vehicle
//
// Both cores are the real ones, with the real lists and budgets; mailboxes and threads between them take no time here.
#include <deque>
#include <functional>
#include <iostream>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "actors/vehicle_link/core.hpp"
#include "io/mavlink/messages/param.hpp"
#include "tests/actors/ground_port/port_fixture.hpp"
#include "tests/support/virtual_time.hpp"

namespace godwit::ground_port {
namespace parameter_reading_test {

using namespace test;

constexpr int parameters = 1'300;
constexpr std::int64_t radio_ns = 30 * ms;
constexpr std::int64_t wire_ns = 2 * ms;
constexpr std::int64_t value_takes_ns = 6 * ms; // of one PARAM_VALUE on the vehicle's line, at 57,600 baud
constexpr std::int64_t patience_ns = 1 * s;     // of the station, before it asks for what is missing
constexpr int asked_at_once = 10;
constexpr double lost = 0.05; // of the frames on the radio, each way

using bytes = std::vector<std::byte>;

template <class M>
bytes frame_of(const M& message, mavlink::sender from) {
  const auto frame = mavlink::encode(message, from, 0);
  return {frame.span().begin(), frame.span().end()};
}

settings router_settings() {
  settings result;
  result.as.component = 1;
  result.passes = true;
  return result;
}

vehicle_link::settings relay_settings() {
  vehicle_link::settings result;
  result.streams.clear();
  result.relays = true;
  return result;
}

// Gives its parameters, all of them or one, in the order in which they are asked for.
class parameter_vehicle {
public:
  parameter_vehicle(tests::virtual_time& time, std::function<void(const bytes&)> says)
      : time_(time), says_(std::move(says)) {}

  void hear(const bytes& what) {
    scan_.feed_datagram(what, [this](const mavlink::frame_view& each) {
      if (each.id() == mavlink::param_request_list::message_id)
        for (int i = 0; i < parameters; ++i)
          queue_.push_back(i);
      if (each.id() == mavlink::param_request_read::message_id)
        queue_.push_back(mavlink::decode<mavlink::param_request_read>(each).param_index);
    });
    if (!is_busy_)
      say_next();
  }

private:
  void say_next() {
    is_busy_ = !queue_.empty();
    if (!is_busy_)
      return;
    mavlink::param_value value;
    value.param_count = parameters;
    value.param_index = static_cast<std::uint16_t>(queue_.front());
    value.param_value = 1;
    queue_.pop_front();
    time_.at(time_.now_ns() + value_takes_ns, [this, value] {
      says_(frame_of(value, autopilot_id));
      say_next();
    });
  }

  tests::virtual_time& time_;
  std::function<void(const bytes&)> says_;
  mavlink::scanner scan_;
  std::deque<int> queue_;
  bool is_busy_ = false;
};

// Asks for the list, and for what is missing one by one, as MAVSDK, QGroundControl and pymavlink do.
class parameter_station {
public:
  parameter_station(tests::virtual_time& time, std::function<void(const bytes&)> says)
      : time_(time), says_(std::move(says)) {}

  void begin() {
    says_(frame_of(mavlink::param_request_list{1, 1}, station_id));
    wait();
  }
  void hear(const bytes& what) {
    scan_.feed_datagram(what, [this](const mavlink::frame_view& each) {
      if (each.id() == mavlink::param_value::message_id && each.from() == autopilot_id)
        heard_.insert(mavlink::decode<mavlink::param_value>(each).param_index);
    });
    heard_ns_ = time_.now_ns();
  }
  [[nodiscard]] bool has_all() const { return heard_.size() == parameters; }

private:
  void wait() {
    time_.at(time_.now_ns() + patience_ns, [this] {
      if (time_.now_ns() - heard_ns_ >= patience_ns)
        ask_for_missing();
      if (!has_all())
        wait();
    });
  }
  void ask_for_missing() {
    int asked = 0;
    for (std::int16_t i = 0; i < parameters && asked < asked_at_once; ++i)
      if (!heard_.contains(static_cast<std::uint16_t>(i))) {
        says_(frame_of(mavlink::param_request_read{1, 1, {}, i}, station_id));
        ++asked;
      }
  }

  tests::virtual_time& time_;
  std::function<void(const bytes&)> says_;
  mavlink::scanner scan_;
  std::set<std::uint16_t> heard_;
  std::int64_t heard_ns_ = 0;
};

class parameter_world {
public:
  explicit parameter_world(bool is_through) : is_through_(is_through) {
    (void)link_.on_link({io::link::link_phase::up, {}, 0}, port_.now());
    beat();
  }

  // How long it takes; none: not within ten minutes.
  [[nodiscard]] std::optional<double> read_all_s() {
    station_.begin();
    while (!station_.has_all() && time_.now_ns() - began_ns < 600 * s)
      time_.run_next();
    return station_.has_all() ? std::optional(static_cast<double>(time_.now_ns() - began_ns) / 1e9) : std::nullopt;
  }
  [[nodiscard]] std::uint64_t dropped() const { return port_.count_of("passing_dropped"); }

private:
  static constexpr std::int64_t began_ns = 1'000 * s; // as the clock of port_fixture

  [[nodiscard]] instant now() {
    port_.advance(time_.now_ns() - port_.now().monotonic_ns);
    return port_.now();
  }
  void after(std::int64_t delay_ns, std::function<void()> what) {
    time_.at(time_.now_ns() + delay_ns, std::move(what));
  }
  void over_radio(const bytes& what, std::function<void(const bytes&)> to) {
    if (std::uniform_real_distribution<double>(0, 1)(rng_) >= lost)
      after(radio_ns, [what, to = std::move(to)] { to(what); });
  }

  void from_station(const bytes& what) {
    over_radio(what, [this](const bytes& heard) {
      if (!is_through_)
        return vehicle_.hear(heard);
      const auto at = now();
      port_.passed_on.clear();
      port_.bytes(io::link::only_peer, heard);
      for (const auto& each : port_.passed_on)
        for (const auto& done : link_.on_relayed(each, at))
          if (const auto* out = std::get_if<vehicle_link::transmission>(&done))
            after(wire_ns,
                  [this, said = bytes(out->frame.span().begin(), out->frame.span().end())] { vehicle_.hear(said); });
    });
  }
  void from_vehicle(const bytes& what) {
    if (!is_through_)
      return over_radio(what, [this](const bytes& heard) { station_.hear(heard); });
    after(wire_ns, [this, what] { to_port(what); });
  }
  void to_port(const bytes& what) {
    const auto at = now();
    port_.forget();
    for (const auto& done : link_.on_bytes(io::link::only_peer, true, what, at))
      if (const auto* told = std::get_if<vehicle_link::announcement>(&done))
        if (const auto* frame = std::get_if<vehicle_link::relayed_frame>(told))
          port_.component_says(*frame);
    for (const auto& each : port_.frames)
      over_radio({each.frame.span().begin(), each.frame.span().end()},
                 [this](const bytes& heard) { station_.hear(heard); });
  }
  // The autopilot's own, each second.
  void beat() {
    const mavlink::heartbeat is{.type = mavlink::number(mavlink::mav_type::quadrotor),
                                .autopilot = mavlink::number(mavlink::mav_autopilot::ardupilotmega)};
    (void)link_.on_bytes(io::link::only_peer, true, frame_of(is, autopilot_id), now());
    port_.vehicle_says(is);
    after(1 * s, [this] { beat(); });
  }

  bool is_through_;
  tests::virtual_time time_{began_ns};
  std::mt19937_64 rng_{7};
  port_fixture port_{router_settings()};
  vehicle_link::core link_{relay_settings(), {}, {}};
  parameter_vehicle vehicle_{time_, [this](const bytes& what) { from_vehicle(what); }};
  parameter_station station_{time_, [this](const bytes& what) { from_station(what); }};
};

TEST(ground_port_figures, parameters_through_the_port_take_at_most_1_2_times_the_time) {
  parameter_world direct(false);
  parameter_world through(true);
  const auto alone = direct.read_all_s();
  const auto routed = through.read_all_s();
  ASSERT_TRUE(alone && routed);
  std::cout << parameters << " parameters: direct " << *alone << " s, through the port " << *routed << " s, ratio "
            << *routed / *alone << "\n";
  EXPECT_LE(*routed, 1.2 * *alone);
  EXPECT_EQ(through.dropped(), 0U);
}

} // namespace parameter_reading_test
} // namespace godwit::ground_port
