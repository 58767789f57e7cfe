// What the runtime tells its own actors, beside their typed mailboxes. Not for actor code.
#pragma once

#include <cstdint>
#include <string>

#include <caf/all.hpp>

#include "io/fields/field_table.hpp"

namespace godwit::runtime {

// Guardian to actor: are you there? The actor answers with the same key (F´, Svc/Health).
struct ping {
  std::uint64_t key = 0;
  GODWIT_FIELDS(ping, "runtime.ping", key);
};

struct pong {
  std::uint32_t actor = 0; // number of the stable address
  std::uint64_t key = 0;
  GODWIT_FIELDS(pong, "runtime.pong", actor, key);
};

// Journal to actor: your events up to this number are on the disk.
struct durable {
  std::int64_t upto = 0;
  GODWIT_FIELDS(durable, "runtime.durable", upto);
};

// Journal to actor: a write was refused for good (a statement of its own was wrong). What the actor decided is not on
// the disk.
struct write_failed {
  std::uint64_t incarnation = 0; // that submitted it
  std::string what;
  GODWIT_FIELDS(write_failed, "runtime.write_failed", incarnation, what);
};

// What a durable actor was restored from when its incarnation began: for the trace alone, recorded before its first
// message. TEXT of all parts after each other is the JSON of runtime::recovered with the later events applied
// (stored_state.hpp). PARTS is 0 where it was too large.
struct restored {
  std::uint32_t part = 0; // from 0 on
  std::uint32_t parts = 0;
  std::uint64_t bytes = 0; // of all parts
  std::string text;
  GODWIT_FIELDS(restored, "runtime.restored", part, parts, bytes, text);
};
inline constexpr std::size_t restored_part_bytes = std::size_t{48} * 1024; // below what the trace takes of a message
inline constexpr std::size_t max_restored_bytes = std::size_t{512} * 1024; // half of what a thread's ring holds

// Actor without a durable state to itself: an incarnation begins. What it sends then has this as its cause.
struct begun {
  static constexpr auto fields = io::table("runtime.begun");
};

// What an actor does beside messages, to a link, a service, a screen: for the trace alone, recorded while a message is
// handled. HASH is of what was handed over, so that a replay can tell whether it is the same.
struct outside_call {
  std::string what; // "hub position", "POST /v1/..."; a few words
  std::uint64_t hash = 0;
  GODWIT_FIELDS(outside_call, "runtime.outside_call", what, hash);
};

// Actor to itself: a time that it waits for has come. One that an earlier one has overtaken has an old number.
struct deadline {
  std::uint64_t number = 0;
  GODWIT_FIELDS(deadline, "runtime.deadline", number);
};

// Durable actor to itself, later: the journal took no write, try again.
struct retry_write {
  static constexpr auto fields = io::table("runtime.retry_write");
};

// Receiver to sender of a durable effect: I have it, or had it already, and all that I have decided is on the disk.
// Only then is it marked released, so that nothing of it is lost with the process.
struct effect_taken {
  std::int64_t event = 0;
  std::uint32_t n = 0;
  std::uint32_t receiver = 0; // number of its stable address
  GODWIT_FIELDS(effect_taken, "runtime.effect_taken", event, n, receiver);
};

// Actor to guardian: this incarnation is ready for mail.
struct child_up {
  std::uint32_t actor = 0;
  std::uint64_t incarnation = 0;
  GODWIT_FIELDS(child_up, "runtime.child_up", actor, incarnation);
};

// Journal to guardian: what it recovered for this child lies ready.
struct recovery_ready {
  std::size_t child = 0;
  std::uint64_t incarnation = 0;
  GODWIT_FIELDS(recovery_ready, "runtime.recovery_ready", child, incarnation);
};

// Guardian to itself, later.
struct restart_due {
  std::size_t child = 0;
  GODWIT_FIELDS(restart_due, "runtime.restart_due", child);
};

struct stop_overdue {
  std::size_t child = 0;
  std::uint64_t incarnation = 0;
  bool killed = false; // it was killed already
  GODWIT_FIELDS(stop_overdue, "runtime.stop_overdue", child, incarnation, killed);
};

struct guardian_tick {
  static constexpr auto fields = io::table("runtime.guardian_tick");
};

struct start_children {
  static constexpr auto fields = io::table("runtime.start_children");
};

struct stop_children {
  static constexpr auto fields = io::table("runtime.stop_children");
};

// Ends an actor before it looks at any other mail. For runtime/ alone.
[[nodiscard]] inline caf::mailbox_element_ptr kill_message(caf::actor_addr from = {}) {
  return caf::make_mailbox_element(nullptr, caf::make_message_id(caf::message_priority::high), {},
                                   caf::exit_msg{std::move(from), caf::exit_reason::kill});
}

} // namespace godwit::runtime
