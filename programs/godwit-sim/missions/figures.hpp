// What a missions service counts, for tests and for people. Thread: plain values.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "programs/godwit-sim/missions/fault.hpp"

namespace godwit::sim::missions {

// What vehicles deliver, and how its rows are called apart. Thread: values.
enum class row_kind {
  observation,  // observation_id
  ignored_item, // ignored_id
  progress,     // report_no
  change,       // an insert or a tail: its idempotency key
  response,     // to an assignment: assignment_id
  picture,      // observation_id
};

GODWIT_ENUM_NAMES(row_kind, observation, ignored_item, progress, change, response, picture);

struct stored_row {
  std::string id;
  std::string text;             // JSON
  std::uint64_t deliveries = 1; // in requests with different keys; the row itself is there once
};

// Rows of one kind, of all missions. A row is in the file once, whoever sends it how often: its key sees to that.
struct row_figures {
  std::uint64_t stored = 0;    // rows that are in the file
  std::uint64_t repeated = 0;  // deliveries of a row that was there already, in a request with another key
  std::uint64_t differing = 0; // of those: with another content than the first time, which is a defect of the sender
};

struct connection_figures {
  std::uint64_t accepted = 0;
  std::uint64_t turned_away = 0; // there were as many as there may be
  std::uint64_t open = 0;
  std::uint64_t polls = 0; // that wait for an assignment
};

struct fault_figures {
  std::string spec;
  std::uint64_t seen = 0; // requests, or connections, for which it could have been meant
  std::uint64_t hit = 0;
};

struct service_figures {
  std::map<endpoint, std::map<unsigned, std::uint64_t>> answers; // by endpoint and status, as the client got them
  std::map<row_kind, row_figures> rows;
  std::uint64_t replayed = 0; // answers given again, because the key was known
  std::uint64_t lost = 0;     // answers that a fault has lost
  connection_figures connections;
  std::vector<fault_figures> faults;

  [[nodiscard]] std::uint64_t requests(endpoint where) const {
    std::uint64_t all = 0;
    if (const auto found = answers.find(where); found != answers.end())
      for (const auto& [status, count] : found->second)
        all += count;
    return all;
  }
};

} // namespace godwit::sim::missions
