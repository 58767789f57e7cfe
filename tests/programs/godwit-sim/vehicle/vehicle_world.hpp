// A simulated vehicle and one ground station beside it, in virtual time: no sockets, nothing is lost, nothing is late.
//
//   vehicle_world world(personality::px4);
//   EXPECT_EQ(world.upload(square(world.home())), mav_mission_result::accepted);
//   EXPECT_EQ(world.command(mav_cmd::mission_start), mav_result::accepted);
//   EXPECT_TRUE(world.run_until([&] { return !world.picture().armed; }, 300 * s));
//
// More lines can be added, with other stations on them: send() has their number and sender.
//
// All that the vehicle says is kept, with its time and line. Time stands still but for the run_ functions. After each
// event the vehicle's next deadline must lie ahead; a vehicle that wants to be woken for nothing is a failure.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/mavlink/enums.hpp"
#include "io/mavlink/messages.hpp"
#include "programs/godwit-sim/vehicle/vehicle.hpp"

namespace godwit::sim::test {

namespace mavlink = io::mavlink;
using mavlink::mav_cmd;
using mavlink::mav_mission_result;
using mavlink::mav_mission_type;
using mavlink::mav_result;

inline constexpr std::int64_t ms = 1'000'000;
inline constexpr std::int64_t s = 1'000 * ms;

inline constexpr mavlink::sender vehicle_id{1, 1};
inline constexpr mavlink::sender station_id{255, 190};

using plan = std::vector<mavlink::mission_item_int>;

// What was heard: one frame.
struct heard {
  std::int64_t at_ns = 0;
  vehicle::line_number line = 0;
  std::uint32_t id = 0;
  std::vector<std::byte> bytes;

  template <mavlink::message M>
  [[nodiscard]] M as() const {
    return mavlink::decode<M>(mavlink::frame_view(bytes.data()));
  }
};

struct order_params {
  float p1 = 0;
  float p2 = 0;
  float p3 = 0;
  float p4 = 0;
  float p5 = 0;
  float p6 = 0;
  float p7 = 0;
};

class vehicle_world {
public:
  static constexpr std::int64_t start_ns = 1'000 * s;

  explicit vehicle_world(personality who) : vehicle_world(vehicle_settings{.who = who}) {}
  // BEATS: as with beat().
  explicit vehicle_world(const vehicle_settings& settings, bool beats = true);
  vehicle_world(const vehicle_world&) = delete;
  vehicle_world& operator=(const vehicle_world&) = delete;

  // -- time
  void run_for(std::int64_t duration_ns);
  // False: not within the time.
  [[nodiscard]] bool run_until(const std::function<bool()>& done, std::int64_t at_most_ns);
  [[nodiscard]] std::int64_t now_ns() const { return now_ns_; }
  [[nodiscard]] int wakes() const { return wakes_; }
  // Whether the station sends a HEARTBEAT each second; it does.
  void beat(bool beats) { beats_ = beats; }

  vehicle::line_number add_line();

  // -- the station speaks
  template <mavlink::message M>
  void send(const M& message, mavlink::sender from = station_id, vehicle::line_number line = 0) {
    send_frame(mavlink::encode(message, from, sequence_++).view(), line);
  }
  void send_frame(const mavlink::frame_view& frame, vehicle::line_number line = 0) {
    vehicle_.on_frame(frame, now_ns_, line);
    check_deadline();
  }
  // The answer to a COMMAND_LONG; none: it did not answer at once.
  std::optional<mav_result> command(mav_cmd what, const order_params& with = {}) {
    return command(mavlink::number(what), with);
  }
  std::optional<mav_result> command(std::uint16_t what, const order_params& with = {});
  std::optional<mav_result> command_int(mav_cmd what, const mavlink::command_int& with);

  // Request by request; none: it fell silent.
  std::optional<mav_mission_result> upload(plan items, mav_mission_type type = mav_mission_type::mission);
  std::optional<plan> download(mav_mission_type type = mav_mission_type::mission);
  std::optional<mav_mission_result> clear(mav_mission_type type = mav_mission_type::mission);

  // Into the state in which it flies: its mode, armed. False: it refused.
  [[nodiscard]] bool make_ready();

  // -- what was heard
  [[nodiscard]] const std::vector<heard>& all() const { return heard_; }
  // What came before is passed over from now on.
  void mark() { mark_ = heard_.size(); }
  // Of all lines, or of one.
  template <mavlink::message M>
  [[nodiscard]] std::vector<M> each(std::optional<vehicle::line_number> line = {}) const {
    std::vector<M> result;
    for (auto i = mark_; i < heard_.size(); ++i)
      if (heard_[i].id == M::message_id && heard_[i].line == line.value_or(heard_[i].line))
        result.push_back(heard_[i].as<M>());
    return result;
  }
  // Of all times.
  template <mavlink::message M>
  [[nodiscard]] std::optional<M> last() const {
    for (auto i = heard_.size(); i-- > 0;)
      if (heard_[i].id == M::message_id)
        return heard_[i].as<M>();
    return std::nullopt;
  }
  // When the last one came.
  template <mavlink::message M>
  [[nodiscard]] std::int64_t last_ns() const {
    for (auto i = heard_.size(); i-- > 0;)
      if (heard_[i].id == M::message_id)
        return heard_[i].at_ns;
    return -1;
  }
  // Since the mark; of all lines, or of one.
  [[nodiscard]] std::vector<std::string> texts(std::optional<vehicle::line_number> line = {}) const;
  [[nodiscard]] bool said(const std::string& text, std::optional<vehicle::line_number> line = {}) const;
  [[nodiscard]] std::vector<int> reached() const; // sequences, since the mark

  [[nodiscard]] vehicle_picture picture() const { return vehicle_.describe(); }
  [[nodiscard]] const position& home() const { return settings_.home; }
  [[nodiscard]] vehicle& subject() { return vehicle_; }

private:
  void hear(std::span<const std::byte> bytes, vehicle::line_number line);
  void check_deadline() const;
  void run_to(std::int64_t until_ns);
  [[nodiscard]] std::optional<mav_result> answer_since(std::size_t from, std::uint16_t what) const;

  vehicle_settings settings_;
  std::int64_t now_ns_ = start_ns;
  std::int64_t next_beat_ns_ = start_ns;
  bool beats_ = true;
  std::uint8_t sequence_ = 0;
  vehicle::line_number lines_added_ = 0;
  int wakes_ = 0;
  std::size_t mark_ = 0;
  std::vector<heard> heard_;
  vehicle vehicle_;
};

// -- plans ------------------------------------------------------------------------------------------

// So many metres north and east of home, and so high above it.
struct offset {
  double north_m = 0;
  double east_m = 0;
  float up_m = 0;
};
[[nodiscard]] mavlink::mission_item_int item_at(mav_cmd command, const position& home, const offset& where);
[[nodiscard]] mavlink::mission_item_int bare_item(mav_cmd command, float param1 = 0, float param2 = 0);
// COUNT waypoints in a row, SPACING_M apart, numbered from 0.
[[nodiscard]] plan row_of(int count, const position& home, double spacing_m = 5);
// Take-off, COUNT waypoints, landing; item 0 is a stand-in for home where the vehicle is an ArduPilot.
[[nodiscard]] plan flight_of(int count, const position& home, personality who);
// Ends with a return in place of its last item.
[[nodiscard]] plan with_return(plan items);
[[nodiscard]] plan numbered(plan items);

} // namespace godwit::sim::test
