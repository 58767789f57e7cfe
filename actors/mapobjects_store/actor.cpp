#include "actors/mapobjects_store/actor.hpp"

#include <type_traits>
#include <utility>

#include "actors/mapobjects_store/deliveries.hpp"
#include "actors/mapobjects_store/map_health.hpp"
#include "actors/mapobjects_store/mission_scope.hpp"
#include "actors/mapobjects_store/pass_review.hpp"
#include "actors/mapobjects_store/sightings.hpp"

namespace godwit::mapobjects_store {

namespace {

constexpr std::uint64_t own_question = 0; // no request has this id

// For answers that say all there is to say by being there.
constexpr auto nothing_to_fill = [](auto&) {};

constexpr auto whole_answer = [](auto& answer, const auto& found) { answer = found; };

constexpr auto count_rows = [](moved_rows& answer, std::uint64_t rows) { answer.rows = rows; };

// What a refused ask is answered with beside the reason.
template <class A, class Q>
A empty_answer(const Q& asked) {
  A answer;
  if constexpr (std::is_same_v<A, load_answer> && !std::is_same_v<Q, begin_load>)
    answer.load = asked.load;
  if constexpr (std::is_same_v<A, batch>) {
    answer.key = asked.key;
    answer.mission_id = asked.mission_id;
    answer.to = asked.to;
  }
  return answer;
}

} // namespace

// START(map_access&, const Q&, told) hands the ask over; VALUE is what TOLD hears.
template <class Q, class A, class Value, class Start, class Fill>
auto actor::on_ask(Start start, Fill fill) {
  return on_deferred<Q, A>([this, start, fill](const Q& asked, std::uint64_t request_id) {
    const auto hand_over = [&](map_access& map, const auto& told) { return start(map, asked, told); };
    if (auto refused = port_->ask<A, Value>(request_id, empty_answer<A>(asked), hand_over, fill))
      answer_later(request_id, std::move(*refused));
  });
}

template <class Q, class A, class Work, class Fill>
auto actor::on_change(Work work, Fill fill) {
  using value = typename std::invoke_result_t<Work, map_tables&, const Q&>::value_type;
  return on_ask<Q, A, value>(
      [work](map_access& map, const Q& asked, const auto& told) {
        return map.post([work, asked](map_tables& t) { return work(t, asked); }, told);
      },
      fill);
}

actor::actor(runtime::spawn_context context, std::shared_ptr<map_port> port)
    : actor_base(std::move(context)), port_(std::move(port)) {}

actor::~actor() = default;

actor::behavior_type actor::handlers() {
  return {on_change<sighting, sighting_answer>(
              mapobjects_store::record, [](sighting_answer& answer, const observed& seen) { answer.seen = seen; }),
          on_ask<pass_end, pass_answer, pass_reviewed>(
              [](map_access& map, const pass_end& asked, const auto& told) { return map.review(asked, told); },
              [](pass_answer& answer, const pass_reviewed& reviewed) { answer.reviewed = reviewed; }),
          on_change<operator_verdict, verdict_answer>(
              judge, [](verdict_answer& answer, const std::optional<ignored_item>& item) { answer.ignored = item; }),
          on_change<acknowledge_fallback, map_answer>(accept_fallback, nothing_to_fill),
          on_change<choose_mission, map_answer>(choose, nothing_to_fill),
          on_change<begin_load, load_answer>(mapobjects_store::begin,
                                             [](load_answer& answer, const begun_load& begun) {
                                               answer.load = begun.number;
                                               answer.mark = begun.mark;
                                             }),
          on_ask<load_page, load_answer, void>(
              [](map_access& map, const load_page& page, const auto& told) { return map.add_page(page, told); },
              nothing_to_fill),
          on_ask<finish_load, load_answer, void>(
              [](map_access& map, const finish_load& asked, const auto& told) { return map.finish(asked, told); },
              nothing_to_fill),
          on_change<pull_failed, map_answer>(fall_back, nothing_to_fill),
          on_change<take_batch, batch>(mapobjects_store::take, whole_answer),
          on_change<get_batches, open_batches>(
              [](map_tables& t, const get_batches&) { return all_open(t.q); },
              [](open_batches& answer, const std::vector<open_batch>& found) { answer.batches = found; }),
          on_change<batch_delivered, map_answer>(mapobjects_store::deliver, nothing_to_fill),
          on_change<return_batch, map_answer>(give_back, nothing_to_fill),
          on_change<delete_mission, moved_rows>(forget, count_rows),
          on_change<orphan_mission, moved_rows>(orphan, count_rows),
          on_change<requeue_mission, moved_rows>(requeue, count_rows),
          on_change<get_owed, owed_list>(
              [](map_tables& t, const get_owed&) { return all_owed(t.q); },
              [](owed_list& answer, const std::vector<owed>& found) { answer.missions = found; }),
          on_change<get_objects, shown_objects>(look_at_objects,
                                                [](shown_objects& answer, const objects_found& found) {
                                                  answer.list = found.list;
                                                  answer.counted = found.counted;
                                                  answer.is_all = found.is_all;
                                                }),
          on_change<get_map, map_status>([](map_tables& t, const get_map&) { return summary(t); }, whole_answer),
          on<wake>([this](const wake&) { give_answers(); }),
          on<look>([this](const look& due) {
            if (due.incarnation != incarnation_number())
              return;
            give_answers(); // also when a wake was refused
            look_at_map();
          })};
}

// What the incarnation before this one left in the box is answered to nobody, and the box is empty again.
void actor::started() {
  give_answers();
  look_at_map();
}

void actor::give_answers() {
  for (int i = 0; i < max_answers_per_turn; ++i) {
    const auto ready = port_->take();
    if (!ready)
      return post_health();
    std::visit([&](const auto& answer) { give(ready->request_id, answer); }, ready->what);
  }
  tell(me(), wake{});
}

template <class Answer>
void actor::give(std::uint64_t request_id, const Answer& answer) {
  if constexpr (std::is_same_v<Answer, map_status>)
    if (request_id == own_question) {
      known_ = answer;
      return;
    }
  answer_later(request_id, answer);
}

void actor::look_at_map() {
  const auto writer = port_->status();
  if (writer && looked_at_ != writer->changes) {
    looked_at_ = writer->changes;
    const auto hand_over = [](map_access& map, const auto& told) {
      return map.post([](map_tables& t) { return summary(t); }, told);
    };
    if (port_->ask<map_status, map_status>(own_question, {}, hand_over, whole_answer))
      looked_at_.reset(); // there is no room now; the next look asks again
  }
  post_health();
  tell_after(look_period, me(), look{incarnation_number()});
}

void actor::post_health() { show_health(health_of(port_->status(), known_)); }

} // namespace godwit::mapobjects_store
