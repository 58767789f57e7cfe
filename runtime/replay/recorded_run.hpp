// What a trace has of one actor in one run: what it took, what it sent, and what has to be known of the others to say
// that a message never arrived.
//
//   recorded_run run("executor", names);
//   while (reader.next(each)) run.add(each);   // all deliveries of the run, in order of time
//   run.finish();
//
// Memory: the deliveries to and from the actor with their messages. Thread: one.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runtime/trace/reading/delivery.hpp"

namespace godwit::runtime {

struct recorded_message {
  std::uint64_t id = 0;
  std::uint64_t cause = 0;
  std::int64_t began_ns = 0;
  std::int64_t duration_ns = 0;
  std::int64_t clock_offset_ns = 0; // as in a delivery
  std::int64_t wall_offset_ns = 0;
  std::string sender;
  std::string receiver;
  std::string type;
  std::uint32_t incarnation = 0; // of the receiver
  outcome how = outcome::handled;
  bool oversize = false;
  std::string body;
};

class recorded_run {
public:
  // NAMES are those of the reader, and live longer.
  recorded_run(std::string actor, name_table& names);

  void add(const delivery& each);
  void finish();

  [[nodiscard]] const std::string& actor() const { return actor_; }
  // Everything that it took, in order, without what came in beside its mailbox.
  [[nodiscard]] const std::vector<recorded_message>& inputs() const { return inputs_; }
  // What it sent and somebody took, by id: in the order in which it was sent.
  [[nodiscard]] const std::vector<recorded_message>& outputs() const { return outputs_; }
  // What came in or was done beside the mailbox of INCARNATION while the message ID was handled.
  [[nodiscard]] std::vector<const recorded_message*> observed(std::uint32_t incarnation, std::uint64_t id) const;

  // The text of what INCARNATION was restored from. Nothing: it is not in the record; empty: it was too large for it.
  [[nodiscard]] std::optional<std::string> restored(std::uint32_t incarnation) const;
  // Why it crashed, as the guardian told it; empty: nobody was told.
  [[nodiscard]] std::string crash_reason(std::uint32_t incarnation) const;
  // RECEIVER had begun when message ID was sent at FROM_NS, and took mail after TO_NS without having begun anew. In
  // virtual time much happens in one moment: who began in the moment of the message had begun before it if its first
  // mail is older.
  [[nodiscard]] bool lived_through(const std::string& receiver, std::uint64_t id, std::int64_t from_ns,
                                   std::int64_t to_ns) const;
  // It has taken mail: it is no thread that can only tell.
  [[nodiscard]] bool is_actor(const std::string& name) const { return lives_.contains(names_.number(name)); }
  [[nodiscard]] bool has_failed(std::uint64_t question) const { return failed_.contains(question); }

private:
  struct life {
    std::uint32_t incarnation = 0;
    std::uint64_t first_id = 0;
    std::int64_t first_ns = 0;
    std::int64_t last_ns = 0;
  };
  struct snapshot {
    std::uint64_t bytes = 0;
    std::string text;
  };

  [[nodiscard]] recorded_message message_of(const delivery& each) const;
  void note_restored(const recorded_message& part);
  void note_crash(const delivery& each);

  std::string actor_;
  name_table& names_;
  std::uint32_t actor_number_;
  std::uint32_t child_event_;
  std::uint32_t ask_failed_;
  std::vector<recorded_message> inputs_;
  std::vector<recorded_message> outputs_;
  std::multimap<std::pair<std::uint32_t, std::uint64_t>, recorded_message> observed_; // by incarnation and cause
  std::map<std::uint32_t, snapshot> restored_;
  std::map<std::uint32_t, std::string> crashes_;
  std::map<std::uint32_t, std::vector<life>> lives_; // by actor
  std::set<std::uint64_t> failed_;                   // questions
};

} // namespace godwit::runtime
