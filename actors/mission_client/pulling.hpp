// Pulls the map: from the service page by page into a load of the map store, which becomes the map when it is whole.
//
//   choose the mission ─> begin a load ─> page of objects ─> ... ─> page of ignored items ─> ... ─> finish
//                              ^                │
//                              └── a `next` that is not known any more, or a load that was given up (a few times)
//   failed: the store is told, and says whether it has a copy from before
//
// The load begins before the first page is asked for: what is delivered in between may be missing in the pages, and
// the store has to know. A page is in the store before the next one is asked for, so that one page is in memory.
// Thread: one at a time.
#pragma once

#include <optional>
#include <string>

#include "actors/mission_client/planning_context.hpp"

namespace godwit::mission_client {

// A load is begun anew at most so often.
inline constexpr int max_loads = 4;
// Without bounds a service that always gives a `next` would be asked for ever, and fill the disk. The store is made for
// a million objects; what does not end there has no end.
inline constexpr std::int64_t max_pages = 10'000;
inline constexpr std::int64_t max_rows = 1'000'000;                 // objects, and as many ignored items
inline constexpr std::uint64_t max_bytes = std::uint64_t{1} << 30U; // of all pages: 500 for each row
inline constexpr int max_empty_pages = 16;                          // in a row

class pulling final : public part {
public:
  void plan(planning_context& d) override;
  void on_answer(planning_context& d, ticket number, const service_answer& answer) override;
  void on_store(planning_context& d, ticket number, const store_answer& answer) override;

private:
  enum class stage { choosing, beginning, asking, storing, finishing, failing, looking };

  [[nodiscard]] store_question question(const planning_context& d) const;
  void take_page(planning_context& d, const service_answer& answer);
  // What bound has been passed; empty: none.
  [[nodiscard]] std::string passed_bound() const;
  [[nodiscard]] tl::expected<store::load_page, std::string> page_in(const service_answer& answer,
                                                                    std::optional<std::string>& next) const;
  void go_to(stage next);
  void begin_anew(const std::string& why);
  void give_up(std::string why);
  void go_on(planning_context& d);
  void end(planning_context& d, pull_state result);

  attempt attempt_;
  stage stage_ = stage::choosing;
  std::string mission_id_;
  std::string reason_; // why it fails
  int loads_ = 0;
  std::int64_t load_ = 0;                        // the store's number
  destination what_ = destination::observations; // which pages; observations stands for the objects
  std::string next_;
  std::int64_t pages_ = 0;
  std::int64_t objects_ = 0;
  std::int64_t ignored_ = 0;
  std::uint64_t bytes_ = 0;
  int empty_pages_ = 0;   // in a row
  store::load_page page_; // until the store has it
  std::optional<std::string> next_after_page_;
};

} // namespace godwit::mission_client
