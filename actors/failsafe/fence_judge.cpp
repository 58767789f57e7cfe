#include "actors/failsafe/fence_judge.hpp"

#include <algorithm>
#include <utility>

namespace godwit::failsafe {

std::string breach::sentence() const {
  return kind == mission::fence_kind::inclusion ? std::string("it is outside of all inclusion fences")
                                                : "it is in the exclusion fence number " + std::to_string(index + 1);
}

tl::expected<fence_judge, std::string> fence_judge::build(const std::vector<mission::geofence>& from) {
  if (from.size() > max_fences)
    return tl::unexpected(std::to_string(from.size()) + " fences are too many; at most " + std::to_string(max_fences) +
                          " are possible");
  fence_judge result;
  for (std::size_t i = 0; i < from.size(); ++i) {
    auto one = fence::build(from[i]);
    if (!one)
      return tl::unexpected("fence number " + std::to_string(i + 1) + " " + one.error());
    result.fences_.push_back(std::move(*one));
  }
  return result;
}

// IS_INSIDE(index) says whether the point in question lies in that fence.
template <class Inside>
std::optional<breach> fence_judge::judge_by(Inside is_inside) const {
  bool must_be_in_one = false;
  bool is_in_one = false;
  for (std::size_t i = 0; i < fences_.size(); ++i) {
    const bool inside = is_inside(i);
    if (fences_[i].kind() == mission::fence_kind::inclusion) {
      must_be_in_one = true;
      is_in_one = is_in_one || inside;
    } else if (inside) {
      return breach{mission::fence_kind::exclusion, i};
    }
  }
  if (must_be_in_one && !is_in_one)
    return breach{mission::fence_kind::inclusion, 0};
  return std::nullopt;
}

std::optional<breach> fence_judge::judge(const place& there, bool floor_counts) const {
  return judge_by([&](std::size_t i) {
    const bool is_exclusion = fences_[i].kind() == mission::fence_kind::exclusion;
    return fences_[i].contains(there, floor_counts || is_exclusion);
  });
}

std::optional<breach> fence_judge::judge(const place& from, const place& to, bool floor_counts) const {
  std::vector<fence::leg> legs;
  std::vector<double> shares{0, 1};
  legs.reserve(fences_.size());
  for (const auto& each : fences_) {
    legs.push_back(each.leg_between(from, to));
    legs.back().add_cuts(shares);
  }
  std::sort(shares.begin(), shares.end());
  const auto judge_at = [&](double share) {
    return judge_by([&](std::size_t i) {
      const bool is_exclusion = fences_[i].kind() == mission::fence_kind::exclusion;
      return legs[i].is_inside(share, floor_counts || is_exclusion);
    });
  };
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (auto found = judge_at(shares[i]))
      return found;
    if (i + 1 < shares.size() && shares[i] < shares[i + 1])
      if (auto found = judge_at((shares[i] + shares[i + 1]) / 2))
        return found;
  }
  return std::nullopt;
}

} // namespace godwit::failsafe
