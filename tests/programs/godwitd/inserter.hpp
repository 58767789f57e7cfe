// Stands for whoever confirms a target in flight: asks once in effect for a waypoint, as soon as the map is there.
//
// The key is the same in each run, as it would be for who keeps it over a crash. Thread: as actor_base.
#pragma once

#include <chrono>
#include <string>
#include <utility>

#include "messages/mission_client/handle.hpp"
#include "runtime/actor_base.hpp"
#include "runtime/define_message.hpp"

namespace godwit::test {

struct look {
  static constexpr auto fields = io::table("inserter.look");
};

using inserter_handle = runtime::mailbox<runtime::tells<look>>;

class inserter final : public runtime::actor_base<inserter_handle> {
public:
  inserter(runtime::spawn_context context, mission_client::own_handle client, std::string mission_id)
      : actor_base(std::move(context)), client_(std::move(client)), mission_id_(std::move(mission_id)) {}

protected:
  behavior_type handlers() override {
    return {on<look>([this](const look&) { look_at_service(); })};
  }
  void started() override { tell(me(), look{}); }

private:
  void look_at_service() {
    ask(
        client_, std::chrono::seconds(5), mission_client::get_service{},
        [this](const mission_client::service_status& now) { insert_or_wait(now); },
        [this](const runtime::ask_error&) { tell(me(), look{}); });
  }

  void insert_or_wait(const mission_client::service_status& now) {
    if (now.mission_id != mission_id_ || now.pull != mission_client::pull_state::synced) {
      tell_after(std::chrono::milliseconds(2), me(), look{});
      return;
    }
    if (now.revision != 1)
      return;
    auto key = mission_id_;
    key[0] = 'a';
    mission_client::insert_waypoint wanted;
    wanted.mission_id = mission_id_;
    wanted.insert.idempotency_key = key;
    wanted.insert.base_revision = 1;
    wanted.insert.after_item_id = "w1";
    wanted.insert.waypoint = mission::waypoint{"look-1", {47.3988, 8.5469, 30}, 0, 2, {}};
    tell(client_, wanted);
  }

  mission_client::own_handle client_;
  std::string mission_id_;
};

} // namespace godwit::test
