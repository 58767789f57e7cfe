#include "programs/godwitd/ground_run/core.hpp"

#include <algorithm>

#include "programs/godwitd/ground_run/sentences.hpp"

namespace godwit::ground_run {

using mission_client::pull_state;

steps core::on_start() {
  if (!wanted_.has_service)
    return {choose{}};
  return {begin_fetch{}, look{}};
}

steps core::on_chosen() {
  if (phase_ != phase::loading)
    return {};
  return go_on_seeing();
}

steps core::on_loaded(const mission_client::mission_loaded& news) {
  if (!is_mine(news.document.mission_id) || phase_ == phase::over)
    return {};
  if (phase_ == phase::loading || phase_ == phase::refused)
    phase_ = phase::pulling;
  return {announce{sentence_of(news)}};
}

steps core::on_refused(const mission_client::mission_refused& news) {
  if (!is_mine(news.mission_id) || phase_ != phase::loading)
    return {};
  if (wanted_.once)
    return end({false, sentence_of(news)});
  phase_ = phase::refused;
  steps result{announce{sentence_of(news), true}};
  if (news.why == mission_client::refusal::unreachable)
    result.emplace_back(begin_later{});
  return result;
}

steps core::on_retry() {
  if (phase_ != phase::refused)
    return {};
  phase_ = phase::loading;
  return {begin_fetch{}};
}

steps core::on_pulled(const mission_client::map_pulled& news, std::optional<double> pull_s) {
  if (!is_mine(news.mission_id) || (phase_ != phase::loading && phase_ != phase::pulling))
    return {};
  steps result{announce{sentence_of(news, pull_s), news.state != pull_state::synced}};
  for (auto& each : go_on_seeing())
    result.push_back(std::move(each));
  return result;
}

// What an earlier run has heard is not told again: how far things are has to be asked.
steps core::on_status(const mission_client::service_status& now) {
  if (!is_mine(now.mission_id) || now.revision == 0)
    return {};
  if (phase_ == phase::pushing)
    return look_at_push(now);
  steps result;
  if (phase_ == phase::loading) {
    phase_ = phase::pulling;
    result.emplace_back(announce{"mission " + now.mission_id + ", revision " + std::to_string(now.revision) +
                                 ", is on board from an earlier run"});
  }
  const bool is_pulled = now.pull != pull_state::not_started && now.pull != pull_state::in_flight;
  if (phase_ != phase::pulling || !is_pulled)
    return result;
  result.emplace_back(announce{sentence_of(now.pull), now.pull != pull_state::synced});
  for (auto& each : go_on_seeing())
    result.push_back(std::move(each));
  return result;
}

steps core::look_at_push(const mission_client::service_status& now) {
  if (now.delivery_error.empty())
    return {};
  auto sentence = delivery_sentence(now);
  if (!now.may_deliver && wanted_.once)
    return end({false, std::move(sentence)});
  if (std::ranges::find(told_errors_, sentence) != told_errors_.end())
    return {};
  if (told_errors_.size() >= max_told_errors)
    told_errors_.erase(told_errors_.begin());
  told_errors_.push_back(sentence);
  return {announce{std::move(sentence), true}};
}

steps core::go_on_seeing() {
  phase_ = phase::seeing;
  if (wanted_.has_sightings)
    return {see{}};
  return wanted_.once ? on_sightings_over({}) : steps{};
}

steps core::on_sightings_over(const sighting_counts& counts) {
  if (phase_ != phase::seeing)
    return {};
  sightings_ = counts;
  steps result;
  if (wanted_.has_sightings)
    result.emplace_back(announce{sentence_of(counts), counts.refused + counts.unreadable != 0});
  if (wanted_.has_service) {
    phase_ = phase::pushing;
    result.emplace_back(push{});
  } else if (wanted_.once) {
    for (auto& each : resolved())
      result.push_back(std::move(each));
  }
  return result;
}

steps core::on_resolved(const mission_client::mission_resolved& news) {
  if (!is_mine(news.mission_id) || phase_ != phase::pushing)
    return {};
  resolved_ = news;
  return {count_owed{}};
}

steps core::on_owed(const mapobjects_store::owed_list& left) {
  if (phase_ != phase::pushing)
    return {};
  std::uint64_t rows = 0;
  std::uint64_t orphans = 0;
  for (const auto& each : left.missions) {
    if (!is_mine(each.mission_id))
      continue;
    rows += each.pending + each.taken;
    orphans += each.orphaned;
  }
  const auto before = std::exchange(left_on_map_, rows + orphans);
  if (rows != 0 && left_on_map_ != before) // else another push would not move it either
    return {push{}};
  return resolved();
}

steps core::on_deleted(const mission_client::mission_deleted& news) {
  if (!is_mine(news.mission_id) || phase_ == phase::over)
    return {};
  return {announce{"the service has deleted mission " + news.mission_id +
                       "; what is still to be delivered for it is kept on board as orphaned",
                   true}};
}

steps core::on_map_broken(const std::string& why) {
  return phase_ == phase::over ? steps{} : end({false, "the map can not be used: " + why});
}

steps core::resolved() {
  if (resolved_.orphaned + resolved_.expired + left_on_map_ != 0) {
    const auto kept = kept_sentence(resolved_, left_on_map_);
    if (wanted_.once)
      return end({false, kept});
    phase_ = phase::over;
    return {announce{kept, true}};
  }
  steps result;
  result.emplace_back(announce{
      wanted_.has_service ? std::string("all reports of the mission are delivered")
                          : std::string("the sightings are on the map; without a service nothing is delivered"),
      false});
  phase_ = phase::over;
  const bool is_complete = sightings_.refused + sightings_.unreadable == 0;
  if (wanted_.once)
    result.emplace_back(is_complete ? finish{}
                                    : finish{false, "not all sightings could be taken: " + sentence_of(sightings_)});
  return result;
}

steps core::end(finish how) {
  phase_ = phase::over;
  return {std::move(how)};
}

} // namespace godwit::ground_run
