// The ways in which durable memory ends an incarnation. All are for the supervisor, not for actor code.
#pragma once

#include <stdexcept>
#include <string>

#include "runtime/journal/error.hpp"

namespace godwit::runtime {

// What the journal keeps of this actor can not be read by this version of it. Restarting does not help: the supervisor
// gives up at once.
struct state_unreadable : std::runtime_error {
  state_unreadable(const std::string& actor, const std::string& why)
      : std::runtime_error(
            "the journal's state of " + actor + " can not be read: " + why +
            ". It was written by another version of godwit; start that version, or move the journal away") {}
};

// An event can not be committed now, through no fault of the message: it is put back however often that happens, and
// the supervisor's back-off makes it wait.
struct commit_refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A newer incarnation has taken over: the journal takes no write of this one.
struct journal_refused : commit_refused {
  explicit journal_refused(const journal_error& why) : commit_refused(why.message()) {}
};

} // namespace godwit::runtime
