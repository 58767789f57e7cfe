#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "actors/domain/geo/geodesic.hpp"
#include "actors/domain/geo/mgrs.hpp"
#include "actors/domain/uuid/uuid.hpp"
#include "actors/mapobjects_store/map_row.hpp"
#include "actors/mapobjects_store/mission_scope.hpp"
#include "actors/mapobjects_store/object_table.hpp"
#include "actors/mapobjects_store/pass_review.hpp"
#include "actors/mapobjects_store/sightings.hpp"
#include "tests/actors/mapobjects_store/map_fixture.hpp"

namespace godwit::mapobjects_store {
namespace map_property_test {

using namespace godwit::tests;

// The map as plain lists, with every rule said once more and none of the tables.
struct model {
  struct thing {
    geo_position at;
    std::uint64_t changed_by = 0; // number of the observation
  };
  struct said {
    observation what;
    std::uint64_t number = 0;
  };

  std::map<std::string, thing> pulled; // by id
  std::map<std::string, thing> here;
  std::set<std::string> pulled_cells;
  std::map<std::string, std::string> cells_here; // id of the ignored item -> cell
  std::map<std::string, said> observations;      // all that there ever were
  std::set<std::string> owed;
  std::set<std::string> orphans;
  std::set<std::string> service; // ids that it was told
  std::uint64_t last_number = 0;
  std::uint64_t contained = 0; // numbers up to here are in what was pulled

  [[nodiscard]] std::map<std::string, geo_position> shown() const {
    std::map<std::string, geo_position> all;
    for (const auto& [id, each] : pulled)
      all[id] = each.at;
    for (const auto& [id, each] : here)
      if (each.changed_by > contained)
        all[id] = each.at;
    return all;
  }

  [[nodiscard]] bool ignores(const geo_position& at) const {
    const auto cell = geo::mgrs_cell(point_of(at), geo::cell_size::m_10);
    for (const auto& [id, each] : cells_here)
      if (each == cell)
        return true;
    return pulled_cells.contains(cell);
  }

  observation record(const sighting& seen) {
    if (const auto known = observations.find(seen.id); known != observations.end())
      return known->second.what;
    std::optional<std::pair<double, std::string>> nearest;
    for (const auto& [id, at] : shown()) {
      const std::pair near(geo::distance_m(point_of(seen.position), point_of(at)), id);
      if (near.first <= 30 && (!nearest || near < *nearest))
        nearest = near;
    }
    const bool unwanted = ignores(seen.position) || (nearest && ignores(shown().at(nearest->second)));
    observation what{seen.id,          seen.mission_id, std::nullopt, observation_kind::found,
                     seen.class_group, seen.position,   seen.at_ns,   seen.confidence};
    if (nearest) {
      what.object_id = nearest->second;
      what.kind = nearest->first > 8 ? observation_kind::moved : observation_kind::existing;
    } else {
      what.object_id = seen.id;
    }
    if (unwanted) {
      what.kind = observation_kind::ignored;
      what.object_id = nearest ? std::optional(nearest->second) : std::nullopt;
    }
    add(what);
    if (what.kind == observation_kind::found || what.kind == observation_kind::moved)
      here[*what.object_id] = {seen.position, last_number};
    return what;
  }

  void add(const observation& what) {
    observations[what.id] = {what, ++last_number};
    owed.insert(what.id);
  }

  void end_pass(const pass_end& pass, const geo_position& centre, double radius_m) {
    for (const auto& [id, at] : shown()) {
      if (geo::distance_m(point_of(centre), point_of(at)) > radius_m || ignores(at))
        continue;
      bool seen = false;
      for (const auto& [key, each] : observations)
        seen = seen || (each.what.object_id == id && each.what.kind != observation_kind::removed_candidate &&
                        each.what.at_ns >= pass.started_ns && !orphans.contains(key));
      const auto missing = ids::derived_uuid(pass.id, id);
      if (!seen && !observations.contains(missing))
        add({missing, pass.mission_id, id, observation_kind::removed_candidate, "vehicle", at, pass.ended_ns,
             pass.confidence});
    }
  }

  void pull(const std::map<std::string, geo_position>& given, std::uint64_t delivered_up_to) {
    pulled.clear();
    for (const auto& [id, at] : given)
      pulled[id] = {at, 0};
    pulled_cells.clear();
    contained = delivered_up_to;
  }

  [[nodiscard]] std::uint64_t delivered_up_to() const {
    std::uint64_t first = last_number + 1;
    for (const auto& id : owed)
      first = std::min(first, observations.at(id).number);
    return first - 1;
  }
};

// The map beside its model, a deliverer, and a service that knows keys and rows.
class world : public map_test {
public:
  void TestBody() override {}

  void see(std::uint64_t id, const geo_position& at) {
    const auto what = seen(id, at, ++now_ns);
    const auto answer = record(what);
    RC_ASSERT(io::equal(answer, expected.record(what)));
  }

  void decline(std::uint64_t id, const geo_position& at) {
    const auto done = store->transact([&](map_tables& t) { return judge(t, verdict_on(id, at)); });
    RC_ASSERT(done && *done);
    expected.cells_here.emplace(uuid(id), (*done)->mgrs_cell);
  }

  void end_pass(std::uint64_t id, const geo_position& centre, double radius_m, std::int64_t started_ns) {
    const pass_end pass{.id = uuid(id),
                        .mission_id = mission_a,
                        .started_ns = started_ns,
                        .ended_ns = ++now_ns,
                        .class_groups = {"vehicle"},
                        .circles = {{centre, radius_m}},
                        .polygons = {},
                        .confidence = 0.5};
    auto job = store->review(pass, [](const map_result<pass_reviewed>& done) { RC_ASSERT(done.has_value()); });
    RC_ASSERT(job && store->run(**job));
    expected.end_pass(pass, centre, radius_m);
  }

  // The service gives back what it was told of, and some things of its own.
  void pull(bool crash_half_way) {
    const auto delivered_up_to = expected.delivered_up_to();
    std::map<std::string, geo_position> given{{uuid(1), place(0)}, {uuid(2), place(200)}};
    for (const auto& [id, at] : expected.shown())
      if (expected.service.contains(id))
        given[id] = at;
    std::vector<map_object> objects;
    for (const auto& [id, at] : given)
      objects.push_back({id, mission_a, "vehicle", at, 1, 1, 0.5});
    if (crash_half_way) {
      const auto page = add_page({.load = begin_load(), .objects = objects, .ignored = {}});
      RC_ASSERT(page.has_value());
      return restart();
    }
    load(objects);
    expected.pull(given, delivered_up_to);
  }

  // The deliverer keeps its keys before it asks; the answer may be lost on the way to it.
  void take_some(std::uint32_t limit, bool answer_is_lost) {
    const auto key = ++last_key;
    const auto taken = take(key, limit);
    if (taken.observations.empty())
      return;
    std::vector<std::string> ids;
    for (const auto& each : taken.observations) {
      RC_ASSERT(expected.owed.contains(each.id));
      RC_ASSERT(in_batches.insert(each.id).second); // it is in no other batch
      ids.push_back(each.id);
    }
    bodies[key] = ids;
    if (!answer_is_lost)
      outbox.insert(key);
  }

  std::vector<open_batch> open_ones() {
    return store->transact([](map_tables& t) { return all_open(t.q); }).value();
  }

  // After a crash of the deliverer: what is open is taken over by its keys.
  void adopt() {
    outbox.clear();
    for (const auto& each : open_ones())
      for (const auto& [key, body] : bodies)
        if (each.key == uuid(key)) {
          RC_ASSERT(each.orphaned == (orphaned_keys.contains(key)));
          if (!each.orphaned)
            outbox.insert(key);
        }
  }

  // Some of the outbox reach the service; of these some answers are lost.
  void deliver_some(std::size_t many, bool answer_is_lost) {
    for (std::size_t i = 0; i < many && i < outbox.size(); ++i)
      push(*std::next(outbox.begin(), static_cast<std::ptrdiff_t>(i)));
    for (std::size_t i = 0; i < many && !outbox.empty() && !answer_is_lost; ++i) {
      resolve(*outbox.begin());
      outbox.erase(outbox.begin());
    }
  }

  void push(std::uint64_t key) {
    const auto body = ids_of(take(key));
    RC_ASSERT(body == bodies.at(key));
    const auto [known, is_new] = service_keys.emplace(key, body);
    RC_ASSERT(known->second == body); // it refuses a known key with another body
    if (is_new)
      for (const auto& id : body)
        RC_ASSERT(expected.service.insert(id).second); // each counts once
  }

  void resolve(std::uint64_t key) {
    delivered(key);
    for (const auto& id : bodies.at(key)) {
      expected.owed.erase(id);
      expected.orphans.erase(id);
    }
    orphaned_keys.erase(key);
  }

  void restart() {
    close();
    open();
  }

  void delete_mission() {
    RC_ASSERT(store->transact([&](map_tables& t) {
                     return mapobjects_store::forget(t, {mission_a, ++now_ns, "gone"});
                   })
                  .has_value());
    expected.orphans.insert(expected.owed.begin(), expected.owed.end());
    expected.owed.clear();
    expected.pulled.clear();
    expected.here.clear();
    expected.pulled_cells.clear();
    expected.cells_here.clear();
    for (const auto& each : open_ones())
      for (const auto& [key, body] : bodies)
        if (each.key == uuid(key))
          orphaned_keys.insert(key);
    outbox.clear(); // its pushes are answered by 404
  }

  void requeue_all() {
    RC_ASSERT(store->transact([](map_tables& t) { return requeue(t, {mission_a}); }).has_value());
    for (auto each = expected.orphans.begin(); each != expected.orphans.end();) {
      if (in_batches.contains(*each)) {
        ++each;
        continue;
      }
      expected.owed.insert(*each);
      each = expected.orphans.erase(each);
    }
  }

  void compare() {
    std::vector<std::string> ids;
    for (const auto& [id, at] : expected.shown())
      ids.push_back(id);
    RC_ASSERT(shown() == ids);
    const auto rows = count("observation WHERE delivery != 'delivered'");
    RC_ASSERT(static_cast<std::size_t>(rows) == expected.owed.size());
    RC_ASSERT(static_cast<std::size_t>(count("orphaned_observation")) == expected.orphans.size());
  }

  // In the end the service has been told everything, whatever happened before.
  void deliver_everything() {
    requeue_all();
    restart();
    adopt();
    outbox.insert(orphaned_keys.begin(), orphaned_keys.end()); // a person wants these delivered too
    take_some(1000, false);
    deliver_some(outbox.size(), false);
    RC_ASSERT(expected.service.size() == expected.observations.size());
    RC_ASSERT(static_cast<std::size_t>(count("observation WHERE delivery = 'delivered'")) ==
              expected.observations.size());
    RC_ASSERT(count("orphaned_observation") == 0);
  }

  model expected;
  std::map<std::uint64_t, std::vector<std::string>> bodies;       // of each key, as they were first given
  std::map<std::uint64_t, std::vector<std::string>> service_keys; // that it has got, with what
  std::set<std::string> in_batches;
  std::set<std::uint64_t> orphaned_keys;
  std::set<std::uint64_t> outbox;
  std::uint64_t last_key = 0xe000000;
  std::int64_t now_ns = 100;
};

RC_GTEST_PROP(map_property, whatever_happens_no_observation_is_lost_and_none_counts_twice, ()) {
  enum step {
    see,
    see_again,
    decline,
    pass,
    pull,
    pull_and_crash,
    take,
    take_and_lose_answer,
    deliver,
    lose_answer,
    crash,
    remove,
    requeue,
    restart,
    garbage,
    steps
  };
  world w;
  std::uint64_t last_id = 100;
  std::vector<std::pair<std::uint64_t, geo_position>> sightings;
  const auto somewhere = [] { return place(*rc::gen::inRange(0, 30) * 7.0, *rc::gen::inRange(0, 3) * 9.0); };
  const auto any_step =
      rc::gen::weightedOneOf<int>({{1, rc::gen::just<int>(see)}, {3, rc::gen::inRange<int>(0, steps)}});
  const auto script = *rc::gen::scale(0.4, rc::gen::container<std::vector<int>>(any_step)); // up to 40 steps
  for (const auto what : script) {
    switch (what) {
    case see:
      sightings.emplace_back(++last_id, somewhere());
      w.see(sightings.back().first, sightings.back().second);
      break;
    case see_again:
      if (!sightings.empty()) {
        const auto& [id, at] = sightings[*rc::gen::inRange<std::size_t>(0, sightings.size())];
        RC_ASSERT(io::equal(w.record(seen(id, at)), w.expected.observations.at(uuid(id)).what));
      }
      break;
    case decline:
      w.decline(++last_id, somewhere());
      break;
    case pass:
      w.end_pass(++last_id, somewhere(), *rc::gen::inRange(0, 200), w.now_ns - *rc::gen::inRange(0, 5));
      break;
    case pull:
    case pull_and_crash:
      w.pull(what == pull_and_crash);
      break;
    case take:
    case take_and_lose_answer:
      w.take_some(*rc::gen::inRange<std::uint32_t>(0, 5), what == take_and_lose_answer);
      break;
    case deliver:
    case lose_answer:
      w.deliver_some(*rc::gen::inRange<std::size_t>(0, 5), what == lose_answer);
      break;
    case crash:
      w.restart();
      w.adopt();
      break;
    case remove:
      w.delete_mission();
      break;
    case requeue:
      w.requeue_all();
      break;
    case restart:
      w.restart();
      break;
    case garbage:
      w.collect_garbage(1'000'000);
      break;
    }
    w.compare();
  }
  w.deliver_everything();
}

RC_GTEST_PROP(map_property, the_order_in_which_objects_came_on_the_map_does_not_matter, ()) {
  const auto places = *rc::gen::container<std::vector<int>>(8, rc::gen::inRange(-4, 4));
  std::vector<map_object> objects;
  for (std::size_t i = 0; i < places.size(); ++i) // few places, so that many are equally near
    objects.push_back(object(i, {0.0001 * places[i], 16, {}}));
  auto other_order = objects;
  std::shuffle(other_order.begin(), other_order.end(), std::mt19937_64(*rc::gen::arbitrary<std::uint64_t>()));
  world one;
  world other;
  one.load(objects);
  other.load(other_order);
  for (int i = -5; i <= 5; ++i) {
    const auto id = std::uint64_t{1000} + static_cast<std::uint64_t>(i);
    const geo_position at{0.00005 * i, 16, {}};
    RC_ASSERT(io::equal(one.record(seen(id, at)), other.record(seen(id, at))));
  }
}

} // namespace map_property_test
} // namespace godwit::mapobjects_store
