// A map store in memory that answers as the real one, and what one process sees of it: an actor in front of it.
//
// What it holds outlives the processes, as the real one's file does; a load under way does not outlive its process.
// Thread: one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "messages/mapobjects_store/handle.hpp"
#include "runtime/actor_base.hpp"

namespace godwit::mission_client::test {

namespace store = mapobjects_store;

struct scripted_batch {
  store::batch what;
  bool is_orphaned = false;
};

struct scripted_store {
  // What it holds.
  std::map<std::string, std::vector<store::observation>> observations; // pending, by mission
  std::map<std::string, std::vector<store::ignored_item>> ignored;
  std::map<std::string, scripted_batch> batches; // taken, by key
  std::vector<std::string> delivered_keys;
  std::map<std::string, std::vector<store::observation>> orphans;
  std::string chosen;
  store::sync_state sync = store::sync_state::fresh_boot;
  bool has_copy = false;
  std::vector<store::map_object> objects; // the map
  std::vector<store::ignored_item> ignored_map;
  std::vector<std::string> deleted_missions;

  // A load under way.
  std::int64_t load = 0;
  std::int64_t loads = 0;
  std::vector<store::map_object> loaded_objects;
  std::vector<store::ignored_item> loaded_ignored;
  std::vector<std::string> removed;
  std::int64_t pages = 0;
  std::string mark; // of the map

  // Faults.
  bool is_busy = false;
  int given_up_loads = 0; // so many pages are answered with load_given_up

  void owe(const std::string& mission, int observations_count, int ignored_count = 0);
  [[nodiscard]] std::size_t owed() const; // rows that are not delivered, orphans not counted

  store::map_answer choose(const store::choose_mission& m);
  store::load_answer begin(const store::begin_load& m);
  store::load_answer put(const store::load_page& m);
  store::load_answer finish(const store::finish_load& m);
  store::map_answer fail(const store::pull_failed& m);
  store::batch take(const store::take_batch& m);
  [[nodiscard]] store::open_batches open() const;
  store::map_answer deliver(const store::batch_delivered& m);
  store::map_answer give_back(const store::return_batch& m);
  store::map_answer accept_copy(const store::acknowledge_fallback& m);
  store::moved_rows set_aside(const std::string& mission);
  store::moved_rows requeue(const store::requeue_mission& m);
  [[nodiscard]] store::owed_list list_owed() const;
  [[nodiscard]] store::map_status status() const;

private:
  std::uint64_t made_ = 0;
};

class store_actor final : public runtime::actor_base<store::client_handle> {
public:
  store_actor(runtime::spawn_context context, scripted_store* held) : actor_base(std::move(context)), held_(held) {}

protected:
  behavior_type handlers() override;

private:
  scripted_store* held_;
};

} // namespace godwit::mission_client::test
