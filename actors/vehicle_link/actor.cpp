#include "actors/vehicle_link/actor.hpp"

#include <algorithm>
#include <chrono>

namespace godwit::vehicle_link {

actor::actor(runtime::spawn_context context, settings configured, signing_settings signing, std::shared_ptr<wire> line,
             std::shared_ptr<const listeners> ears)
    : line_actor(std::move(context), std::move(line)), settings_(std::move(configured)), signing_(std::move(signing)),
      ears_(std::move(ears)) {}

actor::~actor() = default;

actor::behavior_type actor::handlers() {
  return {
      on_deferred<send_command, command_outcome>([this](const send_command& what, std::uint64_t request_id) {
        then(core_->on_command(request_id, what, now()));
      }),
      on<set_mode>([this](const set_mode& what) { then(core_->on_set_mode(what, now())); }),
      on_deferred<set_current_item, command_outcome>([this](const set_current_item& what, std::uint64_t request_id) {
        then(core_->on_set_current(request_id, what, now()));
      }),
      on<set_up_signing>([this](const set_up_signing& what) {
        auto [wanted, answer] = core_->on_set_up_signing(what, now());
        then(wanted);
        return answer;
      }),
      on_deferred<upload_plan, transfer::outcome>([this](const upload_plan& what, std::uint64_t request_id) {
        then(core_->on_upload(request_id, what, now()));
      }),
      on_deferred<download_plan, transfer::outcome>([this](const download_plan& what, std::uint64_t request_id) {
        then(core_->on_download(request_id, what, now()));
      }),
      on<cancel_transfer>([this](const cancel_transfer&) { then(core_->on_cancel_transfer(now())); }),
      on_deferred<look, looked>(
          [this](const look&, std::uint64_t request_id) { then(core_->on_look(request_id, now())); }),
      on<watch_closely>([this](const watch_closely& what) { then(core_->on_watch_closely(what, now())); }),
      on<relayed_frame>([this](const relayed_frame& what) { then(core_->on_relayed(what, now())); }),
      on<runtime::child_alive>([this](const runtime::child_alive& what) {
        core_->on_child_alive(what, now());
        wake_at(core_->next_deadline_ns());
      }),
      on<keep_vehicle>([this](const keep_vehicle& what) {
        auto [wanted, kept] = core_->on_keep_vehicle(what, now());
        if (kept)
          commit(*kept);
        then(wanted);
      }),
      on<get_connection>([this](const get_connection&) {
        auto result = core_->describe(now());
        const auto lost = drops();
        result.dropped_in = lost.in;
        result.dropped_out = lost.out;
        return result;
      }),
      on<wake>([this](const wake&) { drain(); })};
}

void actor::started() {
  core_.emplace(settings_, signing_, mavlink::signing_time{current_state().signing_ceiling}, current_state().kept);
  begin_line();
}

// -- effects --------------------------------------------------------------------------------------

void actor::execute(const effects& wanted) {
  for (const auto& each : wanted)
    std::visit([this](const auto& what) { execute(what); }, each);
}

void actor::execute(const resolved_command& each) { answer_later(each.asked_by.request_id, each.outcome); }

void actor::execute(const resolved_transfer& each) { answer_later(each.request_id, each.outcome); }

void actor::execute(const resolved_look& each) { answer_later(each.request_id, each.what); }

void actor::execute(const observation& each) {
  std::visit([this]<class M>(const M& message) { ears_->for_each<M>([&](const auto& who) { tell(who, message); }); },
             each);
}

void actor::execute(const announcement& each) {
  std::visit([this]<class M>(const M& message) { ears_->for_each<M>([&](const auto& who) { tell(who, message); }); },
             each);
}

void actor::dispatch(const durable_core::effect& each) {
  core_->on_reserved(mavlink::signing_time{std::get<signing_time_reserved>(each).ceiling});
}

} // namespace godwit::vehicle_link
