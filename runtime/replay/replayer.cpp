#include "runtime/replay/replayer.hpp"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "runtime/crash_points.hpp"
#include "runtime/internal_messages.hpp"
#include "runtime/stored_state.hpp"

namespace godwit::runtime {

namespace {

constexpr std::string_view durable_type = "runtime.durable";
constexpr std::string_view begun_type = "runtime.begun";       // first of an incarnation without a durable state
constexpr std::string_view retry_type = "runtime.retry_write"; // what it does is the journal's alone

// A timer that was due this long before the last mail of its incarnation should have been in the record.
constexpr std::int64_t timer_lateness_ns = 2'000'000'000;

bool was_handled(const recorded_message& input) {
  return input.how != outcome::repetition && input.how != outcome::not_accepted && input.type != retry_type;
}

} // namespace

replayer::replayer(actor_bench& on, const recorded_run& record, replay_options options)
    : bench_(on), record_(record), options_(options), used_(record.outputs().size()) {
  for (std::size_t n = 0; n < record.outputs().size(); ++n)
    by_cause_.emplace(record.outputs()[n].cause, n);
}

replay_summary replayer::run(const std::function<void(const replay_step&)>& on_step) {
  const auto& inputs = record_.inputs();
  for (std::size_t at = 0; at < inputs.size() && wants_more(); ++at) {
    const auto found = summary_.deviations.size();
    step_ = {};
    take(at);
    step_.is_same = summary_.deviations.size() == found;
    if (step_.input != nullptr)
      on_step(step_);
    if (options_.until != 0 && inputs[at].id == options_.until)
      break;
  }
  return std::move(summary_);
}

bool replayer::wants_more() const { return summary_.deviations.size() < options_.max_deviations; }

void replayer::take(std::size_t at) {
  const auto& input = record_.inputs()[at];
  if (input.incarnation != incarnation_)
    return begin(at);
  if (is_left_out_) {
    ++summary_.inputs_left_out;
  } else if (made_by_itself_ > 0 && input.type == durable_type) {
    --made_by_itself_;
    judge_made_by_itself(input);
  } else if (was_handled(input)) {
    hand_over(input);
  }
}

// -- an incarnation ---------------------------------------------------------------------------------

void replayer::begin(std::size_t at) {
  const auto& inputs = record_.inputs();
  const auto& input = inputs[at];
  incarnation_ = input.incarnation;
  is_left_out_ = true;
  made_by_itself_ = 0;
  first_id_ = input.id;
  const auto next = std::find_if(inputs.begin() + static_cast<std::ptrdiff_t>(at), inputs.end(),
                                 [&](const auto& each) { return each.incarnation != incarnation_; });
  end_id_ = next == inputs.end() ? 0 : next->id;
  auto restored = restored_of(input);
  if (!restored)
    return leave_out(input, std::move(restored.error()));
  is_left_out_ = false;
  ++summary_.incarnations;
  if (!expect_facts(input))
    return;
  auto done = bench_.begin({incarnation_, *std::move(restored), input.id, moment_of(input)});
  if (done.handled.size() > 1)
    made_by_itself_ = done.handled.size() - 1;
  judge(input, done);
}

tl::expected<recovered, std::string> replayer::restored_of(const recorded_message& first) const {
  const auto text = record_.restored(incarnation_);
  if (first.type == begun_type)
    return recovered{};
  if (!text || first.type != durable_type)
    return tl::unexpected(std::string("its beginning is not in the record"));
  if (text->empty())
    return tl::unexpected(std::string("what it was restored from was too large for the trace, or is not whole"));
  auto restored = read_restored(nlohmann::json::parse(*text, nullptr, false));
  if (!restored)
    return tl::unexpected(std::string("what it was restored from can not be read"));
  return *std::move(restored);
}

// A word of the disk that the bench has heard with the beginning.
void replayer::judge_made_by_itself(const recorded_message& input) {
  if (input.how != outcome::crashed)
    return judge_missing(input);
  const bench_result alive;
  if (is_planned(input, alive))
    leave_planned(input);
  else
    (void)judge_end(input, alive);
}

void replayer::leave_out(const recorded_message& input, std::string why) {
  ++summary_.left_out;
  ++summary_.inputs_left_out;
  summary_.notes.push_back("incarnation " + std::to_string(input.incarnation) + ": " + std::move(why));
}

// -- an input ---------------------------------------------------------------------------------------

bench_moment replayer::moment_of(const recorded_message& input) const {
  return {input.began_ns - options_.monotonic_to_utc_ns + input.clock_offset_ns, input.began_ns + input.wall_offset_ns};
}

bool replayer::expect_facts(const recorded_message& input) {
  beside_ = record_.observed(input.incarnation, input.id);
  for (const auto* fact : beside_)
    if (auto taken = bench_.expect_observed(fact->type, fact->body); !taken) {
      find({.kind = deviation_kind::can_not_take, .input = &input, .what = taken.error()});
      return false;
    }
  return true;
}

void replayer::hand_over(const recorded_message& input) {
  if (!expect_facts(input))
    return;
  auto done = bench_.deliver(
      {input.id, input.cause, input.sender, record_.is_actor(input.sender), input.type, input.body, moment_of(input)});
  if (!done) {
    find({.kind = deviation_kind::can_not_take, .input = &input, .what = done.error()});
    is_left_out_ = true;
    return;
  }
  judge(input, *done);
}

bool replayer::is_planned(const recorded_message& input, const bench_result& done) const {
  return input.how == outcome::fenced || (input.how == outcome::crashed && done.crash.empty() &&
                                          record_.crash_reason(incarnation_).starts_with(planned_crash_words));
}

// What it sent before it crashed is not known. Its incarnation has ended, if it was not replaced before.
void replayer::leave_planned(const recorded_message& input) {
  ++summary_.planned_crashes;
  is_left_out_ = true;
  for (const auto n : expected_of(input.id))
    used_[n] = true;
}

void replayer::judge(const recorded_message& input, bench_result& done) {
  ++summary_.inputs;
  step_.input = &input;
  for (const auto n : expected_of(input.id))
    step_.expected.push_back(&record_.outputs()[n]);
  if (is_planned(input, done))
    return leave_planned(input);
  const auto own = done.handled.empty() ? 0 : done.handled.front().id;
  for (auto& each : done.sent) {
    if (each.cause == own)
      each.cause = input.id; // a message of the runtime's own: it is made anew on the bench
    match(input, each);
  }
  for (const auto& each : done.beside)
    judge_beside(input, each);
  if (judge_end(input, done))
    judge_missing(input);
  shown_ = std::move(done);
  step_.produced = &shown_;
}

void replayer::judge_beside(const recorded_message& input, const handler_beside& each) {
  const auto* const expected = each.expected ? beside_.at(*each.expected) : nullptr;
  if (each.produced.empty())
    return find({.kind = deviation_kind::not_done, .input = &input, .expected = expected});
  bench_sending produced{.to = record_.actor(), .type = type_of<outside_call>().name, .body = each.produced};
  auto fields = expected == nullptr ? std::vector<field_difference>() : differences(expected->body, each.produced, 0);
  if (expected != nullptr && fields.empty()) {
    ++summary_.compared;
    return;
  }
  find({.kind = expected == nullptr ? deviation_kind::not_recorded : deviation_kind::differs,
        .input = &input,
        .expected = expected,
        .produced = std::move(produced),
        .fields = std::move(fields)});
}

// False: the incarnation has ended.
bool replayer::judge_end(const recorded_message& input, const bench_result& done) {
  const bool has_crashed = input.how == outcome::crashed;
  if (has_crashed && !done.crash.empty())
    ++summary_.crashes;
  else if (has_crashed)
    find({.kind = deviation_kind::crashed, .input = &input, .what = record_.crash_reason(incarnation_)});
  else if (!done.crash.empty())
    find({.kind = deviation_kind::crashes, .input = &input, .what = done.crash});
  if (has_crashed || !done.crash.empty())
    is_left_out_ = true;
  return !is_left_out_;
}

bool replayer::is_here(std::size_t output) const {
  const auto id = record_.outputs()[output].id;
  return !used_[output] && id >= first_id_ && (end_id_ == 0 || id < end_id_);
}

std::vector<std::size_t> replayer::expected_of(std::uint64_t cause) const {
  std::vector<std::size_t> result;
  const auto [from, to] = by_cause_.equal_range(cause);
  for (auto each = from; each != to; ++each)
    if (is_here(each->second))
      result.push_back(each->second);
  std::ranges::sort(result);
  return result;
}

// The first message of the record to the same receiver: that one, or, where it differs, the one of the same id.
void replayer::match(const recorded_message& input, const bench_sending& each) {
  const auto& outputs = record_.outputs();
  auto candidates = expected_of(each.cause);
  std::erase_if(candidates, [&](std::size_t n) { return outputs[n].receiver != each.to; });
  const auto fields_of = [&](std::size_t n) {
    return outputs[n].oversize ? std::vector<field_difference>()
                               : differences(outputs[n].body, each.body, options_.tolerance_ns);
  };
  const auto same = std::ranges::find_if(
      candidates, [&](std::size_t n) { return outputs[n].type == each.type && fields_of(n).empty(); });
  const auto in_place = std::ranges::find_if(candidates, [&](std::size_t n) { return outputs[n].id == each.id; });
  if (same == candidates.end() && in_place == candidates.end())
    return judge_unrecorded(input, each);
  const auto chosen = same == candidates.end() ? *in_place : *same;
  used_[chosen] = true;
  if (each.id != outputs[chosen].id) {
    bench_.note_recorded_id(each.id, outputs[chosen].id);
    bench_.continue_ids_from(outputs[chosen].id + 1);
  }
  if (same != candidates.end())
    ++summary_.compared;
  else
    find({.kind = deviation_kind::differs,
          .input = &input,
          .expected = &outputs[chosen],
          .produced = each,
          .fields = outputs[chosen].type == each.type ? fields_of(chosen) : std::vector<field_difference>()});
}

void replayer::judge_unrecorded(const recorded_message& input, const bench_sending& each) {
  const auto& outputs = record_.outputs();
  bool should_be_there = false;
  if (record_.has_failed(each.id) || (each.is_answer && record_.has_failed(each.cause))) {
    should_be_there = false; // it was refused, or came too late
  } else if (each.to == record_.actor()) {
    should_be_there =
        record_.lived_through(each.to, each.id, input.began_ns, input.began_ns + each.delay_ns + timer_lateness_ns);
  } else {
    // Mail of one sender arrives in order.
    should_be_there = std::ranges::any_of(outputs, [&](const auto& later) {
      return later.receiver == each.to && later.id > each.id && (end_id_ == 0 || later.id < end_id_) &&
             record_.lived_through(each.to, each.id, input.began_ns, later.began_ns - 1);
    });
  }
  if (should_be_there)
    find({.kind = deviation_kind::not_recorded, .input = &input, .produced = each});
  else
    ++summary_.unconfirmed;
}

// What the record has of this input, or of earlier ones, and the bench has not sent. An answer may come later.
void replayer::judge_missing(const recorded_message& input) {
  for (const auto n : expected_of(input.id)) {
    const auto& each = record_.outputs()[n];
    if (each.receiver == input.sender && input.sender != record_.actor())
      continue;
    used_[n] = true;
    find({.kind = deviation_kind::not_sent, .input = &input, .expected = &each});
  }
}

void replayer::find(deviation what) {
  if (wants_more())
    summary_.deviations.push_back(std::move(what));
}

} // namespace godwit::runtime
