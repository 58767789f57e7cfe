// Any sequence of messages from two stations, in any order and at any time: the vehicle answers who spoke to it and
// nobody else, holds whole plans where it is atomic, says each change, and is idle again when its patience is over.
//
// A failure prints the shrunk sequence, the seed, and the text to run it again (RC_PARAMS).
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include <array>
#include <limits>
#include <map>
#include <ostream>

#include "tests/actors/ground_port/mission_server/server_fixture.hpp"

namespace godwit::ground_port::mission_server::test {

enum class op_kind : std::uint8_t {
  count,
  wanted_items, // a few, each the one that the vehicle asked this station for last
  any_item,
  float_item,
  spoiled_item,
  list,
  request,
  request_in_floats,
  acknowledge,
  cancel,
  clear,
  partial_list,
  flood,
  lock,
  restart,
  wait
};

struct op {
  op_kind kind = op_kind::wait;
  bool is_other = false;    // of the two stations
  std::uint8_t address = 0; // where it is sent to: to the vehicle, but for a few
  std::uint8_t type = 0;
  std::uint16_t arg = 0;
};

std::ostream& operator<<(std::ostream& out, const op& each) {
  constexpr std::array names{"count",   "wanted_items", "any_item", "float_item", "spoiled_item", "list",
                             "request", "floats",       "ack",      "cancel",     "clear",        "partial list",
                             "flood",   "lock",         "restart",  "wait"};
  return out << names.at(static_cast<std::size_t>(each.kind)) << (each.is_other ? " of the other" : "") << " to "
             << int{each.address} << " type " << int{each.type} << " (" << each.arg << ')';
}

} // namespace godwit::ground_port::mission_server::test

namespace rc {

template <>
struct Arbitrary<godwit::ground_port::mission_server::test::op> {
  static Gen<godwit::ground_port::mission_server::test::op> arbitrary() {
    using godwit::ground_port::mission_server::test::op;
    using godwit::ground_port::mission_server::test::op_kind;
    return gen::build<op>(
        gen::set(&op::kind, gen::weightedElement<op_kind>({{20, op_kind::count},
                                                           {30, op_kind::wanted_items},
                                                           {8, op_kind::any_item},
                                                           {3, op_kind::float_item},
                                                           {2, op_kind::spoiled_item},
                                                           {5, op_kind::list},
                                                           {12, op_kind::request},
                                                           {3, op_kind::request_in_floats},
                                                           {3, op_kind::acknowledge},
                                                           {2, op_kind::cancel},
                                                           {2, op_kind::clear},
                                                           {2, op_kind::partial_list},
                                                           {1, op_kind::flood},
                                                           {1, op_kind::lock},
                                                           {1, op_kind::restart},
                                                           {8, op_kind::wait}})),
        gen::set(&op::is_other, gen::weightedElement<bool>({{2, false}, {1, true}})),
        gen::set(&op::address, gen::weightedElement<std::uint8_t>({{30, 0}, {1, 1}, {1, 2}, {1, 3}})),
        gen::set(&op::type, gen::weightedElement<std::uint8_t>({{24, 0}, {3, 1}, {1, 2}, {1, 7}, {1, 255}})),
        gen::set(&op::arg, gen::resize(kNominalSize, gen::inRange<std::uint16_t>(0, 1'000))));
  }
};

} // namespace rc

namespace godwit::ground_port::mission_server::test {
namespace server_property_test {

using mavlink::mav_mission_result;
using mavlink::number;
using mavlink::sender;

constexpr int room = 6; // items of a plan: sometimes too few
constexpr std::array<sender, 4> addresses{vehicle_id, {0, 0}, {1, 55}, {2, 1}};
constexpr sender nobody{};

// One run. Each item that is sent bears a number of its own in param1, so it can be told which of them a plan is made
// of.
class run {
public:
  explicit run(server_profile vehicle) : vehicle_(with_room(vehicle)), server_(vehicle_, vehicle_id) {}

  void play(const std::vector<op>& ops) {
    for (const auto& each : ops)
      play(each);
    come_to_rest();
  }

private:
  struct begun_upload {
    int count = 0;
    int type = 0;
    int first_item = 0; // the number of the next item when it began
  };
  struct sent_item {
    sender by;
    int seq = 0;
  };

  static server_profile with_room(server_profile vehicle) {
    vehicle.capacity = room;
    return vehicle;
  }

  void play(const op& each) {
    const auto by = each.is_other ? other_station : station;
    switch (each.kind) {
    case op_kind::count:
      return say(each, by, count_of(each.arg % (room + 2), each.type));
    case op_kind::wanted_items:
      return give_what_is_wanted(each, by);
    case op_kind::any_item:
      return say(each, by, new_item(by, each.arg % (room + 2), each.type));
    case op_kind::float_item:
      return say(each, by, new_float_item(by, wanted_[by.system].seq, each.type));
    case op_kind::spoiled_item:
      return say(each, by, spoiled_item(by, each.arg, each.type));
    case op_kind::list:
      return say(each, by, list_of(each.type));
    case op_kind::request:
      return say(each, by, request_for<mavlink::mission_request_int>(each.arg % (room + 2), each.type));
    case op_kind::request_in_floats:
      return say(each, by, request_for<mavlink::mission_request>(each.arg % (room + 2), each.type));
    case op_kind::acknowledge:
      return say(each, by, ack_of(mav_mission_result::accepted));
    case op_kind::cancel:
      return say(each, by, ack_of(mav_mission_result::operation_cancelled));
    case op_kind::clear:
      return say(each, by, clear_of(each.type));
    case op_kind::partial_list:
      return say(each, by, part_of(each.arg % room, each.arg / room % room, each.type));
    case op_kind::flood:
      return flood(by);
    case op_kind::lock:
      return server_.lock(each.arg % 2 == 1);
    case op_kind::restart:
      return restart();
    case op_kind::wait:
      return wait(each.arg * 10 * ms);
    }
  }

  template <class M>
  void say(const op& each, sender by, M message) {
    const auto to = addresses.at(each.address);
    message.target_system = to.system;
    message.target_component = to.component;
    wait(each.arg % 7 * ms); // so that what is said to anybody else has been said before
    has_spoken_[by.system] = has_spoken_[by.system] || to.system == vehicle_id.system || to.system == 0;
    if constexpr (std::is_same_v<M, mavlink::mission_count>)
      announced_[by.system].push_back({message.count, message.mission_type, static_cast<int>(items_.size())});
    check(server_.on(by, message, now_ns_), vehicle_.turn_ns == 0 ? by : nobody);
  }

  // Each when the vehicle has had its turn with the one before.
  void give_what_is_wanted(const op& each, sender by) {
    for (int i = 0; i <= each.arg % room; ++i) {
      say(each, by, new_item(by, wanted_[by.system].seq, wanted_[by.system].type));
      wait(vehicle_.turn_ns);
    }
  }

  // All at once, and more than there is room for.
  void flood(sender by) {
    for (std::size_t i = 0; i < max_waiting_messages + 10; ++i)
      say({}, by, request_for<mavlink::mission_request_int>(0));
  }

  mavlink::mission_item_int new_item(sender by, int seq, int type) {
    auto result = waypoint(seq, type);
    result.param1 = static_cast<float>(items_.size());
    items_.push_back({by, seq});
    return result;
  }

  mavlink::mission_item new_float_item(sender by, int seq, int type) {
    const auto item = new_item(by, seq, type);
    mavlink::mission_item result;
    result.seq = item.seq;
    result.frame = item.frame;
    result.command = item.command;
    result.param1 = item.param1;
    result.x = std::numeric_limits<float>::infinity();
    result.y = std::numeric_limits<float>::quiet_NaN();
    result.mission_type = item.mission_type;
    return result;
  }

  mavlink::mission_item_int spoiled_item(sender by, int how, int type) {
    auto result = new_item(by, wanted_[by.system].seq, type);
    result.command = how % 3 == 0 ? std::numeric_limits<std::uint16_t>::max() : result.command;
    result.frame = how % 3 == 1 ? std::numeric_limits<std::uint8_t>::max() : result.frame;
    result.x = how % 3 == 2 ? std::numeric_limits<std::int32_t>::min() : result.x;
    return result;
  }

  void restart() {
    server_.restart();
    RC_ASSERT(server_.is_idle());
  }

  // At each deadline the vehicle does something about it: the next one is later.
  void wait(std::int64_t duration_ns) {
    const auto until_ns = now_ns_ + duration_ns;
    while (server_.next_deadline_ns() <= until_ns) {
      RC_ASSERT(server_.next_deadline_ns() >= now_ns_);
      now_ns_ = server_.next_deadline_ns();
      check(server_.on_time(now_ns_), nobody);
      RC_ASSERT(server_.next_deadline_ns() > now_ns_);
    }
    now_ns_ = until_ns;
  }

  static mavlink::mission_write_partial_list part_of(int first, int last, int type) {
    mavlink::mission_write_partial_list result;
    result.start_index = static_cast<std::int16_t>(first);
    result.end_index = static_cast<std::int16_t>(last);
    result.mission_type = static_cast<std::uint8_t>(type);
    return result;
  }

  // A vehicle that hears nothing more takes what waits, and then loses its patience.
  void come_to_rest() {
    wait(10 * s);
    RC_ASSERT(server_.is_idle());
    RC_ASSERT(server_.next_deadline_ns() == std::numeric_limits<std::int64_t>::max());
    RC_ASSERT(vehicle_.turn_ns != 0 || server_.dropped() == 0U);
  }

  // ONLY is the one station that may be spoken to; `nobody`: each that has spoken.
  void check(const reaction& what, sender only) {
    for (const auto& each : what.messages) {
      const auto to = target_of(each);
      RC_ASSERT(to == station || to == other_station);
      RC_ASSERT(has_spoken_[to.system]);
      RC_ASSERT(only == nobody || to == only);
      note_request(each, to);
    }
    std::array<bool, plan_types> is_changed{};
    for (const auto& each : what.changes) {
      is_changed.at(number(each.type)) = true;
      check_change(each);
    }
    for (std::size_t type = 0; type < plan_types; ++type)
      check_plan(type, is_changed.at(type));
  }

  void note_request(const outgoing& each, sender to) {
    if (const auto* with_int = std::get_if<mavlink::mission_request_int>(&each))
      wanted_[to.system] = {with_int->seq, with_int->mission_type};
    else if (const auto* old = std::get_if<mavlink::mission_request>(&each))
      wanted_[to.system] = {old->seq, old->mission_type};
  }

  void check_change(const plan_change& change) {
    const auto& plan = server_.plan(change.type);
    RC_ASSERT(change.by == station || change.by == other_station);
    RC_ASSERT(plan.id == change.plan_id);
    RC_ASSERT(static_cast<int>(plan.items.size()) == change.count);
    RC_ASSERT((plan.id != 0U) == (change.count != 0 && vehicle_.has_plan_ids));
    if (change.count != 0 && vehicle_.is_atomic)
      RC_ASSERT(is_whole(plan, change));
  }

  // One of the plans that its author announced, from item 0 to the last, each as its author sent it after that.
  bool is_whole(const held_plan& plan, const plan_change& change) {
    for (const auto& upload : announced_[change.by.system]) {
      bool fits = upload.count == change.count && upload.type == number(change.type);
      for (std::size_t seq = 0; fits && seq < plan.items.size(); ++seq) {
        const auto item = static_cast<std::size_t>(plan.items[seq].param1);
        fits = plan.items[seq].seq == seq && items_.at(item).by == change.by &&
               items_.at(item).seq == static_cast<int>(seq) && static_cast<int>(item) >= upload.first_item;
      }
      if (fits)
        return true;
    }
    return false;
  }

  void check_plan(std::size_t type, bool is_changed) {
    const auto& plan = server_.plan(static_cast<mavlink::mav_mission_type>(type));
    RC_ASSERT(plan.items.size() <= static_cast<std::size_t>(room));
    if (!vehicle_.is_atomic)
      return;
    RC_ASSERT(plan.id == checksum_of(plan.items));
    RC_ASSERT(is_changed || plan.id == held_ids_.at(type));
    held_ids_.at(type) = plan.id;
  }

  struct wanted_item {
    int seq = 0;
    int type = 0;
  };

  server_profile vehicle_;
  server server_;
  std::int64_t now_ns_ = 1 * s;
  std::vector<sent_item> items_;
  std::map<int, std::vector<begun_upload>> announced_; // by the system of the station, as all of these
  std::map<int, wanted_item> wanted_;
  std::map<int, bool> has_spoken_;
  std::array<std::uint32_t, plan_types> held_ids_{};
};

// Long enough for several plans.
std::vector<op> any_sequence() { return *rc::gen::scale(3.0, rc::gen::arbitrary<std::vector<op>>()); }

RC_GTEST_PROP(server_property, our_own_server_keeps_its_word_whatever_is_said, ()) {
  run(plain_profile()).play(any_sequence());
}

RC_GTEST_PROP(server_property, px4_keeps_its_word_whatever_is_said, ()) { run(px4_profile()).play(any_sequence()); }

RC_GTEST_PROP(server_property, rover_keeps_its_word_whatever_is_said, ()) {
  run(ardupilot_rover_profile()).play(any_sequence());
}

RC_GTEST_PROP(server_property, copter_keeps_its_word_whatever_is_said, ()) {
  run(ardupilot_copter_profile()).play(any_sequence());
}

} // namespace server_property_test
} // namespace godwit::ground_port::mission_server::test
