// Which mission each station shows to its people: the one that it has uploaded or downloaded last.
//
// A start flies what stations are shown by this port, which a go-to, an insert or another station may have changed
// since. Who has done neither shows none, and may start what there is. Uploads are kept over a crash (state.hpp). Over
// the bound the one that was noted longest ago is forgotten. Thread: one at a time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "actors/ground_port/state.hpp"
#include "io/mavlink/frame.hpp"

namespace godwit::ground_port {

class plan_views {
public:
  explicit plan_views(const std::vector<plan_view>& restored) : views_(restored) {}

  void note(const plan_view& what) { note_view(views_, what); }
  [[nodiscard]] bool shows_another(io::mavlink::sender who, std::uint32_t plan_id) const {
    for (const auto& each : views_)
      if (each.by == executor::station{who.system, who.component})
        return each.plan_id != plan_id;
    return false;
  }
  [[nodiscard]] bool shows(io::mavlink::sender who, std::uint32_t plan_id) const {
    return std::ranges::any_of(views_, [&](const plan_view& each) {
      return each.by == executor::station{who.system, who.component} && each.plan_id == plan_id;
    });
  }
  // For people the two are one: of a vehicle that keeps its home as item 0 that alone has moved.
  void replace(std::uint32_t before, std::uint32_t after) {
    for (auto& each : views_)
      if (each.plan_id == before)
        each.plan_id = after;
  }

private:
  std::vector<plan_view> views_;
};

} // namespace godwit::ground_port
