// Lets the sightings of a feed flow into the map store, a bounded number at a time, for the actor that owns it.
//
// A sighting is asked again, under the same id, until the store has answered it, and then offered to who looks for
// points of interest, a few times at most. While the store is busy the flow rests until look_again(). Errors: told
// through `ways`. Thread: its actor's.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "messages/mapobjects_store/types.hpp"
#include "programs/godwitd/sightings/sighting_feed.hpp"

namespace godwit::daemon {

class sighting_flow {
public:
  // More would wait in the store's queue and not in the file.
  static constexpr std::size_t max_under_way = 128;
  // Of sightings that the store refuses so many are told one by one; all are counted.
  static constexpr std::uint64_t max_told_refusals = 10;
  // Of what the store has recorded; then it is counted as not offered. The map has it.
  static constexpr int max_offers = 3;

  using taker = std::function<void(const mapobjects_store::sighting_answer& answer)>;
  enum class offer_outcome {
    taken,  // or nobody wants it
    unknown // whether it was
  };
  using offered = std::function<void(offer_outcome how)>;

  struct ways {
    // The last one is called instead of the second when nothing came back.
    std::function<void(const mapobjects_store::sighting& seen, taker then, std::function<void()> failed)> ask_store;
    std::function<void(std::string sentence)> complain;
    std::function<void()> over;                           // of the file nothing is left, and nothing will come; once
    std::function<void(const std::string& error)> broken; // the map can not be used; the flow has ended
    // What the store has made of a sighting. Empty: it is offered to nobody.
    std::function<void(const mapobjects_store::observed& seen, offered then)> offer = {};
  };

  // FEED: null without sightings; then nothing ever flows.
  sighting_flow(std::shared_ptr<sighting_feed> feed, ways to) : feed_(std::move(feed)), ways_(std::move(to)) {
    if (feed_)
      feed_->take_back_all(); // what an earlier incarnation of the actor had taken
  }

  void begin();
  void go_on();      // there may be something
  void look_again(); // the store may have room again
  [[nodiscard]] sighting_counts counts() const { return feed_ ? feed_->counts() : sighting_counts{}; }

private:
  void record(const sighting_feed::numbered& each);
  void take(std::uint64_t number, const mapobjects_store::sighting_answer& answer);
  void offer(std::uint64_t number, const mapobjects_store::observed& seen, int tries);

  std::shared_ptr<sighting_feed> feed_;
  ways ways_;
  std::size_t under_way_ = 0;
  bool is_flowing_ = false;
  bool is_over_told_ = false;
  bool is_resting_ = false; // the store was busy: until look_again
};

} // namespace godwit::daemon
