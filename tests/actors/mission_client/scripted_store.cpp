#include "tests/actors/mission_client/scripted_store.hpp"

#include <algorithm>

#include "tests/actors/mission_client/scripted_service.hpp"

namespace godwit::mission_client::test {

namespace {

template <class Rows>
Rows cut(Rows& from, std::size_t limit) {
  const auto upto = from.begin() + static_cast<std::ptrdiff_t>(std::min(limit, from.size()));
  Rows result(from.begin(), upto);
  from.erase(from.begin(), upto);
  return result;
}

store::map_answer busy() { return {store::map_failure::busy, "as the test wants it"}; }

} // namespace

void scripted_store::owe(const std::string& mission, int observations_count, int ignored_count) {
  for (int i = 0; i < observations_count; ++i)
    observations[mission].push_back({uuid(++made_, 'c'),
                                     mission,
                                     {},
                                     store::observation_kind::found,
                                     "vehicle",
                                     {47.4, 8.5, 441.5},
                                     1'800'000'000'000'000'000,
                                     0.5});
  for (int i = 0; i < ignored_count; ++i)
    ignored[mission].push_back({uuid(++made_, 'd'), mission, "32TMT6634049690", "vehicle", 1'800'000'000'000'000'000});
}

std::size_t scripted_store::owed() const {
  std::size_t result = 0;
  for (const auto& [mission, rows] : observations)
    result += rows.size();
  for (const auto& [mission, rows] : ignored)
    result += rows.size();
  for (const auto& [key, each] : batches)
    result += each.is_orphaned ? 0 : each.what.observations.size() + each.what.ignored_items.size();
  return result;
}

// -- the load -------------------------------------------------------------------------------------

store::map_answer scripted_store::choose(const store::choose_mission& m) {
  if (is_busy)
    return busy();
  if (chosen != m.mission_id)
    sync = store::sync_state::fresh_boot;
  chosen = m.mission_id;
  return {};
}

store::load_answer scripted_store::begin(const store::begin_load&) {
  load = ++loads;
  loaded_objects.clear();
  loaded_ignored.clear();
  removed.clear();
  pages = 0;
  return {load, store::map_failure::none, {}, has_copy ? mark : std::string()};
}

store::load_answer scripted_store::put(const store::load_page& m) {
  if (m.load != load || given_up_loads > 0) {
    given_up_loads -= given_up_loads > 0 ? 1 : 0;
    load = 0;
    return {m.load, store::map_failure::load_given_up, "as the test wants it"};
  }
  if (m.number < pages) // a repetition
    return {m.load, store::map_failure::none, {}};
  ++pages;
  loaded_objects.insert(loaded_objects.end(), m.objects.begin(), m.objects.end());
  loaded_ignored.insert(loaded_ignored.end(), m.ignored.begin(), m.ignored.end());
  removed.insert(removed.end(), m.removed.begin(), m.removed.end());
  return {m.load, store::map_failure::none, {}};
}

store::load_answer scripted_store::finish(const store::finish_load& m) {
  if (m.load != load)
    return {m.load, store::map_failure::load_given_up, "another load"};
  if (m.objects != static_cast<std::int64_t>(loaded_objects.size()) ||
      m.ignored != static_cast<std::int64_t>(loaded_ignored.size()))
    return {m.load, store::map_failure::refused, "another number of rows"};
  for (const auto& each : objects) {
    const bool is_changed = std::ranges::find(loaded_objects, each.id, &store::map_object::id) != loaded_objects.end();
    if (m.is_change && !is_changed && std::ranges::find(removed, each.id) == removed.end())
      loaded_objects.push_back(each);
  }
  objects = loaded_objects;
  ignored_map = loaded_ignored;
  mark = m.mark;
  sync = store::sync_state::synced;
  has_copy = true;
  return {m.load, store::map_failure::none, {}};
}

store::map_answer scripted_store::fail(const store::pull_failed&) {
  load = 0;
  sync = has_copy ? store::sync_state::degraded : store::sync_state::failed;
  return {};
}

// -- what is owed ---------------------------------------------------------------------------------

store::batch scripted_store::take(const store::take_batch& m) {
  if (is_busy)
    return {m.key, m.mission_id, m.to, {}, {}, 0, store::map_failure::busy, "as the test wants it"};
  if (std::ranges::find(delivered_keys, m.key) != delivered_keys.end())
    return {m.key, m.mission_id, m.to, {}, {}, 0, store::map_failure::delivered, "delivered"};
  if (const auto known = batches.find(m.key); known != batches.end())
    return known->second.what;
  store::batch result{m.key, m.mission_id, m.to, {}, {}, 0, store::map_failure::none, {}};
  if (m.to == store::destination::observations)
    result.observations = cut(observations[m.mission_id], m.limit);
  else
    result.ignored_items = cut(ignored[m.mission_id], m.limit);
  if (!result.observations.empty() || !result.ignored_items.empty())
    batches[m.key] = {result, false};
  return result;
}

store::open_batches scripted_store::open() const {
  store::open_batches result;
  for (const auto& [key, each] : batches)
    result.batches.push_back({key, each.what.mission_id, each.what.to, 1, each.is_orphaned});
  return result;
}

store::map_answer scripted_store::deliver(const store::batch_delivered& m) {
  if (is_busy)
    return busy();
  if (batches.erase(m.key) != 0)
    delivered_keys.push_back(m.key);
  return {};
}

store::map_answer scripted_store::give_back(const store::return_batch& m) {
  if (is_busy)
    return busy();
  const auto found = batches.find(m.key);
  if (found == batches.end())
    return {};
  const auto& what = found->second.what;
  auto& seen = observations[what.mission_id];
  seen.insert(seen.begin(), what.observations.begin(), what.observations.end());
  auto& rest = ignored[what.mission_id];
  rest.insert(rest.begin(), what.ignored_items.begin(), what.ignored_items.end());
  batches.erase(found);
  delivered_keys.push_back(m.key);
  return {};
}

store::map_answer scripted_store::accept_copy(const store::acknowledge_fallback& m) {
  if (is_busy)
    return busy();
  if (chosen != m.mission_id || (sync != store::sync_state::degraded && sync != store::sync_state::cached_fallback))
    return {store::map_failure::refused, "there is nothing to acknowledge"};
  sync = store::sync_state::cached_fallback;
  return {};
}

store::moved_rows scripted_store::set_aside(const std::string& mission) {
  auto& rows = observations[mission];
  orphans[mission].insert(orphans[mission].end(), rows.begin(), rows.end());
  rows.clear();
  for (auto& [key, each] : batches)
    each.is_orphaned = each.is_orphaned || each.what.mission_id == mission;
  return {};
}

store::moved_rows scripted_store::requeue(const store::requeue_mission& m) {
  for (auto& [mission, rows] : orphans)
    if (m.mission_id.empty() || m.mission_id == mission) {
      observations[mission].insert(observations[mission].end(), rows.begin(), rows.end());
      rows.clear();
    }
  for (auto& [key, each] : batches)
    if (m.mission_id.empty() || m.mission_id == each.what.mission_id)
      each.is_orphaned = false;
  return {};
}

store::owed_list scripted_store::list_owed() const {
  store::owed_list result;
  for (const auto& [mission, rows] : observations)
    if (!rows.empty())
      result.missions.push_back({mission, store::destination::observations, rows.size(), 0, 0});
  for (const auto& [mission, rows] : ignored)
    if (!rows.empty())
      result.missions.push_back({mission, store::destination::ignored_items, rows.size(), 0, 0});
  for (const auto& [key, each] : batches)
    if (!each.is_orphaned)
      result.missions.push_back({each.what.mission_id, each.what.to, 0, 1, 0});
  return result;
}

store::map_status scripted_store::status() const {
  store::map_status result;
  result.mission_id = chosen;
  result.sync = sync;
  result.objects = objects.size();
  return result;
}

store_actor::behavior_type store_actor::handlers() {
  return {on<store::choose_mission>([this](const auto& m) { return held_->choose(m); }),
          on<store::begin_load>([this](const auto& m) { return held_->begin(m); }),
          on<store::load_page>([this](const auto& m) { return held_->put(m); }),
          on<store::finish_load>([this](const auto& m) { return held_->finish(m); }),
          on<store::pull_failed>([this](const auto& m) { return held_->fail(m); }),
          on<store::acknowledge_fallback>([this](const auto& m) { return held_->accept_copy(m); }),
          on<store::take_batch>([this](const auto& m) { return held_->take(m); }),
          on<store::get_batches>([this](const auto&) { return held_->open(); }),
          on<store::batch_delivered>([this](const auto& m) { return held_->deliver(m); }),
          on<store::return_batch>([this](const auto& m) { return held_->give_back(m); }),
          on<store::delete_mission>([this](const auto& m) {
            held_->deleted_missions.push_back(m.mission_id);
            return held_->set_aside(m.mission_id);
          }),
          on<store::orphan_mission>([this](const auto& m) { return held_->set_aside(m.mission_id); }),
          on<store::requeue_mission>([this](const auto& m) { return held_->requeue(m); }),
          on<store::get_owed>([this](const auto&) { return held_->list_owed(); }),
          on<store::get_map>([this](const auto&) { return held_->status(); })};
}

} // namespace godwit::mission_client::test
