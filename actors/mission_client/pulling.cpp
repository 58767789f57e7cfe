#include "actors/mission_client/pulling.hpp"

#include <utility>

#include "actors/domain/mission/read.hpp"
#include "actors/domain/mission/version.hpp"
#include "actors/mission_client/calls.hpp"
#include "actors/mission_client/judgement.hpp"
#include "actors/mission_client/outbox/map_rows.hpp"

namespace godwit::mission_client {

namespace {

constexpr const char* pull_kind = "pulling the map";

std::string with_sample(const std::string& what, const std::string& sample) {
  return "what the service sent is no page of the map: " + what + "; it began with: " + sample;
}

} // namespace

void pulling::plan(planning_context& d) {
  if (d.s.now != phase::pulling || mission_id_ != d.s.mission_id) {
    drop_pages(d);
    mission_id_ = d.s.mission_id;
    stage_ = stage::choosing;
    loads_ = 0;
    return d.s.now == phase::pulling ? plan(d) : void();
  }
  if (stage_ == stage::loading)
    plan_loading(d);
  else if (attempt_.may_start(d))
    attempt_.waiting = d.ask(*this, question(d));
}

void pulling::plan_loading(planning_context& d) {
  if (!waiting_.empty() && attempt_.may_start(d))
    attempt_.waiting = d.ask(*this, waiting_.front());
  if (!is_last_here_ && waiting_.size() < max_pages_ahead && call_.may_start(d))
    call_.waiting = d.call(*this, get_page(d.set, mission_id_, what_, next_, since(d)));
  const bool has_room = waiting_.size() + 1 < max_pages_ahead; // for this one and the one before it
  if (call_.waiting != 0 && !ahead_.next.empty() && !ahead_.is_asked && has_room) {
    ahead_.is_asked = true;
    ahead_.call.waiting = d.call(*this, get_page(d.set, mission_id_, what_, ahead_.next, since(d)));
  }
}

// Of the objects alone: what is ignored is little.
std::optional<std::string> pulling::since(const planning_context& d) const {
  const bool asks = what_ == destination::observations && mission::gives_marks(d.s.schema_version);
  return asks ? std::optional(mark_before_) : std::nullopt;
}

store_question pulling::question(const planning_context& d) const {
  switch (stage_) {
  case stage::choosing:
    return store::choose_mission{mission_id_};
  case stage::beginning:
    return store::begin_load{mission_id_};
  case stage::finishing:
    return store::finish_load{load_, objects_, ignored_, d.now.wall_ns, is_change_.value_or(false), mark_};
  case stage::failing:
    return store::pull_failed{mission_id_};
  default:
    return store::get_map{};
  }
}

// -- the service ----------------------------------------------------------------------------------

void pulling::on_answer(planning_context& d, ticket number, const service_answer& answer) {
  if (ahead_.call.ends_with(number))
    return on_page_ahead(answer);
  if (!call_.ends_with(number))
    return;
  const auto verdict = judge(answer);
  if (verdict == judgement::success)
    return take_page(d, answer);
  d.count_fetch_error();
  auto why = sentence_of(answer);
  d.went_wrong(pull_kind, why);
  if (verdict == judgement::gone)
    return d.happened(mission_gone{mission_id_});
  if (verdict == judgement::wrong && answer.status == 400 && (!next_.empty() || !mark_before_.empty()))
    return begin_anew(d, why);
  if (verdict != judgement::transient)
    return give_up(d, std::move(why));
  call_.fail(d, mission_id_, answer.retry_after_ns);
  if (const auto tries = call_.failed; tries >= static_cast<std::uint32_t>(d.set.max_tries))
    give_up(d, "after " + std::to_string(tries) + " tries: " + why);
}

tl::expected<store::load_page, std::string> pulling::page_in(const service_answer& answer,
                                                             std::optional<std::string>& next) {
  store::load_page result{load_, pages_, {}, {}, {}};
  const auto read_as = [&]<class Page>(std::type_identity<Page>, auto rows_of,
                                       auto& into) -> tl::expected<void, std::string> {
    const auto page = mission::read<Page>(answer.body);
    if (!page)
      return tl::unexpected(with_sample(page.error().message(), page.error().sample));
    auto rows = rows_of(*page, mission_id_);
    if (!rows)
      return tl::unexpected(with_sample(rows.error(), answer.body.substr(0, mission::max_document_sample)));
    into = std::move(*rows);
    next = page->next;
    if constexpr (std::is_same_v<Page, mission::map_object_page>) {
      result.removed = page->removed.value_or(std::vector<std::string>{});
      return take_mark(*page);
    }
    return {};
  };
  const auto read =
      what_ == destination::observations
          ? read_as(std::type_identity<mission::map_object_page>{}, objects_of, result.objects)
          : read_as(
                std::type_identity<mission::ignored_item_page>{},
                [](const auto& page, const auto& id) { return ignored_items_of(page, id); }, result.ignored);
  if (!read)
    return tl::unexpected(read.error());
  return result;
}

tl::expected<void, std::string> pulling::take_mark(const mission::map_object_page& page) {
  if (page.since && (mark_before_.empty() || *page.since != mark_before_))
    return tl::unexpected(std::string("the service sent what has changed since a mark that it was not asked for"));
  if (is_change_.value_or(page.since.has_value()) != page.since.has_value())
    return tl::unexpected(std::string("some pages of the service have the whole map, others what has changed in it"));
  is_change_ = page.since.has_value();
  if (page.mark)
    mark_ = *page.mark;
  return {};
}

std::string pulling::passed_bound() const {
  if (pages_ >= max_pages)
    return std::to_string(max_pages) + " pages, and no last one";
  if (objects_ > max_rows || ignored_ > max_rows)
    return "more than " + std::to_string(max_rows) + " rows";
  if (bytes_ > max_bytes)
    return "more than " + std::to_string(max_bytes) + " bytes";
  if (empty_pages_ >= max_empty_pages)
    return std::to_string(max_empty_pages) + " pages in a row without anything in them";
  return {};
}

void pulling::take_page(planning_context& d, const service_answer& answer) {
  std::optional<std::string> next;
  auto page = page_in(answer, next);
  bytes_ += answer.body.size();
  if (page)
    empty_pages_ =
        page->objects.empty() && page->ignored.empty() && page->removed.empty() && next ? empty_pages_ + 1 : 0;
  const auto bound = page ? passed_bound() : "";
  if (!page || !bound.empty()) {
    d.count_fetch_error();
    return give_up(d, page ? "the service's map has no end: " + bound : page.error());
  }
  ++pages_;
  objects_ += static_cast<std::int64_t>(page->objects.size());
  ignored_ += static_cast<std::int64_t>(page->ignored.size());
  waiting_.push_back(std::move(*page));
  call_.succeed();
  next_ = next.value_or("");
  if (!next) {
    is_last_here_ = what_ == destination::ignored_items;
    what_ = destination::ignored_items;
  }
  go_on_with_page_ahead(d, next);
}

// -- a page that was asked for before the one before it had come ----------------------------------

void pulling::on_page_begun(planning_context& /*d*/, ticket number, const std::string& next) {
  if (number == call_.waiting && !ahead_.is_asked)
    ahead_.next = next;
  else if (number == ahead_.call.waiting)
    ahead_.following = next;
}

// What fails is asked for again when its turn comes, and counts then.
void pulling::on_page_ahead(const service_answer& answer) {
  if (judge(answer) == judgement::success)
    ahead_.came = answer;
}

// NEXT: as the page has it, which counts.
void pulling::go_on_with_page_ahead(planning_context& d, const std::optional<std::string>& next) {
  auto ahead = std::exchange(ahead_, {});
  if (!next || *next != ahead.next || !ahead.is_asked)
    return ahead.call.forget(d);
  call_.waiting = ahead.call.waiting;
  ahead_.next = std::move(ahead.following);
  if (ahead.came)
    take_page(d, *ahead.came);
}

// -- the store ------------------------------------------------------------------------------------

void pulling::on_store(planning_context& d, ticket number, const store_answer& answer) {
  if (!attempt_.ends_with(number))
    return;
  switch (failure_of(answer)) {
  case store::map_failure::none:
    break;
  case store::map_failure::load_given_up:
    return begin_anew(d, sentence_of(answer));
  case store::map_failure::busy:
    attempt_.fail(d, mission_id_);
    if (attempt_.failed < static_cast<std::uint32_t>(d.set.max_tries))
      return;
    [[fallthrough]];
  default:
    if (stage_ == stage::counting) // the map is there
      return end(d, pull_state::synced);
    if (stage_ == stage::failing || stage_ == stage::looking)
      return end(d, pull_state::failed);
    return give_up(d, sentence_of(answer));
  }
  if (const auto* begun = std::get_if<store::load_answer>(&answer); begun != nullptr && stage_ == stage::beginning)
    take_load(*begun);
  const auto* map = std::get_if<store::map_status>(&answer);
  if (map != nullptr && stage_ == stage::counting) {
    objects_ = static_cast<std::int64_t>(map->objects);
    return end(d, pull_state::synced);
  }
  if (map != nullptr && stage_ == stage::looking) {
    const bool has_copy = map->mission_id == mission_id_ &&
                          (map->sync == store::sync_state::degraded || map->sync == store::sync_state::cached_fallback);
    return end(d, has_copy ? pull_state::cached_fallback : pull_state::failed);
  }
  go_on(d);
}

// What begins anew asks for all of the map.
void pulling::take_load(const store::load_answer& begun) {
  load_ = begun.load;
  mark_before_ = loads_ == 0 ? begun.mark : std::string();
}

void pulling::go_on(planning_context& d) {
  switch (stage_) {
  case stage::choosing:
    return go_to(stage::beginning);
  case stage::beginning:
    what_ = destination::observations;
    next_.clear();
    pages_ = objects_ = ignored_ = 0;
    bytes_ = 0;
    empty_pages_ = 0;
    mark_.clear();
    is_change_.reset();
    is_last_here_ = false;
    return go_to(stage::loading);
  case stage::loading:
    waiting_.pop_front();
    return go_to(waiting_.empty() && is_last_here_ ? stage::finishing : stage::loading);
  case stage::finishing: // of changes the store knows how many objects that makes
    return is_change_.value_or(false) ? go_to(stage::counting) : end(d, pull_state::synced);
  case stage::failing:
    return go_to(stage::looking);
  default:
    return end(d, pull_state::synced);
  }
}

void pulling::go_to(stage next) {
  stage_ = next;
  attempt_.succeed();
}

// What is under way is of no use any more, and its answer is not waited for.
void pulling::drop_pages(planning_context& d) {
  attempt_.forget(d);
  call_.forget(d);
  ahead_.call.forget(d);
  ahead_ = {};
  waiting_.clear();
}

void pulling::begin_anew(planning_context& d, const std::string& why) {
  drop_pages(d);
  if (++loads_ >= max_loads)
    return give_up(d, "the load began anew " + std::to_string(loads_ - 1) + " times; the last time: " + why);
  go_to(stage::beginning);
}

void pulling::give_up(planning_context& d, std::string why) {
  reason_ = std::move(why);
  drop_pages(d);
  go_to(stage::failing);
}

void pulling::end(planning_context& d, pull_state result) {
  const auto mission_id = std::exchange(mission_id_, {}); // the next pull begins at the beginning
  if (result == pull_state::synced)
    d.went_well(pull_kind);
  else
    d.went_wrong(pull_kind, reason_);
  const bool has_map = result == pull_state::synced;
  d.happened(pull_ended{{mission_id, result, has_map ? static_cast<std::uint64_t>(objects_) : 0,
                         has_map ? static_cast<std::uint64_t>(ignored_) : 0, has_map ? std::string() : reason_}});
}

} // namespace godwit::mission_client
