#include "actors/mapobjects_store/pass_review.hpp"

#include "actors/domain/uuid/uuid.hpp"
#include "actors/mapobjects_store/ignore_list.hpp"
#include "actors/mapobjects_store/object_table.hpp"
#include "actors/mapobjects_store/observation_table.hpp"

namespace godwit::mapobjects_store {

pass_review::pass_review(pass_end pass, view_cursor in_view, callback done)
    : pass_(std::move(pass)), in_view_(std::move(in_view)), done_(std::move(done)) {
  counts_.id = pass_.id;
}

map_result<bool> pass_review::stage(map_tables& t, decision_context& now) {
  staged_ = counts_;
  for (const auto& each : uncommitted_)
    if (auto done = look_at(t, each); !done)
      return tl::unexpected(std::move(done.error()));
  for (;;) {
    auto row = in_view_.next();
    if (!row)
      return tl::unexpected(std::move(row.error()));
    if (!*row)
      return true;
    if ((*row)->in_view) {
      uncommitted_.push_back(std::move(**row));
      if (auto done = look_at(t, uncommitted_.back()); !done)
        return tl::unexpected(std::move(done.error()));
    }
    if (now.over_after_row())
      return false;
  }
}

// The object may have been seen, moved or dropped since the cursor was opened.
map_result<void> pass_review::look_at(map_tables& t, const view_cursor::row& seen_then) {
  ++staged_.in_view;
  const auto object = object_with(t.q, t.map, seen_then.object_id, seen_then.loaded_number);
  if (!object)
    return tl::unexpected(object.error());
  if (!*object)
    return {};
  const auto seen = was_seen(t.q, seen_then.object_id, pass_.started_ns);
  if (!seen)
    return tl::unexpected(seen.error());
  if (*seen)
    return {};
  const auto& what = (*object)->what;
  const auto ignored = is_ignored(t, what.position, what.class_group);
  if (!ignored)
    return tl::unexpected(ignored.error());
  return *ignored ? map_result<void>{} : miss(t, what);
}

map_result<void> pass_review::miss(map_tables& t, const map_object& object) {
  ++staged_.removed_candidates;
  const auto id = ids::derived_uuid(pass_.id, object.id);
  const auto known = observation_with(t.q, id);
  if (!known)
    return tl::unexpected(known.error());
  if (*known)
    return {};
  const observation what{.id = id,
                         .mission_id = pass_.mission_id,
                         .object_id = object.id,
                         .kind = observation_kind::removed_candidate,
                         .class_group = object.class_group,
                         .position = object.position,
                         .at_ns = pass_.ended_ns,
                         .confidence = pass_.confidence};
  return add_observation(t.q, what).map([](std::int64_t) {});
}

void pass_review::committed() {
  counts_ = staged_;
  uncommitted_.clear();
}

void pass_review::finish(const map_result<void>& result) {
  done_(result.map([&] { return counts_; }));
}

} // namespace godwit::mapobjects_store
