// Fetches the mission: at its begin, where it is refused after a few tries, and when the fate of a change is not known,
// where there is no hurry and no end. At the begin the service also says up to which number it has reports of this
// mission, and gives back the last one: a journal that was lost has taken both with it. A service that does not know
// that call says 404.
//
// Nothing that is not a valid mission of this id and of our major version comes further than this. Thread: one at a
// time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <tl/expected.hpp>

#include "actors/mission_client/planning_context.hpp"
#include "messages/mission/answer.hpp"

namespace godwit::mission_client {

struct unusable_mission {
  std::string reason; // sentence for people
  std::string sample; // the beginning of what came
};

// A mission in the answer of a service. ID is the one that was asked for.
[[nodiscard]] tl::expected<mission::document, unusable_mission> mission_in(const service_answer& answer,
                                                                           const std::string& id);

class fetching final : public part {
public:
  void plan(planning_context& d) override;
  void on_answer(planning_context& d, ticket number, const service_answer& answer) override;

private:
  void take_mission(planning_context& d, const service_answer& answer);
  void take_progress(planning_context& d, const service_answer& answer);
  void take_failure(planning_context& d, const service_answer& answer);
  void refuse(planning_context& d, refusal why, std::string reason, std::string sample = {});
  void end(planning_context& d, std::optional<mission::progress_status> told);

  attempt attempt_;
  std::string mission_id_;                   // that was asked for
  std::optional<mission::document> mission_; // it came; how many reports of it the service has is being asked
};

// The last report that the service has of a mission, in its answer.
[[nodiscard]] tl::expected<mission::progress_status, unusable_mission> progress_in(const service_answer& answer,
                                                                                   const std::string& id);

// The same of a mission with which a journal goes on: it may be an older one than the reports of the service. Somebody
// may fly, so there is no end to the tries.
class asking_progress final : public blockable_part {
public:
  void plan(planning_context& d) override;
  void on_answer(planning_context& d, ticket number, const service_answer& answer) override;

private:
  void fail(planning_context& d, const std::string& why, const service_answer& answer);

  attempt attempt_;
  std::string mission_id_; // empty: nothing is asked
};

class looking_up final : public blockable_part {
public:
  void plan(planning_context& d) override;
  void on_answer(planning_context& d, ticket number, const service_answer& answer) override;

private:
  attempt attempt_;
  std::string mission_id_;
};

} // namespace godwit::mission_client
