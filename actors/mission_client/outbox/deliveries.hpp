// Delivers what is in the outbox: lane by lane, in each the oldest first, one call at a time.
//
// A lane is one destination of one mission. Lanes do not wait for each other; only as many as there are connections are
// under way, and changes, for which somebody waits, do not count there. Reports of progress go out up to 100 together.
// A delivery of the map goes like this, and begins again at any of these places after a crash, with the same key:
//
//   key noted on the disk ─> rows taken from the store ─> posted ─> the store knows that they are delivered ─> done
//
// Thread: one at a time.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "actors/mission_client/judgement.hpp"
#include "actors/mission_client/planning_context.hpp"

namespace godwit::mission_client {

// Each kind of delivery begins with this where its last error is kept.
inline constexpr std::string_view delivering = "delivering ";

// Of the lanes that nobody waits for. The connections bound it; the rest is for changes and the long poll.
inline constexpr std::size_t max_deliveries_under_way = 4;

class deliveries final : public part {
public:
  void plan(planning_context& d) override;
  void on_answer(planning_context& d, ticket number, const service_answer& answer) override;
  void on_store(planning_context& d, ticket number, const store_answer& answer) override;

  // Rows below this order are on the disk. What is not there yet is not delivered: with its key it would be forgotten.
  void on_disk(std::uint64_t below_order) { on_disk_below_ = std::max(on_disk_below_, below_order); }
  // Lanes that were not allowed are tried again.
  void free();
  // Another mission waits for what is owed now.
  void count_anew();
  // Since count_anew, or for now there is no use in trying.
  [[nodiscard]] bool has_tried_enough(destination to, const std::string& mission_id, int tries) const;
  // Of lanes that are not allowed.
  [[nodiscard]] std::size_t blocked() const;
  [[nodiscard]] bool is_blocked(const std::string& mission_id) const;
  // Rows of the map that are taken into batches and not delivered, as far as this incarnation has seen them.
  [[nodiscard]] std::uint32_t rows_in_batches() const;

private:
  using lane_id = std::pair<destination, std::string>;
  struct lane {
    ticket waiting = 0;
    bool is_call = false;           // waits for the service; else for the store
    std::vector<std::string> keys;  // of the rows that are under way
    bool is_blocked = false;        // not allowed
    bool is_at_service = false;     // the service has keys[0], and the store does not know it
    std::uint32_t batch_rows = 0;   // in that delivery
    std::uint32_t failed = 0;       // tries, since count_anew
    std::uint32_t store_failed = 0; // in a row
    std::int64_t not_before_ns = 0; // the store was silent
  };
  using heads = std::map<lane_id, const outbox_row*>;

  [[nodiscard]] static heads heads_of(const state& s);
  void plan_lane(planning_context& d, lane& l, const outbox_row& head);
  [[nodiscard]] static bool is_too_late(planning_context& d, const outbox_row& change);
  void plan_batches(planning_context& d, const heads& known);
  void start(planning_context& d, lane& l, const outbox_row& head);
  void post(planning_context& d, lane& l, service_call call);
  void ask(planning_context& d, lane& l, store_question what);
  [[nodiscard]] std::size_t under_way() const;
  [[nodiscard]] std::map<lane_id, lane>::iterator end_wait(ticket number);

  void take_row_answer(planning_context& d, const lane_id& id, lane& l, const service_answer& answer);
  void take_receipt(planning_context& d, const lane_id& id, lane& l, const service_answer& answer);
  void fail(planning_context& d, const lane_id& id, lane& l, const std::string& why, const service_answer& answer);
  void take_batch(planning_context& d, lane& l, const store::batch& rows);
  void take_store_failure(planning_context& d, const lane_id& id, lane& l, const store_answer& answer);

  std::map<lane_id, lane> lanes_;
  std::uint64_t on_disk_below_ = 0;
};

} // namespace godwit::mission_client
