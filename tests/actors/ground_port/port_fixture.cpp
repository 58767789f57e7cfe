#include "tests/actors/ground_port/port_fixture.hpp"

#include <algorithm>
#include <utility>

#include "actors/ground_port/passing/as_said.hpp"

namespace godwit::ground_port::test {

mavlink::mission_item_int waypoint(int seq, std::uint16_t command) {
  mavlink::mission_item_int result;
  result.seq = static_cast<std::uint16_t>(seq);
  result.command = command;
  result.frame = mavlink::number(mavlink::mav_frame::global_relative_alt);
  result.autocontinue = 1;
  result.x = 500'000'000 + seq * 1'000;
  result.y = 364'000'000;
  result.z = 50;
  return result;
}

std::vector<mavlink::mission_item_int> waypoints(int count) {
  std::vector<mavlink::mission_item_int> result;
  for (int i = 0; i < count; ++i)
    result.push_back(waypoint(i));
  return result;
}

mavlink::command_long command(mavlink::mav_cmd what, float param1, float param2) {
  mavlink::command_long result;
  result.command = mavlink::number(what);
  result.param1 = param1;
  result.param2 = param2;
  return result;
}

mavlink::command_long start_command(float first, float last, std::uint8_t confirmation) {
  auto result = command(mavlink::mav_cmd::mission_start, first, last);
  result.confirmation = confirmation;
  return result;
}

std::string text_of(const mavlink::statustext& m) {
  return {m.text.begin(), std::find(m.text.begin(), m.text.end(), '\0')};
}

port_fixture::port_fixture(settings configured, bool has_executor, signing_settings signing)
    : settings_(std::move(configured)), has_executor_(has_executor),
      signing_(std::move(signing)), port_{settings_.as.system, settings_.as.component} {
  make_core();
}

void port_fixture::make_core() {
  core_.emplace(settings_, signing_, disk, has_executor_, now());
  link_is(io::link::link_phase::up);
}

void port_fixture::bytes(io::link::peer_id peer, std::span<const std::byte> what) {
  execute(core_->on_bytes(peer, true, what, now()));
}

void port_fixture::executor_answers(executor::start_verdict verdict, const std::string& reason) {
  const auto asked = starts.back();
  executor_says(executor::start_answer{asked.key, verdict, reason});
  if (verdict == executor::start_verdict::started)
    executor_says(
        mission_progress{asked.plan_id, asked.first, mavlink::mission_state::active, mavlink::mission_mode::active});
}

void port_fixture::advance(std::int64_t duration_ns) {
  const auto until = now_ns_ + duration_ns;
  while (core_->next_deadline_ns() <= until) {
    now_ns_ = std::max(now_ns_, core_->next_deadline_ns());
    execute(core_->on_time(now()));
  }
  now_ns_ = until;
}

mavlink::mission_ack port_fixture::upload(const std::vector<mavlink::mission_item_int>& items, int type,
                                          mavlink::sender from) {
  const auto acks = sent<mavlink::mission_ack>().size();
  const auto requests_before = sent<mavlink::mission_request_int>().size();
  say(mavlink::mission_count{.count = static_cast<std::uint16_t>(items.size()),
                             .mission_type = static_cast<std::uint8_t>(type)},
      from);
  for (auto answered = requests_before; sent<mavlink::mission_ack>().size() == acks; ++answered) {
    const auto requests = sent<mavlink::mission_request_int>();
    if (answered >= requests.size())
      break;
    auto item = items.at(requests[answered].seq);
    item.mission_type = static_cast<std::uint8_t>(type);
    say(item, from);
  }
  return sent<mavlink::mission_ack>().size() > acks ? last<mavlink::mission_ack>() : mavlink::mission_ack{.type = 0xFF};
}

std::vector<mavlink::mission_item_int> port_fixture::download(int type, mavlink::sender from) {
  std::vector<mavlink::mission_item_int> result;
  say(mavlink::mission_request_list{.mission_type = static_cast<std::uint8_t>(type)}, from);
  const auto count = last<mavlink::mission_count>().count;
  for (std::uint16_t i = 0; i < count; ++i) {
    say(mavlink::mission_request_int{.seq = i, .mission_type = static_cast<std::uint8_t>(type)}, from);
    result.push_back(last<mavlink::mission_item_int>());
  }
  say(mavlink::mission_ack{.mission_type = static_cast<std::uint8_t>(type)}, from);
  return result;
}

void port_fixture::settle_disk() {
  is_disk_slow_ = false;
  for (const auto& each : std::exchange(waiting_, {}))
    write(each);
}

void port_fixture::crash(bool dispatch_effect_again) {
  waiting_.clear();
  is_disk_slow_ = false;
  set_currents.clear();
  words.clear();
  now_ns_ += 100 * ms;
  make_core();
  if (dispatch_effect_again)
    dispatch_effect_last_again();
}

void port_fixture::dispatch_effect_last_again() {
  for (const auto& each : std::vector(last_effects_))
    dispatch(each);
}

void port_fixture::vehicle_answers(std::uint16_t command, mavlink::mav_result result, mavlink::sender to,
                                   mavlink::sender who) {
  component_says(passing::as_said(mavlink::command_ack{.command = command,
                                                       .result = mavlink::number(result),
                                                       .target_system = to.system,
                                                       .target_component = to.component},
                                  who));
}

int port_fixture::last_result() const {
  const auto all = sent<mavlink::command_ack>();
  return all.empty() ? -1 : all.back().result;
}

std::vector<std::string> port_fixture::texts() const {
  std::vector<std::string> result;
  for (const auto& each : sent<mavlink::statustext>())
    result.push_back(text_of(each));
  return result;
}

bool port_fixture::said(const std::string& text) const {
  const auto all = texts();
  return std::find(all.begin(), all.end(), text) != all.end();
}

std::uint64_t port_fixture::count_of(const std::string& name) const {
  for (const auto& each : shown().counts)
    if (each.name == name)
      return each.count;
  return ~std::uint64_t{0};
}

void port_fixture::execute(const effects& wanted) {
  for (const auto& each : wanted) {
    if (const auto* out = std::get_if<transmission>(&each))
      frames.push_back(*out);
    else if (const auto* set_current = std::get_if<start_request_to_executor>(&each))
      set_currents.push_back(*set_current);
    else if (const auto* word = std::get_if<word_to_say>(&each))
      words.push_back(*word);
    else if (const auto* news = std::get_if<operator_link>(&each))
      operator_news.push_back(*news);
    else if (const auto* passed = std::get_if<pass_on>(&each))
      passed_on.push_back(passed->what);
    else if (const auto* act = std::get_if<act_to_ask>(&each))
      acts.push_back(*act);
    else if (const auto* answered = std::get_if<acknowledgement_to_tell>(&each))
      acknowledged.push_back(answered->what);
    else if (const auto* row = std::get_if<audit_row_to_tell>(&each))
      rows.push_back(*row);
    else if (std::holds_alternative<tell_taken_over>(each))
      taken_over_told.push_back(passed_on.size());
    else if (is_disk_slow_)
      waiting_.push_back(std::get<durable_event>(each));
    else
      write(std::get<durable_event>(each));
  }
  reserve_signing_time();
}

void port_fixture::reserve_signing_time() {
  if (const auto ceiling = core_->wanted_reservation(now()))
    write(signing_time_reserved{mavlink::units(*ceiling)});
}

void port_fixture::write(const durable_event& each) {
  ++events;
  last_effects_ = durable_core::apply(disk, each, now().wall_ns);
  for (const auto& effect : std::vector(last_effects_))
    dispatch(effect);
}

void port_fixture::dispatch(const durable_core::effect& each) {
  std::visit(
      [this]<class M>(const M& m) {
        if constexpr (std::is_same_v<M, signing_time_reserved>)
          core_->on_reserved(mavlink::signing_time{m.ceiling});
        else if constexpr (std::is_same_v<M, executor::plan_taken>) {
          taken.push_back(m);
          if (judges)
            execute(core_->on_plan_judged({m.type, m.plan_id, verdict()}, now()));
        } else if constexpr (std::is_same_v<M, executor::plan_cleared>) {
          cleared.push_back(m);
          if (judges)
            execute(core_->on_plan_judged({m.type, 0, verdict()}, now()));
        } else if constexpr (std::is_same_v<M, executor::start_mission>)
          starts.push_back(m);
        else
          execute(core_->on_durable(m, now()));
      },
      each);
}

} // namespace godwit::ground_port::test
