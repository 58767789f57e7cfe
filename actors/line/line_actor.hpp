// The shell of an actor that has a line of its own, to the autopilot or to ground stations.
//
//   line ──bytes──> queue of the port ──wake──> drain() ──> core ──> effects ──> frames, last of all ──> line
//
// What has come in is handed to the core in turns that leave room for other mail. The frames of a turn go last: up to
// there a crash leaves nothing sent, and the message is handled again; from there on it is not, because nobody must be
// told or commanded twice. The time of signatures is reserved on the disk ahead of its use.
//
// Core: on_link, on_bytes and on_time give what carry_out takes; next_deadline_ns, wanted_reservation, health. Wake:
// the message by which the line's port wakes the actor. Reserved: the event that reserves a time. Errors: a frame that
// the line does not take is counted. Thread: as actor_base.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "actors/line/transmission.hpp"
#include "io/link/wire.hpp"
#include "io/mavlink/signing/channel.hpp"
#include "io/mavlink/signing/signing_time.hpp"
#include "runtime/durable_actor.hpp"

namespace godwit::line {

// So much of what came in is handled in one turn, before other mail has its own.
inline constexpr int max_chunks_per_turn = 32;

template <class Mailbox, class DurableCore, class Core, class Wake, class Reserved>
class line_actor : public runtime::durable_actor<Mailbox, DurableCore> {
protected:
  using instant = io::mavlink::instant;
  using effects = decltype(std::declval<Core&>().on_time(instant{}));

  line_actor(runtime::spawn_context context, std::shared_ptr<io::link::wire> wire)
      : runtime::durable_actor<Mailbox, DurableCore>(std::move(context)), line_(std::move(wire)) {}

  // One effect after the other; frames by queue_frame().
  virtual void carry_out(const effects& wanted) = 0;

  // When core_ is there.
  void begin_line() {
    if (const auto status = line_->incoming().newest_status()) // an earlier life may have taken it
      carry_out(core_->on_link(*status, now()));
    this->tell(this->me(), Wake{}); // what came in meanwhile waits
    this->wake_at(core_->next_deadline_ns());
  }

  void drain() {
    for (int i = 0; i < max_chunks_per_turn; ++i) {
      const auto next = line_->incoming().take();
      if (!next)
        return after_turn();
      std::visit([this](const auto& what) { take(what); }, *next);
    }
    this->tell(this->me(), Wake{}); // there may be more; what others say comes first
    after_turn();
  }

  // Of each message that is handled.
  void then(const effects& wanted) {
    carry_out(wanted);
    after_turn();
  }
  void after_turn() {
    this->show_health(core_->health(now()));
    this->wake_at(core_->next_deadline_ns());
    if (const auto ceiling = core_->wanted_reservation(now()))
      this->commit(Reserved{io::mavlink::units(*ceiling)});
    if (!outgoing_.empty())
      this->at_end([this] { send_outgoing(); });
  }

  // Goes out when the handler has returned.
  void queue_frame(const transmission& each) { outgoing_.push_back(each); }

  [[nodiscard]] instant now() const { return {this->now_ns(), this->wall_ns()}; }
  [[nodiscard]] std::uint64_t dropped_in() const { return line_->incoming().dropped_bytes(); }
  [[nodiscard]] std::uint64_t dropped_out() const { return dropped_out_; }

  std::optional<Core> core_; // from started() on

private:
  void on_deadline() final {
    carry_out(core_->on_time(now()));
    drain(); // also when a wake was lost with an incarnation
  }

  void take(const io::link::link_status& what) { carry_out(core_->on_link(what, now())); }
  void take(const io::link::arrival& what) {
    carry_out(core_->on_bytes(what.peer, what.is_datagram, what.bytes, now()));
  }

  void send_outgoing() {
    this->mark_committed();
    for (const auto& each : outgoing_)
      if (!line_->send(each.frame.span(), each.to))
        ++dropped_out_;
    outgoing_.clear();
  }

  std::shared_ptr<io::link::wire> line_;
  std::vector<transmission> outgoing_; // of this turn
  std::uint64_t dropped_out_ = 0;
};

} // namespace godwit::line
