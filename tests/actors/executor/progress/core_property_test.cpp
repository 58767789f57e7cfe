// Flights of a model vehicle with everything that can go wrong, and any events in any order.
//
// Each flight is made from one number; it is printed when a flight fails, and TEST_SEED=number begins with that one.
// TEST_FULL=1 makes ten times as many.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include "io/fields/json_text.hpp"
#include "tests/actors/executor/progress/model_flight.hpp"
#include "tests/support/run_options.hpp"

namespace godwit::executor::progress {
namespace core_property_test {

using namespace test;

constexpr int flights = 10'000;
constexpr int flights_if_full = 100'000;
constexpr int kinds_of_vehicle = 3; // these flights are shared among them
constexpr int one_in_is_played_twice = 50;
constexpr int one_in_has_a_calm_one_too = 6;

int flights_of_each_kind() {
  return ((tests::is_full_run() ? flights_if_full : flights) + kinds_of_vehicle - 1) / kinds_of_vehicle;
}

// Of the same flight again, with each event.
std::string log_of(std::uint64_t seed, const flavour& which) {
  model_flight flight(seed, which);
  flight.note_events();
  flight.play();
  return flight.log();
}

class progress_flights : public testing::TestWithParam<flavour> {};

TEST_P(progress_flights, are_reported_truthfully_whatever_happens) {
  const auto first = tests::first_seed();
  const int count = flights_of_each_kind();
  std::uint64_t events = 0;
  const auto began = std::clock();
  for (int i = 0; i < count; ++i) {
    const auto seed = first + static_cast<std::uint64_t>(i);
    model_flight flight(seed, GetParam());
    flight.play();
    events += flight.events();
    ASSERT_EQ(flight.violation(), "") << "to run it again: TEST_SEED=" << seed << "\n" << log_of(seed, GetParam());
    if (i % one_in_is_played_twice == 0) {
      ASSERT_EQ(log_of(seed, GetParam()), log_of(seed, GetParam())) << "another trace: TEST_SEED=" << seed;
    }
  }
  const auto us = 1e6 * static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC / count;
  std::cout << count << " flights from seed " << first << ", " << events / static_cast<std::uint64_t>(count)
            << " events and " << us << " us of processor time each\n";
}

TEST_P(progress_flights, that_are_calm_have_nothing_inferred) {
  const auto first = tests::first_seed();
  for (int i = 0; i < flights_of_each_kind() / one_in_has_a_calm_one_too; ++i) {
    const auto seed = first + static_cast<std::uint64_t>(i);
    model_flight flight(seed, GetParam());
    flight.play_calmly();
    ASSERT_EQ(flight.violation(), "") << "TEST_SEED=" << seed << "\n" << flight.log();
    for (const auto& each : flight.reports())
      ASSERT_FALSE(each.inferred && each.item_id && flight.moves(*each.item_id)) << "TEST_SEED=" << seed << "\n"
                                                                                 << flight.log();
  }
}

INSTANTIATE_TEST_SUITE_P(of, progress_flights, testing::Values(px4, ardupilot, rover),
                         [](const auto& which) { return which.param.name; });

struct happening {
  std::uint8_t what = 0;
  std::uint8_t number = 0;
  std::uint8_t wait = 0;
};

// What the executor may not do at this moment, it does not do.
std::optional<event> event_of(const state& s, const happening& h, std::int32_t revision) {
  const bool is_free = !s.upload && !s.start;
  const auto n = h.number;
  const mission_current current{.seq = static_cast<std::uint16_t>(n % 7 == 6 ? no_sequence : n % 7),
                                .total = static_cast<std::uint16_t>(n % 16 == 15 ? 65535 : n % 5),
                                .mission_state = static_cast<std::uint8_t>(n % 6),
                                .mission_id = n % 4U};
  switch (h.what % 16) {
  case 0:
    return is_free ? std::optional<event>(mission_opened{"m" + std::to_string(n % 3), revision}) : std::nullopt;
  case 1:
    if (!is_free || !s.mission)
      return std::nullopt;
    return upload_intended{n % 3 == 0 ? revision : s.mission->revision,
                           map_of(n % 2 == 0 ? px4 : ardupilot, texts(n % 4U + 1, "x"), n % 5U, n % 8 < 6), n % 4U,
                           std::nullopt};
  case 2:
    if (!is_free || !s.plan)
      return std::nullopt;
    return start_intended{static_cast<std::uint16_t>(s.plan->map.first_sequence + n % s.plan->map.total)};
  case 3:
    return upload_ended{static_cast<upload_verdict>(n % 4), n % 4U, {}};
  case 4:
    return vehicle_looked_at{n % 4U};
  case 5:
    return plan_read_back{static_cast<read_back_match>(n % 3)};
  case 6:
    return start_ended{n % 3 != 0};
  case 7:
    return n % 8 == 0 ? event(mission_aborted{}) : event(vehicle_rebooted{});
  case 8:
  case 9:
  case 10:
    return reached_told{static_cast<std::uint16_t>(n % 6)};
  default:
    return current_told{current};
  }
}

RC_GTEST_PROP(progress_property, any_events_in_any_order_keep_numbers_and_indices_in_order,
              (const std::vector<std::tuple<std::uint8_t, std::uint8_t, std::uint8_t>>& story)) {
  state s;
  std::int64_t now_ns = 0;
  std::int32_t revision = 0;
  std::map<std::string, mission::progress_report> last;
  std::map<std::pair<std::string, std::int32_t>, int> completed;
  for (const auto& [what, number, wait] : story) {
    now_ns += (wait - 8) * 20 * ms;                                      // a clock that may be set back
    const auto happened = event_of(s, {what, number, wait}, ++revision); // the service counts them up
    if (!happened)
      continue;
    const bool mattered = matters(s, *happened, now_ns);
    const auto before = io::to_json(s);
    const auto came = apply(s, *happened, now_ns);
    RC_ASSERT(mattered == (!came.empty() || io::to_json(s) != before));
    for (const auto& each : came) {
      const auto* report = std::get_if<mission::progress_report>(&each);
      if (report == nullptr)
        continue;
      const auto known = last.find(report->mission_id);
      RC_ASSERT(report->report_no == (known == last.end() ? 1 : known->second.report_no + 1));
      if (known != last.end()) {
        RC_ASSERT(report->generation >= known->second.generation);
        if (report->generation == known->second.generation && report->item_index && known->second.item_index)
          RC_ASSERT(*report->item_index >= *known->second.item_index);
      }
      if (report->kind == mission::progress_kind::complete)
        RC_ASSERT(++completed[std::pair(report->mission_id, report->revision)] == 1);
      last[report->mission_id] = *report;
    }
    RC_ASSERT(s.held.size() <= max_held);
    RC_ASSERT(!s.upload || s.upload->generation == s.last_generation + 1);
  }
}

} // namespace core_property_test
} // namespace godwit::executor::progress
