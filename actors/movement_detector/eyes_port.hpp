// The way to the helper process, as movement_detector sees it. A test puts eyes of its own in here, with all vices.
//
// What the helper says comes as messages to the actor (messages/movement_detector). Nothing here blocks, and nothing is
// answered: what goes wrong is told as helper_ended. It outlives the incarnations of the actor. Thread: any.
#pragma once

#include <cstdint>
#include <string>

#include "io/eyes/messages.hpp"

namespace godwit::movement_detector {

class eyes_port {
public:
  eyes_port() = default;
  eyes_port(const eyes_port&) = delete;
  eyes_port& operator=(const eyes_port&) = delete;
  virtual ~eyes_port() = default;

  // Ends what runs before it.
  virtual void start(std::uint32_t run, const io::eyes::begin& how) = 0;
  // What runs, if its number is not above UPTO.
  virtual void end(std::uint32_t upto) = 0;
  virtual void tell(const io::eyes::pose& where) = 0;
  // The cut-out of a candidate that was seen then, for people; ID: of the sighting that has come of it.
  virtual void keep_picture(std::uint32_t track, std::int64_t captured_ns, const std::string& id) = 0;
};

} // namespace godwit::movement_detector
