#include "programs/godwitd/sightings/feeder.hpp"

#include <utility>

namespace godwit::sightings {

using mapobjects_store::map_failure;
using runtime::ask_error;

namespace {

// What the map knows and nobody moved is offered too: it may be a point of which more is seen now. Nothing: of no
// interest.
std::optional<scan_controller::candidate> candidate_of(const mapobjects_store::observed& seen) {
  using mapobjects_store::observation_kind;
  const auto& what = seen.what;
  const bool is_known = what.kind == observation_kind::existing;
  if (!is_known && !seen.shown)
    return std::nullopt;
  scan_controller::candidate result;
  result.id = what.id;
  result.mission_id = what.mission_id;
  result.object_id = what.object_id;
  result.class_group = what.class_group;
  result.position = what.position;
  result.at_ns = what.at_ns;
  result.confidence = what.confidence;
  result.has_moved = what.kind == observation_kind::moved;
  result.is_known = is_known;
  return result;
}

} // namespace

feeder::feeder(runtime::spawn_context context, feeder_settings configured, store_handle store,
               scan_controller::candidate_handle scan, std::optional<mission_client::picture_handle> client,
               std::shared_ptr<daemon::sighting_feed> feed, std::shared_ptr<daemon::point_pictures> pictures,
               complainer complain)
    : actor_base(std::move(context)), settings_(std::move(configured)), store_(std::move(store)),
      scan_(std::move(scan)), client_(std::move(client)), feed_(std::move(feed)), pictures_(std::move(pictures)),
      complain_(std::move(complain)) {}

feeder::~feeder() = default;

feeder::behavior_type feeder::handlers() {
  return {on<woken>([this](const woken&) { look(); }), on<tick>([this](const tick& due) {
            if (due.incarnation != incarnation_number())
              return;
            if (settings_.chooses_mission && !is_chosen_)
              choose();
            look();
            if (has_begun_)
              flow_->look_again();
            offer_again();
            hand_over_pictures();
            tell_after(tick_period, me(), tick{incarnation_number()});
          }),
          on<mapobjects_store::sighting>([this](const mapobjects_store::sighting& seen) { take(seen); }),
          on<get_sightings>([this](const get_sightings&) { return flow_->counts(); })};
}

void feeder::started() {
  flow_.emplace(feed_, ways_of_flow());
  tell(me(), tick{incarnation_number()});
}

// Of the camera. What finds no room is counted as refused; the file is read more slowly instead.
void feeder::take(const mapobjects_store::sighting& seen) {
  if (!feed_)
    return;
  if (settings_.chooses_mission && settings_.mission_id.empty())
    settings_.mission_id = seen.mission_id; // brought by a station
  if (!feed_->add(seen))
    feed_->count_without_room();
  look();
}

// What comes after the gate was closed again may wait for the next flight.
void feeder::look() {
  const bool is_open = feed_ && feed_->is_gate_open() && (is_chosen_ || !settings_.chooses_mission);
  if (!is_open || is_broken_)
    return;
  if (std::exchange(has_begun_, true))
    flow_->go_on();
  else
    flow_->begin();
}

void feeder::choose() {
  ask(
      store_, answer_timeout, mapobjects_store::choose_mission{settings_.mission_id},
      [this](const mapobjects_store::map_answer& answer) {
        is_chosen_ = answer.failure == map_failure::none;
        if (answer.failure == map_failure::broken && !std::exchange(is_broken_, true))
          complain_("the map can not be used, and sightings are not recorded: " + answer.error);
      },
      [](const ask_error&) {}); // asked again with the next tick
}

void feeder::offer(const mapobjects_store::observed& seen, daemon::sighting_flow::offered then) {
  using daemon::sighting_flow;
  const auto candidate = candidate_of(seen);
  if (!candidate)
    return then(sighting_flow::offer_outcome::taken);
  ask(
      scan_, offer_timeout, *candidate,
      [this, then, candidate](const scan_controller::candidate_answer& answer) {
        note_point(*candidate, answer);
        then(sighting_flow::offer_outcome::taken);
      },
      [this, then, candidate](const ask_error& why) {
        const bool does_not_run = why.code == runtime::ask_errc::not_taken;
        if (does_not_run)
          put_aside(*candidate);
        then(does_not_run ? sighting_flow::offer_outcome::taken : sighting_flow::offer_outcome::unknown);
      });
}

void feeder::note_point(const scan_controller::candidate& seen, const scan_controller::candidate_answer& answer) {
  if (!pictures_ || answer.point == 0)
    return;
  pictures_->belongs(seen.id, {answer.point, seen.mission_id, seen.at_ns});
  if (const auto lost = pictures_->lost(); lost != std::exchange(told_lost_, lost))
    complain_(std::to_string(lost) +
              " pictures of points of interest are lost: the disk does not take them, or there "
              "are more than " +
              std::to_string(daemon::point_pictures::max_files));
}

// On the ground; one by one. Whoever delivers them has noted it on the disk with its answer.
void feeder::hand_over_pictures() {
  if (!pictures_ || !client_ || is_handing_over_ || (feed_ && feed_->is_gate_open()))
    return;
  const auto next = pictures_->next();
  if (!next)
    return;
  is_handing_over_ = true;
  ask(
      *client_, answer_timeout, *next,
      [this, file = next->file](const mission_client::picture_noted&) {
        is_handing_over_ = false;
        pictures_->noted(file);
        hand_over_pictures();
      },
      [this](const ask_error&) { is_handing_over_ = false; }); // asked again with the next tick
}

// It comes, or comes back, a few seconds after the start of a flight or of godwitd.
void feeder::put_aside(const scan_controller::candidate& untaken) {
  if (untaken.is_known)
    return;
  untaken_.push_back(untaken);
  if (untaken_.size() > max_untaken)
    untaken_.pop_front();
}

// The oldest, and after it the others as long as somebody takes them.
void feeder::offer_again() {
  if (untaken_.empty() || is_offering_again_)
    return;
  is_offering_again_ = true;
  const auto resolve = [this](const std::string& id) {
    is_offering_again_ = false;
    if (!untaken_.empty() && untaken_.front().id == id) // else it was given up meanwhile
      untaken_.pop_front();
  };
  ask(
      scan_, offer_timeout, untaken_.front(),
      [this, resolve, seen = untaken_.front()](const scan_controller::candidate_answer& answer) {
        note_point(seen, answer);
        resolve(seen.id);
        offer_again();
      },
      [this, resolve, id = untaken_.front().id](const ask_error& why) {
        is_offering_again_ = false;
        if (why.code == runtime::ask_errc::given_up)
          resolve(id);
      });
}

daemon::sighting_flow::ways feeder::ways_of_flow() {
  return {
      [this](const mapobjects_store::sighting& seen, daemon::sighting_flow::taker then, std::function<void()> failed) {
        ask(store_, answer_timeout, seen, std::move(then),
            [failed = std::move(failed)](const ask_error&) { failed(); });
      },
      [this](const std::string& sentence) { complain_(sentence); }, [] {}, // the count of them says it
      [this](const std::string& error) {
        is_broken_ = true;
        complain_("the map can not be used, and sightings are not recorded any more: " + error);
      },
      [this](const mapobjects_store::observed& seen, daemon::sighting_flow::offered then) {
        offer(seen, std::move(then));
      }};
}

} // namespace godwit::sightings
