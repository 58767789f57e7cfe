// Any events in any order: nothing passes that was not looked at, or whose weaknesses nobody has acknowledged in time.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "io/fields/json_text.hpp"
#include "tests/actors/executor/preflight/preparation.hpp"

namespace godwit::executor::preflight {
namespace bit_property_test {

using namespace test;

// What happens, and the rules in words of their own: what a person who writes down all that is said would know.
class ordeal {
public:
  enum kind { look, acknowledgement, wanted, change, take_off, end, restart, wait, kinds };

  void happens(int what, int number) {
    switch (what) {
    case look:
      return looks(number);
    case acknowledgement:
      return acknowledges(static_cast<std::uint32_t>(std::max(0, static_cast<int>(newest_) - number % 3)));
    case wanted:
      return begins(number);
    case change:
      tell(mission_changed{survey, number % 3});
      return number % 3 == revision_ ? void() : forget();
    case take_off:
      flies_ = flies_ || is_passed();
      tell(took_off{});
      return is_passed() ? void() : forget();
    case end:
      tell(flight_ended{});
      return forget();
    case restart:
      tell(restarted{});
      is_looked_at_ = is_looked_at_ && flies_;
      return;
    default:
      now_ns_ += number % 400 * one_second_ns;
    }
  }

  void check() const {
    if (!is_passed())
      return;
    RC_ASSERT(is_looked_at_);                                        // since it was wanted, and since a restart
    RC_ASSERT(!fails_);                                              // nothing fails
    RC_ASSERT(std::ranges::includes(acknowledged_, last_degraded_)); // each weakness is known to an operator
    RC_ASSERT(revision_ > 0);                                        // a flight is prepared
  }

  [[nodiscard]] std::string trace() const { return trace_; }

private:
  using words = std::set<std::string>;

  [[nodiscard]] bool is_passed() const { return preflight::is_passed(s_, survey, revision_); }

  // The next number: 3 bits for what degrades, 1 in 8 fails, and now and then it is of another revision.
  void looks(int number) {
    static const texts weaknesses{"camera", "map", "satellites"};
    texts degraded;
    for (std::size_t i = 0; i < weaknesses.size(); ++i)
      if ((number >> i & 1) != 0)
        degraded.push_back(weaknesses[i]);
    const bool fails = number % 64 / 8 == 0;
    const int revision = number % 29 == 0 ? 3 : std::max(1, revision_);
    tell(looked{found(degraded, fails ? texts{"home"} : texts{}, survey, revision)});
    if (revision_ == 0 || flies_)
      return;
    if (revision != revision_)
      return forget();
    is_looked_at_ = true;
    fails_ = fails;
    last_degraded_ = words(degraded.begin(), degraded.end());
    if (fails)
      acknowledged_.clear();
  }

  void begins(int number) {
    const int revision = 1 + number % 2;
    const bool is_new = revision != revision_ || s_.now == phase::failed;
    if (is_new)
      forget();
    revision_ = revision;
    tell(checks_wanted{survey, revision});
  }

  void acknowledges(std::uint32_t id) {
    const auto news = tell(acknowledged{id, "Ada"});
    const auto answer = said<acknowledgement_answered>(news);
    RC_ASSERT(answer.has_value());
    RC_ASSERT(answer->is_taken == answer->reason.empty());
    if (!answer->is_taken)
      return;
    RC_ASSERT(id == newest_); // it names the newest report
    const auto& report = reports_.at(id);
    RC_ASSERT(now_ns_ < report.acknowledge_until_ns || taken_.contains(id)); // in time
    taken_.insert(id);
    const auto all = sentences_of(report.what, verdict::degraded);
    acknowledged_ = words(all.begin(), all.end());
  }

  // A flight, or its preparation, is over.
  void forget() {
    revision_ = 0;
    is_looked_at_ = flies_ = fails_ = false;
    acknowledged_.clear();
    last_degraded_.clear();
  }

  announcements tell(const event& what) {
    now_ns_ += one_second_ns;
    const bool has_mattered = matters(s_, what, now_ns_);
    const auto before = io::to_json(s_);
    auto news = apply(s_, what, now_ns_);
    trace_ += io::to_json(s_) + "\n";
    RC_ASSERT(has_mattered || (news.empty() && io::to_json(s_) == before));
    if (const auto opened = said<report_opened>(news)) {
      RC_ASSERT(opened->what.id == newest_ + 1); // numbers rise, over all flights
      newest_ = opened->what.id;
      reports_[newest_] = *opened;
    }
    return news;
  }

  state s_;
  std::int64_t now_ns_ = 1'780'000'000 * one_second_ns;
  int revision_ = 0; // of the flight that is prepared; 0: none is
  bool is_looked_at_ = false;
  bool fails_ = false;
  bool flies_ = false;
  words last_degraded_;
  words acknowledged_;
  std::uint32_t newest_ = 0;
  std::map<std::uint32_t, report_opened> reports_;
  std::set<std::uint32_t> taken_;
  std::string trace_;
};

using happenings = std::vector<std::pair<int, int>>;

// Looks are what happens most.
rc::Gen<happenings> some() {
  const auto kind = rc::gen::weightedOneOf<int>(
      {{2, rc::gen::just<int>(ordeal::look)}, {1, rc::gen::inRange<int>(0, ordeal::kinds)}});
  return rc::gen::scale(4, rc::gen::container<happenings>(rc::gen::pair(kind, rc::gen::inRange(0, 1'000))));
}

RC_GTEST_PROP(bit_property, nothing_passes_unseen_or_unacknowledged_and_numbers_only_rise, ()) {
  const auto all = *some();
  ordeal flight;
  for (const auto& [what, number] : all) {
    flight.happens(what, number);
    flight.check();
  }
}

RC_GTEST_PROP(bit_property, the_same_events_give_the_same_states, ()) {
  const auto all = *some();
  ordeal one;
  ordeal other;
  for (const auto& [what, number] : all) {
    one.happens(what, number);
    other.happens(what, number);
  }
  RC_ASSERT(one.trace() == other.trace());
}

} // namespace bit_property_test
} // namespace godwit::executor::preflight
