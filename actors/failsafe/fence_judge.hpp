// Whether a place, or the straight way between two, keeps to all fences: inside at least one that keeps in, where there
// are any, and inside none that keeps out.
//
// A way is judged as a whole: between two positions a fast vehicle can cut a corner that neither of them lies in. It is
// cut into pieces wherever it passes a side, a floor or a ceiling; the verdict about one point of a piece is the
// verdict about the piece. Thread: pure.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "actors/failsafe/fence.hpp"

namespace godwit::failsafe {

// As many as the contract of the missions service allows.
inline constexpr std::size_t max_fences = 100;

struct breach {
  mission::fence_kind kind = mission::fence_kind::inclusion;
  std::size_t index = 0; // of the exclusion fence; of no meaning for inclusion

  // "it is in the exclusion fence number 2"; fences are numbered for people, from 1 on.
  [[nodiscard]] std::string sentence() const;
  friend bool operator==(const breach&, const breach&) = default;
};

class fence_judge {
public:
  // No fences: nothing is ever breached. An error names the fence and what is wrong with it.
  [[nodiscard]] static tl::expected<fence_judge, std::string> build(const std::vector<mission::geofence>& from);

  [[nodiscard]] bool has_fences() const { return !fences_.empty(); }

  // Without FLOOR_COUNTS the fences that keep in have no floor; see fence_watch.
  [[nodiscard]] std::optional<breach> judge(const place& there, bool floor_counts = true) const;
  [[nodiscard]] std::optional<breach> judge(const place& from, const place& to, bool floor_counts = true) const;

private:
  template <class Inside>
  [[nodiscard]] std::optional<breach> judge_by(Inside is_inside) const;

  std::vector<fence> fences_;
};

} // namespace godwit::failsafe
