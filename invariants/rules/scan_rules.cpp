#include "invariants/rules/rules.hpp"

#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "invariants/rules/body.hpp"

namespace godwit::invariants {

namespace {

using runtime::delivery;
using runtime::name_table;

constexpr std::int64_t minute_ns = 60'000'000'000;
constexpr std::size_t max_points = 100'000; // in one trace; later ones are not looked at

std::int64_t time_of(const nlohmann::json& of, const char* name) {
  const auto found = of.find(name);
  return found != of.end() && found->is_number_integer() ? found->get<std::int64_t>() : 0;
}

// By the times that the showings were dated with. A number that was there comes again after a crash; times that go
// back are those of another boot.
class points_within_rate final : public invariant {
public:
  void take(const delivery& each, const name_table& names) override {
    if (!shown_.is(each.type, names))
      return;
    const auto body = object_in(each);
    const auto point = number(body, "number");
    const auto most = number(body, "most_a_minute");
    if (!point || !most || *most == 0)
      return;
    const showing now{time_of(body, "shown_ns"), *point, each.id};
    if (!last_.empty() && (now.at_ns < last_.back().at_ns || each.run != run_))
      last_.clear();
    run_ = each.run;
    for (const auto& before : last_)
      if (before.point == now.point)
        return;
    last_.push_back(now);
    if (last_.size() <= *most)
      return;
    const auto first = last_[last_.size() - *most - 1];
    if (now.at_ns - first.at_ns <= minute_ns)
      find(certainty::certain, each, {first.id, now.id},
           std::to_string(*most + 1) + " points of interest were shown within a minute");
    while (last_.size() > *most)
      last_.pop_front();
  }

private:
  struct showing {
    std::int64_t at_ns = 0;
    std::uint64_t point = 0;
    std::uint64_t id = 0;
  };
  known_name shown_{"scan_controller.point_shown"};
  std::deque<showing> last_;
  std::uint64_t run_ = 0;
};

// A process over another journal numbers from 1 again.
class point_closed_once final : public invariant {
public:
  void take(const delivery& each, const name_table& names) override {
    if (!closed_.is(each.type, names))
      return;
    const auto body = object_in(each);
    const auto point = number(body, "number");
    if (!point)
      return;
    const auto [known, is_new] = points_.try_emplace(*point, outcome{text(body, "outcome"), each.id, each.run});
    if (!is_new && known->second.how != text(body, "outcome"))
      find(known->second.run == each.run ? certainty::certain : certainty::across_runs, each,
           {known->second.id, each.id},
           "point " + std::to_string(*point) + " was " + known->second.how + ", and then " + text(body, "outcome"));
    if (points_.size() > max_points)
      points_.erase(points_.begin());
  }

private:
  struct outcome {
    std::string how;
    std::uint64_t id = 0;
    std::uint64_t run = 0;
  };
  known_name closed_{"scan_controller.point_closed"};
  std::map<std::uint64_t, outcome> points_;
};

} // namespace

std::unique_ptr<invariant> make_points_within_rate() { return std::make_unique<points_within_rate>(); }
std::unique_ptr<invariant> make_point_closed_once() { return std::make_unique<point_closed_once>(); }

} // namespace godwit::invariants
