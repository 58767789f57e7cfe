// How work gets to the map, whoever does it: the writer's thread, or a test in its own one.
//
// WORK(map_tables&) gives a map_result<T>; DONE(const map_result<T>&) hears it when it is durable, or why it never will
// be, once. WORK may run several times before one of them counts. Refused here (full, closed): DONE is not called.
// Thread: any; which one calls DONE is said by who implements it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "actors/mapobjects_store/load_finish.hpp"
#include "actors/mapobjects_store/map_load.hpp"
#include "actors/mapobjects_store/map_work.hpp"
#include "actors/mapobjects_store/pass_review.hpp"

namespace godwit::mapobjects_store {

struct map_writer_status {
  bool failing = false;      // the last commit failed, the writer keeps trying
  std::string reason;        // sentence for people while failing
  std::uint64_t commits = 0; // transactions that reached the disk
  std::uint64_t changes = 0; // in them
  std::uint64_t retries = 0; // groups tried again after an error
  std::size_t queued = 0;    // waits now
  double fill = 0;           // of the bound on what waits: 0 = empty, 1 = refuses; see io::sqlite::nearly_full
};

class map_access {
public:
  map_access() = default;
  map_access(const map_access&) = delete;
  map_access& operator=(const map_access&) = delete;
  virtual ~map_access() = default;

  template <class Work, class Done>
  [[nodiscard]] map_result<void> post(Work work, Done done);

  // Of a load that was begun by posting `begin`.
  [[nodiscard]] map_result<void> add_page(load_page page, const page_stage::callback& done);
  [[nodiscard]] map_result<void> finish(const finish_load& asked, const load_finish::callback& done);

  // All sightings that were posted before it count.
  [[nodiscard]] map_result<void> review(pass_end pass, const pass_review::callback& done);

  [[nodiscard]] virtual map_result<void> push(queued_work item) = 0;
  [[nodiscard]] virtual map_writer_status status() const = 0;
};

template <class Work, class Done>
map_result<void> map_access::post(Work work, Done done) {
  using result = decltype(work(std::declval<map_tables&>()));
  auto slot = std::make_shared<std::optional<result>>();
  return push(queued_change{.work = [slot, work = std::move(work)](map_tables& t) -> map_result<void> {
                              *slot = work(t);
                              if (!**slot)
                                return tl::unexpected((*slot)->error());
                              return {};
                            },
                            .done =
                                [slot, done = std::move(done)](const map_result<void>& outcome) {
                                  done(outcome ? std::move(**slot) : result(tl::unexpected(outcome.error())));
                                }});
}

} // namespace godwit::mapobjects_store
