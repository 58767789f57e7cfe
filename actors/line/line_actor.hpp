// The shell of an actor that has a line of its own, to the autopilot or to ground stations.
//
//   line ──bytes──> queue of the port ──wake──> drain() ──> core ──> effects ──> frames, last of all ──> line
//
// What has come in is handed to the core in turns that leave room for other mail. The frames of a turn go last: up to
// there a crash leaves nothing sent, and the message is handled again; from there on it is not, because nobody must be
// told or commanded twice. The time of signatures is reserved on the disk ahead of its use.
//
// Core: on_link, on_bytes and on_time give what execute takes; next_deadline_ns, wanted_reservation, health. Wake:
// the message by which the line's port wakes the actor. Reserved: the event that reserves a time. Errors: a frame that
// the line does not take is counted. Thread: as actor_base.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "actors/line/line_input.hpp"
#include "actors/line/transmission.hpp"
#include "io/link/wire.hpp"
#include "io/mavlink/signing/channel.hpp"
#include "io/mavlink/signing/signature.hpp"
#include "runtime/content_hash.hpp"
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
  virtual void execute(const effects& wanted) = 0;

  // When core_ is there.
  void begin_line() {
    const auto status = this->template take_beside<line_input>([this]() -> std::optional<line_input> {
      if (const auto newest = line_->incoming().newest_status())
        return line_input::of(*newest);
      return std::nullopt;
    });
    if (status) // an earlier life may have taken it
      take(status->news());
    this->tell(this->me(), Wake{}); // what came in meanwhile waits
    this->wake_at(core_->next_deadline_ns());
  }

  void drain() {
    for (int i = 0; i < max_chunks_per_turn; ++i) {
      const auto next = next_news();
      if (!next)
        return after_turn();
      take(*next);
    }
    this->tell(this->me(), Wake{}); // there may be more; what others say comes first
    after_turn();
  }

  // Of each message that is handled.
  void then(const effects& wanted) {
    execute(wanted);
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
  [[nodiscard]] line_drops drops() {
    line_drops result{line_->incoming().dropped_bytes(), dropped_out_};
    this->observe(result, drops_);
    return result;
  }

  std::optional<Core> core_; // from started() on

private:
  void on_deadline() final {
    execute(core_->on_time(now()));
    drain(); // also when a wake was lost with an incarnation
  }

  [[nodiscard]] std::optional<line_news> next_news() {
    if (!this->is_recorded())
      return line_->incoming().take();
    auto recorded = this->template take_beside<line_input>([this]() -> std::optional<line_input> {
      auto next = line_->incoming().take();
      if (!next)
        return std::nullopt;
      untouched_ = *next;
      if (auto* const came = std::get_if<io::link::arrival>(&*next))
        eraser_.erase(came->peer, came->is_datagram, came->bytes);
      return line_input::of(*next);
    });
    if (!recorded)
      return std::nullopt;
    return untouched_ ? std::exchange(untouched_, std::nullopt) : recorded->news();
  }

  void take(const line_news& news) {
    std::visit([this](const auto& what) { take(what); }, news);
  }
  void take(const io::link::link_status& what) { execute(core_->on_link(what, now())); }
  void take(const io::link::arrival& what) { execute(core_->on_bytes(what.peer, what.is_datagram, what.bytes, now())); }

  void send_outgoing() {
    this->mark_committed();
    note_frames();
    for (const auto& each : outgoing_)
      if (!line_->send(each.frame.span(), each.to))
        ++dropped_out_;
    outgoing_.clear();
  }

  // By the ids of their messages, and what is in them.
  void note_frames() {
    if (!this->is_recorded() || outgoing_.empty())
      return;
    std::string ids = "frames";
    auto hash = runtime::empty_hash;
    for (const auto& each : outgoing_) {
      ids += ' ' + std::to_string(each.frame.view().id());
      hash = runtime::content_hash(each.frame.span(), hash);
    }
    this->note_call(std::move(ids), hash);
  }

  std::shared_ptr<io::link::wire> line_;
  secret_eraser eraser_;               // of what is recorded
  std::optional<line_news> untouched_; // as it came, of what was recorded last
  std::optional<line_drops> drops_;    // as recorded last
  std::vector<transmission> outgoing_; // of this turn
  std::uint64_t dropped_out_ = 0;
};

} // namespace godwit::line
