// The way to the broker, as fleet_link sees it. A test puts a broker of its own in here, with all vices.
//
// What becomes of it comes as messages to the actor (messages/fleet_link). Nothing here blocks, and nothing is
// answered. It outlives the incarnations of the actor. Thread: any.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace godwit::fleet_link {

struct publication {
  enum class kind {
    live,  // told as left; the broker keeps it for 5 s, for who comes back by then
    kept,  // the same, and the broker keeps the newest of each topic for who comes later
    event, // told as taken when the broker has it
    status // as kept, and acknowledged, but nothing is told
  };
  kind how = kind::live;
  std::string topic;
  std::shared_ptr<const std::string> payload; // JSON
  std::uint64_t number = 0;                   // of an event
};

class broker_port {
public:
  broker_port() = default;
  broker_port(const broker_port&) = delete;
  broker_port& operator=(const broker_port&) = delete;
  virtual ~broker_port() = default;

  // Ends the connection before it. WILL: what the broker publishes as the connection is lost, or ended.
  virtual void open(std::uint64_t attempt, const publication& will) = 0;
  // What there is, if its number is not above UPTO.
  virtual void close(std::uint64_t upto) = 0;
  virtual void publish(std::uint64_t attempt, const publication& what) = 0;
};

} // namespace godwit::fleet_link
