// The audit: who said what, when, and what came of it. Thread: plain values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/fields/field_table.hpp"
#include "messages/operator/principal.hpp"

namespace godwit::operator_bridge {

struct audit_row {
  std::uint64_t number = 0;      // rises; made by operator_bridge
  std::int64_t at_ns = 0;        // ns since 1970 (UTC); of the last one, where several are one row
  operators::principal who = {}; // without a session: a stranger, under the name that was given
  std::string what = {};         // "start", "take control"
  std::string id = {};           // of a command that has one
  std::string outcome = {};      // the name of a verdict; "done", "refused"
  std::string reason = {};       // sentence for people; may be empty
  std::uint32_t count = 1;       // how many are in this row: alike, or more than may be written of one person
  GODWIT_FIELDS(audit_row, "operator_bridge.audit_row", number, at_ns, who, what, id, outcome, reason, count);
  friend bool operator==(const audit_row&, const audit_row&) = default;
};

// Something that was done past operator_bridge, and is to be in the audit.
struct audit_note {
  operators::principal who;
  std::string what;
  std::string outcome;
  std::string reason;
  GODWIT_FIELDS(audit_note, "operator_bridge.audit_note", who, what, outcome, reason);
};

// May BY read the audit? Answered when all that was decided before is on the disk; the rows are in the journal.
struct read_audit {
  operators::principal by;
  GODWIT_FIELDS(read_audit, "operator_bridge.read_audit", by);
};

struct audit_leave {
  std::string refusal; // empty: it may be read
  GODWIT_FIELDS(audit_leave, "operator_bridge.audit_leave", refusal);
};

struct audit_query {
  std::uint64_t before = 0; // rows with smaller numbers; 0: the newest
  std::uint32_t most = 50;
};

struct audit_page {
  std::vector<audit_row> rows; // the oldest first
  bool has_older = false;      // asked for with `before` = the first number here
  GODWIT_FIELDS(audit_page, "operator_bridge.audit_page", rows, has_older);
};

} // namespace godwit::operator_bridge
