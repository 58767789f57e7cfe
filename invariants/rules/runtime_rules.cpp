#include "invariants/rules/rules.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "invariants/rules/body.hpp"

namespace godwit::invariants {

namespace {

using runtime::delivery;
using runtime::name_table;
using runtime::outcome;

// The trace's clock is measured anew all the time: two threads agree to within this.
constexpr std::int64_t clock_tolerance_ns = 1'000'000;

// Told to the asker by its own runtime, under the id of the question: that one may have been taken all the same.
constexpr std::string_view question_without_answer = "runtime.ask_failed";

// The newest deliveries by id. Memory: fixed; an older one is forgotten for a newer.
template <class Value>
class recent_messages {
public:
  recent_messages() : slots_(std::size_t{1} << size_log2) {}

  // Null: not known, or forgotten.
  [[nodiscard]] const Value* find(std::uint64_t run, std::uint64_t id) const {
    const auto& at = slots_[place_of(id)];
    return at.id == id && at.run == run && id != 0 ? &at.value : nullptr;
  }
  void put(std::uint64_t run, std::uint64_t id, const Value& value) {
    if (id != 0)
      slots_[place_of(id)] = {id, run, value};
  }

private:
  static constexpr unsigned size_log2 = 18;
  static constexpr std::uint64_t golden = 0x9e37'79b9'7f4a'7c15; // spreads ids that follow each other

  struct slot {
    std::uint64_t id = 0;
    std::uint64_t run = 0;
    Value value;
  };
  [[nodiscard]] static std::size_t place_of(std::uint64_t id) {
    return static_cast<std::size_t>((id * golden) >> (64U - size_log2));
  }
  std::vector<slot> slots_;
};

class cause_before_effect final : public invariant {
public:
  void take(const delivery& each, const name_table& names) override {
    if (const auto* cause = recent_.find(each.run, each.cause)) {
      if (cause->began_ns > each.began_ns + clock_tolerance_ns)
        find(certainty::certain, each, {each.cause, each.id}, "a message was taken before the one that caused it");
      const bool is_of_runtime = each.id == 0 || each.id == each.cause; // a question that failed is its own cause
      if (!is_of_runtime && !cause->was_taken_by(each.sender))
        find(certainty::certain, each, {each.cause, each.id},
             names.name(each.sender) + " sent it because of a message that " + names.name(cause->actor) + " took");
    }
    const auto* before = recent_.find(each.run, each.id);
    const auto other = before == nullptr ? each.actor : before->actor == each.actor ? before->other : before->actor;
    recent_.put(each.run, each.id, {each.began_ns, each.actor, other});
  }

private:
  struct taken {
    std::int64_t began_ns = 0;
    std::uint32_t actor = 0;
    std::uint32_t other = 0; // that took it before; of a question that failed: who was asked, and who asked
    [[nodiscard]] bool was_taken_by(std::uint32_t who) const { return actor == who || other == who; }
  };
  recent_messages<taken> recent_;
};

// What each actor did last, in this run. Deliveries without an id are the runtime's own and stand outside of the order.
template <class Value>
class by_actor {
public:
  Value& of(const delivery& each) {
    if (each.run != run_)
      values_.clear();
    run_ = each.run;
    if (values_.size() <= each.actor)
      values_.resize(each.actor + 1);
    return values_[each.actor];
  }

private:
  std::uint64_t run_ = 0;
  std::vector<Value> values_;
};

class one_handler_at_a_time final : public invariant {
public:
  void take(const delivery& each, const name_table& names) override {
    if (each.id == 0 || each.how == outcome::fenced)
      return;
    auto& last = last_.of(each);
    if (each.began_ns + clock_tolerance_ns < last.ended_ns)
      find(certainty::certain, each, {last.id, each.id}, names.name(each.actor) + " was in two handlers at once");
    last = {each.ended_ns(), each.id};
  }

private:
  struct handler {
    std::int64_t ended_ns = INT64_MIN;
    std::uint64_t id = 0;
  };
  by_actor<handler> last_;
};

class incarnations_rise final : public invariant {
public:
  void take(const delivery& each, const name_table& names) override {
    if (each.id == 0 || each.how == outcome::fenced)
      return;
    auto& newest = newest_.of(each);
    if (each.incarnation < newest)
      find(certainty::certain, each, {each.id},
           names.name(each.actor) + ", incarnation " + std::to_string(each.incarnation) +
               ", took a message although incarnation " + std::to_string(newest) + " was there");
    newest = std::max(newest, each.incarnation);
  }

private:
  by_actor<std::uint32_t> newest_;
};

class crash_ends_incarnation final : public invariant {
public:
  void take(const delivery& each, const name_table& names) override {
    if (each.id == 0)
      return;
    auto& last = last_.of(each);
    if (last.id != 0 && last.incarnation == each.incarnation && each.how == outcome::handled)
      find(certainty::certain, each, {last.id, each.id},
           names.name(each.actor) + ", incarnation " + std::to_string(each.incarnation) +
               ", went on after its handler had thrown");
    if (each.how == outcome::crashed)
      last = {each.id, each.incarnation};
  }

private:
  struct crash {
    std::uint64_t id = 0;
    std::uint32_t incarnation = 0;
  };
  by_actor<crash> last_;
};

class handled_once final : public invariant {
public:
  void take(const delivery& each, const name_table& names) override {
    if (each.how != outcome::handled || ask_failed_.is(each.type, names))
      return;
    if (const auto* before = recent_.find(each.run, each.id)) {
      if (before->actor == each.actor && before->incarnation == each.incarnation)
        find(certainty::certain, each, {each.id},
             names.name(each.actor) + ", incarnation " + std::to_string(each.incarnation) +
                 ", handled the same message twice");
      else if (before->actor != each.actor)
        find(certainty::certain, each, {each.id},
             names.name(before->actor) + " and " + names.name(each.actor) + " handled messages with the same id");
    }
    recent_.put(each.run, each.id, {each.actor, each.incarnation});
  }

private:
  struct handled {
    std::uint32_t actor = 0;
    std::uint32_t incarnation = 0;
  };
  recent_messages<handled> recent_;
  known_name ask_failed_{question_without_answer};
};

} // namespace

std::unique_ptr<invariant> make_cause_before_effect() { return std::make_unique<cause_before_effect>(); }
std::unique_ptr<invariant> make_one_handler_at_a_time() { return std::make_unique<one_handler_at_a_time>(); }
std::unique_ptr<invariant> make_incarnations_rise() { return std::make_unique<incarnations_rise>(); }
std::unique_ptr<invariant> make_crash_ends_incarnation() { return std::make_unique<crash_ends_incarnation>(); }
std::unique_ptr<invariant> make_handled_once() { return std::make_unique<handled_once>(); }

} // namespace godwit::invariants
