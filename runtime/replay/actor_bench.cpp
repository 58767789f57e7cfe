#include "runtime/replay/actor_bench.hpp"

#include <algorithm>
#include <deque>
#include <map>

#include <caf/scheduler/test_coordinator.hpp>
#include <nlohmann/json.hpp>

#include "runtime/address/stable_address.hpp"
#include "runtime/ask_error.hpp"
#include "runtime/assert.hpp"
#include "runtime/frame_parts.hpp"
#include "runtime/internal_messages.hpp"
#include "runtime/replay/replay_port.hpp"

namespace godwit::runtime {

namespace {

caf::error error_of(const ask_error& why) {
  switch (why.code) {
  case ask_errc::timeout:
    return caf::make_error(caf::sec::request_timeout);
  case ask_errc::not_taken:
    return caf::make_error(caf::sec::request_receiver_down, why.what);
  case ask_errc::given_up:
    return caf::make_error(caf::sec::unexpected_message, why.what);
  case ask_errc::outcome_unknown:
    break;
  }
  return caf::make_error(caf::sec::runtime_error, why.what);
}

// The runtime's own messages that an actor takes from its mailbox.
const message_type* runtime_type(std::string_view name) {
  for (const auto* each : {&type_of<deadline>(), &type_of<durable>(), &type_of<ask_failed>()})
    if (each->name == name)
      return each;
  return nullptr;
}

} // namespace

struct actor_bench::parts final : public replay_port {
  explicit parts(std::uint64_t run) : disk(run) {
    services outside;
    outside.time = &time;
    outside.names = &names;
    outside.health = &health;
    outside.durable = &disk;
    outside.trace = &record;
    outside.replayed = this;
    services_ = outside;
    system_options options;
    options.simulated = true;
    actors = std::make_unique<runtime::system>(outside, options);
    coordinator = dynamic_cast<caf::scheduler::test_coordinator*>(&actors->actors().scheduler());
    GODWIT_ASSERT(coordinator != nullptr, "a bench runs on CAF's test coordinator");
  }
  parts(const parts&) = delete;
  parts& operator=(const parts&) = delete;
  ~parts() override {
    end_life();
    others.clear();
    actors.reset();
  }

  void run() {
    while (coordinator->try_run_once()) {
    }
  }

  void forget_facts() {
    facts.clear();
    expected = 0;
  }

  void end_life() {
    if (life) {
      life->enqueue(kill_message(), nullptr);
      run();
      life = nullptr;
    }
  }

  void take(caf::actor_control_block& to, const caf::mailbox_element& element, std::int64_t delay_ns,
            const message_type* answer_type) override;
  void observed(const message_type& type, void* value) override;
  bool taken(const message_type& type, void* value) override;
  void called(const outside_call& what) override;
  [[nodiscard]] bench_result end_of_step(std::uint64_t crashes_before);
  [[nodiscard]] const child_spec* find(std::string_view name) const;
  [[nodiscard]] std::uint32_t number_of(std::string_view name);
  [[nodiscard]] caf::strong_actor_ptr address_named(std::string_view name);
  [[nodiscard]] stable_address& self() const { return address_of(chosen->address); }

  struct question {
    std::uint64_t id = 0;
    std::string to;
    const message_type* answer_type = nullptr;
    caf::message_id mid;
  };
  [[nodiscard]] std::deque<question>::iterator answered_by(const bench_input& input);
  [[nodiscard]] tl::expected<caf::mailbox_element_ptr, std::string> mail_of(const bench_input& input);

  directory names;
  health_board health;
  bench_time time;
  bench_journal disk;
  bench_record record;
  services services_;
  std::unique_ptr<runtime::system> actors;
  caf::scheduler::test_coordinator* coordinator = nullptr;
  const child_spec* chosen = nullptr;
  caf::strong_actor_ptr life;
  std::vector<bench_sending> sent;
  std::vector<std::pair<std::int64_t, std::uint32_t>> effects; // of what was sent, not confirmed yet
  std::vector<std::uint32_t> effect_receivers;
  std::deque<question> asked;
  struct fact {
    std::size_t place = 0; // among those of the step
    std::string type;
    nlohmann::json content;
  };
  [[nodiscard]] std::optional<fact> next_fact(std::string_view type);
  std::deque<fact> facts;   // to come
  std::size_t expected = 0; // in this step
  std::vector<handler_beside> beside;
  std::map<std::string, nlohmann::json, std::less<>> last_facts;
  std::map<std::string, caf::strong_actor_ptr, std::less<>> others;
  std::uint64_t requests = 0;
};

const child_spec* actor_bench::parts::find(std::string_view name) const {
  const auto& all = actors->declared();
  const auto found =
      std::ranges::find_if(all, [&](const auto& each) { return address_of(each.address).actor_name() == name; });
  return found == all.end() ? nullptr : &*found;
}

std::uint32_t actor_bench::parts::number_of(std::string_view name) {
  const std::string text(name);
  if (const auto known = names.number(text))
    return *known;
  return names.add(text);
}

// Of an actor that is not declared here: one that it made for the record's sake.
caf::strong_actor_ptr actor_bench::parts::address_named(std::string_view name) {
  if (const auto* const known = find(name))
    return strong(known->address);
  auto& made = others[std::string(name)];
  if (!made)
    made = make_stable_address(actors->actors(), number_of(name), {.name = std::string(name)});
  return made;
}

// -- what the actor does ----------------------------------------------------------------------------

void actor_bench::parts::take(caf::actor_control_block& to, const caf::mailbox_element& element, std::int64_t delay_ns,
                              const message_type* answer_type) {
  const auto& m = *envelope_in(element);
  const auto number = static_cast<stable_address&>(*to.get()).number();
  bench_sending each{.id = m.head.id,
                     .cause = m.head.cause,
                     .to = names.name(number),
                     .type = m.type->name,
                     .body = {},
                     .delay_ns = delay_ns,
                     .is_question = answer_type != nullptr,
                     .is_answer = element.mid.is_response()};
  m.type->append_json(each.body, m.body.data());
  if (answer_type != nullptr)
    asked.push_back({each.id, each.to, answer_type, element.mid});
  if (m.head.effect_event != 0) {
    effects.emplace_back(m.head.effect_event, m.head.effect_n);
    effect_receivers.push_back(number);
  }
  sent.push_back(std::move(each));
}

std::optional<actor_bench::parts::fact> actor_bench::parts::next_fact(std::string_view type) {
  const auto next = std::ranges::find(facts, type, &fact::type);
  if (next == facts.end())
    return std::nullopt;
  auto result = std::move(*next);
  facts.erase(next);
  return result;
}

bool actor_bench::parts::taken(const message_type& type, void* value) {
  const auto next = next_fact(type.name);
  return next && type.read_json(next->content, value).empty();
}

void actor_bench::parts::called(const outside_call& what) {
  const auto next = next_fact(type_of<outside_call>().name);
  handler_beside each;
  if (next)
    each.expected = next->place;
  type_of<outside_call>().append_json(each.produced, &what);
  beside.push_back(std::move(each));
}

void actor_bench::parts::observed(const message_type& type, void* value) {
  if (auto next = next_fact(type.name))
    last_facts[next->type] = std::move(next->content);
  if (const auto known = last_facts.find(type.name); known != last_facts.end())
    (void)type.read_json(known->second, value); // it was read before
}

bench_result actor_bench::parts::end_of_step(std::uint64_t crashes_before) {
  // Each effect is confirmed by its receiver; else they would pile up.
  for (std::size_t i = 0; life && i < effects.size(); ++i)
    life->enqueue(make_internal_mail(effect_taken{effects[i].first, effects[i].second, effect_receivers[i]}), nullptr);
  effects.clear();
  effect_receivers.clear();
  run();
  bench_result result;
  result.sent = std::exchange(sent, {});
  std::ranges::sort(result.sent, {}, &bench_sending::id);
  result.handled = record.take();
  for (const auto& each : facts)
    beside.push_back({each.place, {}});
  result.beside = std::exchange(beside, {});
  if (self().counters().crashes != crashes_before) {
    result.crash = self().last_crash();
    life = nullptr;
    asked.clear();
  }
  forget_facts();
  return result;
}

// -- what is handed to it ---------------------------------------------------------------------------

std::deque<actor_bench::parts::question>::iterator actor_bench::parts::answered_by(const bench_input& input) {
  const bool is_failure = input.type == type_of<ask_failed>().name;
  const auto by_id = std::ranges::find_if(asked, [&](const question& each) {
    return each.id == (is_failure ? input.id : input.cause) && (is_failure || each.answer_type->name == input.type);
  });
  const auto& host = static_cast<incarnation&>(*life->get());
  if (by_id != asked.end() || is_failure || host.takes(input.type) != nullptr)
    return by_id;
  return std::ranges::find_if(
      asked, [&](const question& each) { return each.to == input.sender && each.answer_type->name == input.type; });
}

tl::expected<caf::mailbox_element_ptr, std::string> actor_bench::parts::mail_of(const bench_input& input) {
  const auto document = nlohmann::json::parse(input.body, nullptr, false);
  if (document.is_discarded())
    return tl::unexpected(std::string("its message is not in the record"));
  const auto answered = answered_by(input);
  const auto& host = static_cast<incarnation&>(*life->get());
  const auto* type = answered != asked.end() && input.type != type_of<ask_failed>().name ? answered->answer_type
                                                                                         : host.takes(input.type);
  if (type == nullptr)
    type = runtime_type(input.type);
  if (type == nullptr)
    return tl::unexpected("the actor does not take " + std::string(input.type) + " any more, and has not asked for it");
  envelope m{{input.id, input.cause, 0, 0, number_of(input.sender)}, type, {}};
  if (const auto wrong = type->read_body(document, m.body); !wrong.empty())
    return tl::unexpected("its message can not be read: " + wrong);
  if (m.is<durable>())
    return make_internal_mail(durable{m.as<durable>().upto});
  auto from = input.may_be_question ? address_named(input.sender) : nullptr;
  if (answered == asked.end()) {
    if (m.is<ask_failed>())
      return tl::unexpected(std::string("the question that failed was not asked here"));
    const auto mid =
        from && from != strong(chosen->address) ? caf::make_message_id(++requests) : caf::make_message_id();
    return make_mail(std::move(from), mid, std::move(m));
  }
  const auto mid = answered->mid.response_id();
  asked.erase(answered);
  if (m.is<ask_failed>())
    return caf::make_mailbox_element(nullptr, mid, {}, error_of(m.as<ask_failed>().why));
  return make_mail(std::move(from), mid, std::move(m));
}

// -- the bench ---------------------------------------------------------------------------------------

actor_bench::actor_bench(std::uint64_t run) : parts_(std::make_unique<parts>(run)) {}

actor_bench::~actor_bench() = default;

runtime::system& actor_bench::actors() { return *parts_->actors; }

const time_source& actor_bench::time() const { return parts_->time; }

const journal& actor_bench::disk() const { return parts_->disk; }

bool actor_bench::choose(const std::string& actor) {
  parts_->chosen = parts_->find(actor);
  return parts_->chosen != nullptr;
}

bench_result actor_bench::begin(bench_incarnation from) {
  auto& p = *parts_;
  p.end_life();
  p.asked.clear();
  (void)p.record.take();
  p.sent.clear();
  p.beside.clear(); // of the end of the life before
  p.time.set(from.at);
  auto& self = p.self();
  std::uint64_t number = 0;
  while (number < from.number)
    number = self.begin_incarnation();
  GODWIT_ASSERT(number == from.number, "incarnations of a record rise");
  if (from.first_id != 0)
    self.continue_ids_from(from.first_id);
  const auto crashes = self.counters().crashes;
  spawn_context born{&p.services_, p.chosen->address, number, p.actors->guardian().ref(), std::move(from.restored)};
  try {
    p.life =
        caf::actor_cast<caf::strong_actor_ptr>(p.actors->actors().spawn<incarnation>(std::move(born), p.chosen->make));
  } catch (const std::exception& thrown) {
    self.note_crash(thrown.what());
  }
  p.run();
  return p.end_of_step(crashes);
}

tl::expected<void, std::string> actor_bench::expect_observed(std::string_view type, std::string_view body) {
  auto document = nlohmann::json::parse(body, nullptr, false);
  if (document.is_discarded())
    return tl::unexpected(std::string(type) + ": its content is not in the record");
  parts_->facts.push_back({parts_->expected++, std::string(type), std::move(document)});
  return {};
}

tl::expected<bench_result, std::string> actor_bench::deliver(const bench_input& input) {
  auto& p = *parts_;
  if (!p.life)
    return tl::unexpected(std::string("the actor has ended on the bench"));
  p.time.set(input.at);
  auto mail = p.mail_of(input);
  if (!mail) {
    p.forget_facts();
    return tl::unexpected(std::move(mail.error()));
  }
  const auto crashes = p.self().counters().crashes;
  p.life->enqueue(std::move(*mail), nullptr);
  p.run();
  return p.end_of_step(crashes);
}

void actor_bench::note_recorded_id(std::uint64_t sent, std::uint64_t recorded) {
  for (auto& each : parts_->asked)
    if (each.id == sent)
      each.id = recorded;
}

void actor_bench::continue_ids_from(std::uint64_t id) { parts_->self().continue_ids_from(id); }

} // namespace godwit::runtime
