// The sightings of a flight as an actor: while the gate is open they flow from the feed into the map store, and what
// the store makes of them to who looks for points of interest.
//
// The gate is in the feed, which outlives the incarnations; whoever knows where the flight stands opens and closes it.
// Without a missions service nobody else tells the map store which mission it is, and so the feeder does. Nothing of it
// is durable: what was not resolved is handed out again. While the gate is closed the pictures of points are handed
// over to who delivers them. Errors: told to people. Thread: as actor_base.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "messages/mapobjects_store/types.hpp"
#include "messages/mission_client/handle.hpp"
#include "messages/scan_controller/handle.hpp"
#include "programs/godwitd/sightings/messages.hpp"
#include "programs/godwitd/sightings/point_pictures.hpp"
#include "programs/godwitd/sightings/sighting_flow.hpp"
#include "runtime/actor_base.hpp"

namespace godwit::sightings {

// What of the map store it needs.
using store_handle = runtime::mailbox<runtime::asks<mapobjects_store::sighting, mapobjects_store::sighting_answer>,
                                      runtime::asks<mapobjects_store::choose_mission, mapobjects_store::map_answer>>;

struct feeder_settings {
  std::string mission_id;
  bool chooses_mission = false; // there is no service
};

// May be called by any thread and does not block.
using complainer = std::function<void(const std::string& sentence)>;

class feeder final : public runtime::actor_base<feeder_handle> {
public:
  static constexpr std::chrono::milliseconds tick_period{500};
  static constexpr std::chrono::seconds answer_timeout{10};
  static constexpr std::chrono::seconds offer_timeout{2};
  // Findings of the time in which nobody looks for points of interest; the oldest are given up, and the map has them.
  static constexpr std::size_t max_untaken = 256;

  // FEED: null without sightings. PICTURES: null without a camera. CLIENT: none without a missions service.
  feeder(runtime::spawn_context context, feeder_settings configured, store_handle store,
         scan_controller::candidate_handle scan, std::optional<mission_client::picture_handle> client,
         std::shared_ptr<daemon::sighting_feed> feed, std::shared_ptr<daemon::point_pictures> pictures,
         complainer complain);
  ~feeder() override;

protected:
  behavior_type handlers() override;
  void started() override;

private:
  [[nodiscard]] daemon::sighting_flow::ways ways_of_flow();
  void take(const mapobjects_store::sighting& seen);
  void look();
  void choose();
  void offer(const mapobjects_store::observed& seen, daemon::sighting_flow::offered then);
  void note_point(const scan_controller::candidate& seen, const scan_controller::candidate_answer& answer);
  void hand_over_pictures();
  void put_aside(const scan_controller::candidate& untaken);
  void offer_again();

  feeder_settings settings_;
  store_handle store_;
  scan_controller::candidate_handle scan_;
  std::optional<mission_client::picture_handle> client_;
  std::shared_ptr<daemon::sighting_feed> feed_;
  std::shared_ptr<daemon::point_pictures> pictures_;
  complainer complain_;
  std::optional<daemon::sighting_flow> flow_;      // from started() on
  std::deque<scan_controller::candidate> untaken_; // oldest first
  bool is_offering_again_ = false;
  bool is_handing_over_ = false;
  std::uint64_t told_lost_ = 0; // pictures
  bool has_begun_ = false;
  bool is_chosen_ = false;
  bool is_broken_ = false;
};

} // namespace godwit::sightings
