#include "actors/vehicle_link/actor.hpp"

#include <algorithm>
#include <chrono>

namespace godwit::vehicle_link {

namespace {} // namespace

actor::actor(runtime::spawn_context context, settings configured, signing_settings signing, std::shared_ptr<wire> line,
             std::shared_ptr<const listeners> ears)
    : durable_actor(std::move(context)), settings_(std::move(configured)), signing_(std::move(signing)),
      line_(std::move(line)), ears_(std::move(ears)) {}

actor::~actor() = default;

actor::behavior_type actor::handlers() {
  const auto then = [this](const effects& wanted) {
    carry_out(wanted);
    after_turn();
  };
  return {
      on_deferred<send_command, command_outcome>([this, then](const send_command& what, std::uint64_t request_id) {
        then(core_->on_command(request_id, what, now()));
      }),
      on<cancel_command>([this, then](const cancel_command& what) { then(core_->on_cancel(what, now())); }),
      on<set_mode>([this, then](const set_mode& what) { then(core_->on_set_mode(what, now())); }),
      on_deferred<set_current_item, command_outcome>(
          [this, then](const set_current_item& what, std::uint64_t request_id) {
            then(core_->on_set_current(request_id, what, now()));
          }),
      on<set_up_signing>([this, then](const set_up_signing& what) { then(core_->on_set_up_signing(what, now())); }),
      on_deferred<upload_plan, transfer::outcome>([this, then](const upload_plan& what, std::uint64_t request_id) {
        then(core_->on_upload(request_id, what, now()));
      }),
      on_deferred<download_plan, transfer::outcome>([this, then](const download_plan& what, std::uint64_t request_id) {
        then(core_->on_download(request_id, what, now()));
      }),
      on_deferred<clear_plan, transfer::outcome>([this, then](const clear_plan& what, std::uint64_t request_id) {
        then(core_->on_clear(request_id, what, now()));
      }),
      on<cancel_transfer>([this, then](const cancel_transfer&) { then(core_->on_cancel_transfer(now())); }),
      on<relayed_frame>([this, then](const relayed_frame& what) { then(core_->on_relayed(what, now())); }),
      on<liveness_report>([this](const liveness_report& what) {
        core_->on_liveness_report(what, now());
        wake_at(core_->next_deadline_ns());
      }),
      on<get_connection>([this](const get_connection&) {
        auto result = core_->describe(now());
        result.dropped_in = line_->incoming().dropped_bytes();
        result.dropped_out = dropped_out_;
        return result;
      }),
      on<wake>([this](const wake&) { drain(); })};
}

void actor::on_deadline() {
  carry_out(core_->on_time(now()));
  drain(); // also when a wake was lost with an incarnation
}

void actor::started() {
  core_.emplace(settings_, signing_, mavlink::signing_time{current_state().signing_ceiling});
  if (const auto status = line_->incoming().newest_status()) // an earlier life may have taken it
    carry_out(core_->on_link(*status, now()));
  tell(me(), wake{}); // what came in meanwhile waits
  wake_at(core_->next_deadline_ns());
}

void actor::drain() {
  for (int i = 0; i < max_chunks_per_turn; ++i) {
    const auto next = line_->incoming().take();
    if (!next) {
      after_turn();
      return;
    }
    std::visit([this](const auto& what) { take(what); }, *next);
  }
  tell(me(), wake{}); // there may be more; commands in the mailbox come first
  after_turn();
}

void actor::take(const io::link::link_status& what) { carry_out(core_->on_link(what, now())); }

void actor::take(const io::link::arrival& what) {
  carry_out(core_->on_bytes(what.peer, what.is_datagram, what.bytes, now()));
}

// -- effects --------------------------------------------------------------------------------------

void actor::carry_out(const effects& wanted) {
  for (const auto& each : wanted)
    std::visit([this](const auto& what) { carry_out(what); }, each);
}

void actor::carry_out(const transmission& each) { outgoing_.push_back(each); }

void actor::carry_out(const resolved_command& each) { answer_later(each.asked_by.request_id, each.outcome); }

void actor::carry_out(const resolved_transfer& each) { answer_later(each.request_id, each.outcome); }

void actor::carry_out(const observation& each) {
  std::visit([this]<class M>(const M& message) { ears_->for_each<M>([&](const auto& who) { tell(who, message); }); },
             each);
}

void actor::carry_out(const announcement& each) {
  std::visit([this]<class M>(const M& message) { ears_->for_each<M>([&](const auto& who) { tell(who, message); }); },
             each);
}

// The frames go last. Up to there a crash leaves nothing sent, and the message is handled again; from there on it is
// not, because a command must not reach the vehicle twice.
void actor::after_turn() {
  post_health();
  wake_at(core_->next_deadline_ns());
  reserve_signing_time();
  if (!outgoing_.empty())
    at_end([this] { send_outgoing(); });
}

void actor::send_outgoing() {
  mark_committed();
  for (const auto& each : outgoing_)
    if (!line_->send(each.frame.span(), each.to))
      ++dropped_out_;
  outgoing_.clear();
}

void actor::post_health() { show_health(core_->health(now())); }

void actor::reserve_signing_time() {
  if (const auto ceiling = core_->wanted_reservation(now()))
    commit(signing_time_reserved{mavlink::units(*ceiling)});
}

void actor::dispatch(const durable_core::effect& each) {
  core_->on_reserved(mavlink::signing_time{std::get<signing_time_reserved>(each).ceiling});
}

} // namespace godwit::vehicle_link
