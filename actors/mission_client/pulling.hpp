// Pulls the map: from the service page by page into a load of the map store, which becomes the map when it is whole.
//
//   choose the mission ─> begin a load ─> page of objects ─> ... ─> page of ignored items ─> ... ─> finish
//                              ^                │
//                              └── a `next` that is not known any more, or a load that was given up (a few times)
//   failed: the store is told, and says whether it has a copy from before
//
// A service that gives marks is asked for what has changed since that of the copy from before. It may answer with all
// of the map; then the load replaces the copy.
//
// The load begins before the first page is asked for: what is delivered in between may be missing in the pages, and
// the store has to know. The next page is asked for as soon as its place is known: from the head of the one that still
// comes, where the service names it there, else from its body. Earlier ones go into the store meanwhile; at most
// max_pages_ahead wait for it or for the one before them. Thread: one at a time.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "actors/mission_client/planning_context.hpp"
#include "messages/mission/map_objects.hpp"

namespace godwit::mission_client {

// A load is begun anew at most so often.
inline constexpr int max_loads = 4;
// Of pages that the store does not have yet, no further one is asked for.
inline constexpr std::size_t max_pages_ahead = 2;
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
  void on_page_begun(planning_context& d, ticket number, const std::string& next) override;
  void on_store(planning_context& d, ticket number, const store_answer& answer) override;

private:
  enum class stage { choosing, beginning, loading, finishing, counting, failing, looking };

  [[nodiscard]] store_question question(const planning_context& d) const;
  void plan_loading(planning_context& d);
  void on_page_ahead(const service_answer& answer);
  void go_on_with_page_ahead(planning_context& d, const std::optional<std::string>& next);
  void take_page(planning_context& d, const service_answer& answer);
  // What bound has been passed; empty: none.
  [[nodiscard]] std::string passed_bound() const;
  [[nodiscard]] tl::expected<store::load_page, std::string> page_in(const service_answer& answer,
                                                                    std::optional<std::string>& next);
  // Whether all pages are either changes or the map; a sentence if not.
  [[nodiscard]] tl::expected<void, std::string> take_mark(const mission::map_object_page& page);
  [[nodiscard]] std::optional<std::string> since(const planning_context& d) const;
  void take_load(const store::load_answer& begun);
  void go_to(stage next);
  void drop_pages(planning_context& d);
  void begin_anew(planning_context& d, const std::string& why);
  void give_up(planning_context& d, std::string why);
  void go_on(planning_context& d);
  void end(planning_context& d, pull_state result);

  attempt attempt_; // a question to the store
  attempt call_;    // the next page
  // The one after it, whose place the head of that one has named.
  struct page_ahead {
    std::string next{}; // its place; empty: it is not known
    attempt call{};     // at most once
    bool is_asked = false;
    std::string following{}; // the place after it, as its own head has named it
    std::optional<service_answer> came{};
  };
  page_ahead ahead_;
  stage stage_ = stage::choosing;
  std::string mission_id_;
  std::string reason_; // why it fails
  int loads_ = 0;
  std::int64_t load_ = 0;                        // the store's number
  std::string mark_before_;                      // of the copy from before; empty: all of the map is asked for
  std::string mark_;                             // of what comes
  std::optional<bool> is_change_;                // what comes has only changes; nothing: no page has come
  destination what_ = destination::observations; // which pages; observations stands for the objects
  std::string next_;
  bool is_last_here_ = false; // no page comes any more
  std::int64_t pages_ = 0;    // these and what follows: of pages that came
  std::int64_t objects_ = 0;
  std::int64_t ignored_ = 0;
  std::uint64_t bytes_ = 0;
  int empty_pages_ = 0;                  // in a row
  std::deque<store::load_page> waiting_; // until the store has them; at most max_pages_ahead
};

} // namespace godwit::mission_client
