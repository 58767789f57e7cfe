// What the runtime tells its own actors, beside their typed mailboxes. Not for actor code.
#pragma once

#include <cstdint>
#include <string>

#include "io/fields/field_table.hpp"

namespace godwit::runtime {

// Guardian to actor: are you there? The actor answers with the same key (F´, Svc/Health).
struct ping {
  std::uint64_t key = 0;
  static constexpr auto fields = io::table("runtime.ping", io::field("key", &ping::key));
};

struct pong {
  std::uint32_t actor = 0; // number of the stable address
  std::uint64_t key = 0;
  static constexpr auto fields =
      io::table("runtime.pong", io::field("actor", &pong::actor), io::field("key", &pong::key));
};

// Journal to actor: your events up to this number are on the disk.
struct durable {
  std::int64_t upto = 0;
  static constexpr auto fields = io::table("runtime.durable", io::field("upto", &durable::upto));
};

// Journal to actor: a write was refused for good (a statement of its own was wrong). What the actor decided is not on
// the disk.
struct write_failed {
  std::uint64_t incarnation = 0; // that submitted it
  std::string what;
  static constexpr auto fields = io::table("runtime.write_failed", io::field("incarnation", &write_failed::incarnation),
                                           io::field("what", &write_failed::what));
};

// What a durable actor was restored from when its incarnation began: for the trace alone, recorded before its first
// message. TEXT of all parts behind each other is the JSON of runtime::recovered with the later events applied
// (stored_state.hpp). PARTS is 0 where it was too large.
struct restored {
  std::uint32_t part = 0; // from 0 on
  std::uint32_t parts = 0;
  std::uint64_t bytes = 0; // of all parts
  std::string text;
  static constexpr auto fields =
      io::table("runtime.restored", io::field("part", &restored::part), io::field("parts", &restored::parts),
                io::field("bytes", &restored::bytes), io::field("text", &restored::text));
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
  static constexpr auto fields =
      io::table("runtime.outside_call", io::field("what", &outside_call::what), io::field("hash", &outside_call::hash));
};

// Actor to itself: a time that it waits for has come. One that an earlier one has overtaken has an old number.
struct deadline {
  std::uint64_t number = 0;
  static constexpr auto fields = io::table("runtime.deadline", io::field("number", &deadline::number));
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
  static constexpr auto fields =
      io::table("runtime.effect_taken", io::field("event", &effect_taken::event), io::field("n", &effect_taken::n),
                io::field("receiver", &effect_taken::receiver));
};

// Actor to guardian: this incarnation is ready for mail.
struct child_up {
  std::uint32_t actor = 0;
  std::uint64_t incarnation = 0;
  static constexpr auto fields = io::table("runtime.child_up", io::field("actor", &child_up::actor),
                                           io::field("incarnation", &child_up::incarnation));
};

// Journal to guardian: what it recovered for this child lies ready.
struct recovery_ready {
  std::size_t child = 0;
  std::uint64_t incarnation = 0;
  static constexpr auto fields = io::table("runtime.recovery_ready", io::field("child", &recovery_ready::child),
                                           io::field("incarnation", &recovery_ready::incarnation));
};

// Guardian to itself, later.
struct restart_due {
  std::size_t child = 0;
  static constexpr auto fields = io::table("runtime.restart_due", io::field("child", &restart_due::child));
};

struct stop_overdue {
  std::size_t child = 0;
  std::uint64_t incarnation = 0;
  bool killed = false; // it was killed already
  static constexpr auto fields =
      io::table("runtime.stop_overdue", io::field("child", &stop_overdue::child),
                io::field("incarnation", &stop_overdue::incarnation), io::field("killed", &stop_overdue::killed));
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

} // namespace godwit::runtime
